"""The smallest sensible sizes of the skeleton-aware networks, shared by the tests."""

from morphoskel.networks.skeleton_aware_settings import SkeletonAwareSettings
from morphoskel.networks.skeleton_sampler_settings import SkeletonSamplerSettings

TINY_SAMPLER = SkeletonSamplerSettings(
    k=4,
    channels=(8, 8),
    global_features=16,
    head=(16, 8),
    dropout=0.5,
    batch_size=2,
    epochs=2,
    learning_rate=1e-2,
    temperature_start=1.0,
    temperature_end=0.5,
    temperature_annealed_share=0.8,
    temperature_every=2,
    task_penalty=0.001,
)

TINY_SKELETON = SkeletonAwareSettings(
    skeletal_points=6,
    neighbourhood="delaunay",
    neighbours=9,
    hops=2,
    k=4,
    channels=(8, 8),
    global_features=16,
    head=(16, 8),
    weight_channels=(8, 8),
    initial_scale=1.0,
    batch_size=2,
    pretrain_epochs=2,
    skeleton_epochs=3,
    learning_rate=1e-2,
    pretrain_weight=1e-4,
    point_to_sphere_weight=0.3,
    radius_weight=0.4,
)
