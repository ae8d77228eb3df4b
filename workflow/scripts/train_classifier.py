"""Train a classifier; checkpoints stay, so a killed training goes on."""

from pathlib import Path

from morphoskel.learning.classifier_training import train_classifier_on_files
from morphoskel.logs import log_to

log_to(snakemake.log[0])
train_classifier_on_files(
    snakemake.wildcards.classifier,
    Path(snakemake.input.clouds),
    Path(snakemake.output[0]),
    Path(snakemake.params.checkpoints),
    seed=snakemake.params.seed,
    settings=snakemake.params.settings,
    validation_share=snakemake.params.validation_share,
    **snakemake.params.trainer,
)
