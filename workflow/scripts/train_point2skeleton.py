"""Train Point2Skeleton on the training split; checkpoints stay beside the network, so a killed training goes on."""

from pathlib import Path

from morphoskel.learning.point2skeleton_training import train_on_split
from morphoskel.logs import log_to

log_to(snakemake.log[0])
train_on_split(
    Path(snakemake.input.manifest),
    Path(snakemake.output[0]),
    Path(snakemake.params.checkpoints),
    dataset=snakemake.params.dataset,
    seed=snakemake.params.seed,
    network=snakemake.params.network,
    validation_share=snakemake.params.validation_share,
    accelerator=snakemake.params.accelerator,
    threads=snakemake.threads,
)
