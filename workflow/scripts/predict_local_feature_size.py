"""Measure how far the points of a split are from the skeletons that a network predicts."""

from pathlib import Path

from morphoskel.learning.skeleton_aware_training import predict_local_feature_sizes
from morphoskel.logs import log_to
from morphoskel.sampling.prior_set import write_prior_set

log_to(snakemake.log[0])
priors = predict_local_feature_sizes(
    Path(snakemake.input.clouds), Path(snakemake.input.network), threads=snakemake.threads
)
write_prior_set(priors, Path(snakemake.output[0]))
