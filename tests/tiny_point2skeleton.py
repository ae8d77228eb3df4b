"""The smallest sensible sizes of Point2Skeleton, shared by the tests."""

from morphoskel.networks.point2skeleton_settings import Point2SkeletonSettings

TINY = Point2SkeletonSettings(
    points=64,
    skeletal_points=12,
    centroids=(32, 16),
    radii=((0.3, 0.5), (0.8,)),
    neighbours=((4, 8), (8,)),
    channels=((8, 8), (16, 16)),
    head_channels=(16,),
    initial_sharpness=4.0,
    node_features=4,
    graph_channels=(8, 8, 8, 12),
    valid_neighbours=4,
    pretrain_epochs=2,
    skeleton_epochs=3,
    link_epochs=2,
    batch_size=2,
)
