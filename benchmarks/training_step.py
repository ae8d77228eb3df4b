"""Seconds of one training step of a sampling network, with edge convolutions as here and as commonly written."""

import json
import logging
import os
import subprocess
import sys
import time
from dataclasses import dataclass
from pathlib import Path
from statistics import median

import pandas as pd
import torch
from torch import nn

from benchmarks.naive_edge_convolution import NaiveEdgeFeatures
from benchmarks.surfaces import REPOSITORY
from morphoskel.networks.edge_features import EdgeFeatures

logger = logging.getLogger(__name__)

SMALLEST_RATIO = 3.0
LOSS_TOLERANCE = 1e-3
"""Of the first loss, relative: in single precision a few neighbours differ that are almost equally far."""


@dataclass(frozen=True)
class Sizes:
    """What is measured: batches of the training, layers of the network, and how often, in turn."""

    batch: int = 4
    points: int = 1024
    k: int = 20
    samples: int = 128
    channels: tuple[int, ...] = (64, 64, 128, 256)
    head: tuple[int, ...] = (512, 256)
    repeats: int = 15
    threads: int = 2


class MixingSampler(nn.Module):
    """Features of the points, and from them the weights of mixtures of points, which are the samples."""

    def __init__(self, features, width, samples):
        super().__init__()
        self.features = features
        self.weigh = nn.Linear(width, samples)

    def forward(self, points):
        """Map ``(B, N, 3)`` to ``(B, samples, 3)``."""
        return self.weigh(self.features(points)).transpose(1, 2).softmax(dim=2) @ points


class Training:
    """A network and its optimiser."""

    def __init__(self, features, sizes):
        self.network = MixingSampler(features, sizes.head[-1], sizes.samples)
        self.optimiser = torch.optim.Adam(self.network.parameters(), lr=1e-3)

    def step(self, points):
        """Do one step and return the loss before it."""
        self.optimiser.zero_grad()
        loss = self.network(points).square().mean()
        loss.backward()
        self.optimiser.step()
        return loss.item()


def make_trainings(sizes):
    """Return both trainings by name, from the same initial weights."""
    classes = {"naive": NaiveEdgeFeatures, "factorised": EdgeFeatures}
    trainings = {
        name: Training(features(channels=sizes.channels, k=sizes.k, head=sizes.head), sizes)
        for name, features in classes.items()
    }
    trainings["factorised"].network.load_state_dict(trainings["naive"].network.state_dict())
    return trainings


def measure(sizes):
    """Run both trainings in turn and return, by name, the first loss and the median of the seconds of a step."""
    torch.set_num_threads(sizes.threads)
    trainings = make_trainings(sizes)
    points = torch.rand(sizes.batch, sizes.points, 3, generator=torch.Generator().manual_seed(1)) * 2 - 1
    losses = {name: training.step(points) for name, training in trainings.items()}
    seconds = {name: [] for name in trainings}
    for _ in range(sizes.repeats):
        for name, training in trainings.items():
            start = time.perf_counter()
            training.step(points)
            seconds[name].append(time.perf_counter() - start)
    return {name: {"loss": losses[name], "seconds": median(seconds[name])} for name in trainings}


def write_table(measured, folder):
    """Write ``training_step.csv``; return whether both compute the same, and ours is fast enough."""
    naive, ours = measured["naive"], measured["factorised"]
    rows = [
        {"layer": name, "seconds": found["seconds"], "ratio": naive["seconds"] / found["seconds"]}
        for name, found in measured.items()
    ]
    frame = pd.DataFrame(rows)
    frame.to_csv(folder / "training_step.csv", index=False, float_format="%.4g")
    logger.info("%s", frame)
    same = abs(ours["loss"] / naive["loss"] - 1) < LOSS_TOLERANCE
    return bool(same and naive["seconds"] / ours["seconds"] >= SMALLEST_RATIO)


def run(folder: Path) -> bool:
    """Measure in a process of its own, whose threads sleep when they wait.

    Otherwise they would spin, and whatever else runs on the machine would be measured, too.
    """
    command = [sys.executable, "-m", "benchmarks.training_step"]
    environment = {**os.environ, "OMP_WAIT_POLICY": "passive"}
    done = subprocess.run(command, cwd=REPOSITORY, env=environment, check=True, capture_output=True, text=True)
    return write_table(json.loads(done.stdout), folder)


if __name__ == "__main__":
    sys.stdout.write(json.dumps(measure(Sizes())))
