"""Train the skeleton network of the skeleton-aware sampler; checkpoints stay, so a killed training goes on."""

from pathlib import Path

from morphoskel.learning.skeleton_aware_training import train_skeleton_aware_on_files
from morphoskel.logs import log_to

log_to(snakemake.log[0])
train_skeleton_aware_on_files(
    Path(snakemake.input.clouds),
    Path(snakemake.output[0]),
    Path(snakemake.params.checkpoints),
    seed=snakemake.params.seed,
    settings=snakemake.params.settings,
    validation_share=snakemake.params.validation_share,
    **snakemake.params.trainer,
)
