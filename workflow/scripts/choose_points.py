"""Choose points of a split with one sampler."""

from pathlib import Path

import torch

from morphoskel.logs import log_to
from morphoskel.sampling.choose_for_split import choose_for_split

log_to(snakemake.log[0])
torch.set_num_threads(snakemake.threads)
choose_for_split(
    snakemake.wildcards.sampler,
    Path(snakemake.input.clouds),
    Path(snakemake.output[0]),
    networks=[Path(path) for path in snakemake.input.networks],
    priors=next(map(Path, snakemake.input.priors), None),
    ratios=snakemake.params.ratios,
    draws=snakemake.params.draws,
    seed=snakemake.params.seed,
    prior=snakemake.params.prior,
    lfs=snakemake.params.lfs,
)
