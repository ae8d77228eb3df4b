"""Classify the points that a sampler chose, and retrieve shapes by them."""

from pathlib import Path

import torch

from morphoskel.evaluation.sampled_shapes import evaluate_files
from morphoskel.logs import log_to

log_to(snakemake.log[0])
torch.set_num_threads(snakemake.threads)
evaluate_files(
    snakemake.wildcards.sampler,
    Path(snakemake.input.clouds),
    next(map(Path, snakemake.input.samples), None),
    next(map(Path, snakemake.input.priors), None),
    {"dropout": Path(snakemake.input.classifiers[0]), "plain": Path(snakemake.input.classifiers[1])},
    (Path(snakemake.output.shapes), Path(snakemake.output.draws)),
)
