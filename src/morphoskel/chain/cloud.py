"""The cloud of a shape, for the stages that read it."""

from morphoskel.chain.task import Task
from morphoskel.datasets.configured import open_configured
from morphoskel.shapes import PointCloud


def read_cloud(task: Task) -> PointCloud:
    """Return the shape's cloud, read from the configured data set."""
    return open_configured(task.settings["dataset"], seed=task.settings["dataset_seed"]).load(task.record.path)
