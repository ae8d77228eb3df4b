"""Train networks for parts from the labels of chosen points; checkpoints stay, so a killed training goes on."""

from pathlib import Path

from morphoskel.learning.segmentation_training import train_segmentation_on_files
from morphoskel.logs import log_to

log_to(snakemake.log[0])
for number, result in enumerate(snakemake.output):
    train_segmentation_on_files(
        snakemake.wildcards.strategy,
        int(snakemake.wildcards.ratio),
        number,
        [Path(path) for path in snakemake.input.clouds],
        [Path(path) for path in snakemake.input.samples],
        Path(result),
        Path(snakemake.params.checkpoints),
        seed=snakemake.params.seed,
        settings=snakemake.params.settings,
        validation_clouds=next(map(Path, snakemake.input.validation_clouds), None),
        validation_samples=next(map(Path, snakemake.input.validation_samples), None),
        **snakemake.params.learning,
        **snakemake.params.trainer,
    )
