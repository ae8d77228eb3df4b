"""Measure how far the points of a split are from the skeletons of their shapes."""

from pathlib import Path

from morphoskel.datasets.cloud_set import read_cloud_set
from morphoskel.logs import log_to
from morphoskel.sampling.prior_set import check_priors, measure_local_feature_sizes, write_prior_set

log_to(snakemake.log[0])
clouds = read_cloud_set(Path(snakemake.input.clouds))
priors = measure_local_feature_sizes(clouds, [Path(folder) for folder in snakemake.input.skeletons])
check_priors(priors, snakemake.params.max_failed)
write_prior_set(priors, Path(snakemake.output[0]))
