"""The smallest sensible sizes of a generator of points, shared by the tests."""

from morphoskel.networks.generator_settings import GeneratorSettings

TINY = GeneratorSettings(
    point_channels=(8, 16),
    head_channels=(16,),
    normalise_output=True,
    neighbours=3,
    least_sigma=0.0,
    task_weight=1.0,
    task_penalty=0.001,
    alpha=30.0,
    gamma=1.0,
    delta=0.0,
    projection_weight=1.0,
    augmentation="none",
    epochs=3,
    batch_size=4,
    learning_rate=0.01,
    decay=0.7,
    least_learning_rate=1e-5,
    momentum=0.5,
    momentum_decay=0.5,
    least_momentum=0.01,
    decay_share=0.122,
)
