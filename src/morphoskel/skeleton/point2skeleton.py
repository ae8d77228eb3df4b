"""Skeletonize a cloud with a trained Point2Skeleton network."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from morphoskel.shapes import FloatArray, PointCloud, Skeleton
from morphoskel.skeleton.mesh_distance import nearest_pieces
from morphoskel.skeleton.skeletal_mesh import skeletal_mesh

if TYPE_CHECKING:
    from morphoskel.networks.point2skeleton_network import Point2SkeletonNetwork


def point2skeleton(cloud: PointCloud, network: Point2SkeletonNetwork, *, refine_radii: bool = True) -> Skeleton:
    """Predict skeletal balls and the curves and sheets between them.

    Parameters
    ----------
    cloud
        Any number of points in any units; the network sees a scaled selection of a fixed number, see
        :func:`~morphoskel.networks.cloud_preparation.prepare_cloud`.
    network
        Trained, on any device; used in evaluation mode.
    refine_radii
        Whether to compute the radii anew from the distances of the surface points to the skeletal *mesh*, as the
        published results do; else from the distances to the skeletal points alone, which are larger.

    Returns
    -------
    Skeleton
        ``settings.skeletal_points`` balls with edges (the curves) and triangles (the sheets), in the cloud's units. The
        order of the balls means nothing.

    Notes
    -----
    Nothing is random: the released program measures the distances to 10 000 random points of the mesh, here they are
    exact.

    References
    ----------
    .. [1] C. Lin et al., "Point2Skeleton: Learning Skeletal Representations from Point Clouds", CVPR 2021.
    """
    import torch

    from morphoskel.networks.cloud_preparation import prepare_cloud
    from morphoskel.networks.skeletal_links import initial_graph, node_inputs, predicted_links

    settings = network.settings
    prepared = prepare_cloud(cloud, settings.points)
    points = prepared.points[None].to(next(network.parameters()).device)
    was_training = network.training
    network.eval()
    with torch.no_grad():
        skeletal = network.skeletal_points(points)
        graph = initial_graph(points, skeletal.centres, settings.valid_neighbours)
        scores = network.links(node_inputs(skeletal), graph.links)
        predicted = predicted_links(scores, graph.valid, settings.link_threshold)
    network.train(was_training)
    centres, radii, weights, samples, surface_points = (
        part[0].double().cpu().numpy()
        for part in (skeletal.centres, skeletal.radii, skeletal.weights, skeletal.samples, points)
    )
    edges, triangles = skeletal_mesh(centres, surface_points, graph.links[0].cpu().numpy(), predicted[0].cpu().numpy())
    if refine_radii:
        radii = _refined_radii(weights, nearest_pieces(samples, centres, edges, triangles)[0])
    return Skeleton(
        centres * prepared.scale + prepared.centre, radii * prepared.scale, edges=edges, triangles=triangles
    )


def _refined_radii(weights: FloatArray, distances: FloatArray) -> FloatArray:
    """Return the distances of the samples to the mesh, combined with the weights of the skeletal points."""
    radii: FloatArray = np.einsum("km,m->k", weights, distances)
    return radii
