"""Segment clouds by every network that learned from the labels which one strategy chose."""

from pathlib import Path

import torch

from morphoskel.evaluation.segmentation import evaluate_segmentation_files
from morphoskel.logs import log_to

log_to(snakemake.log[0])
torch.set_num_threads(snakemake.threads)
evaluate_segmentation_files(
    snakemake.wildcards.strategy,
    Path(snakemake.input.clouds),
    [Path(path) for path in snakemake.input.networks],
    [Path(path) for path in snakemake.input.training_clouds],
    [Path(path) for path in snakemake.input.samples],
    Path(snakemake.output[0]),
    completed=snakemake.params.completed,
    label_sets=snakemake.params.label_sets,
)
