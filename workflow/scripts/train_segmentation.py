"""Train networks for parts from the labels of chosen points; checkpoints stay, so a killed training goes on."""

from pathlib import Path

from morphoskel.learning.segmentation_training import train_segmentation_on_files
from morphoskel.logs import log_to

log_to(snakemake.log[0])
for result in map(Path, snakemake.output):
    strategy, ratio, number = result.parts[-4:-1]
    train_segmentation_on_files(
        strategy,
        int(ratio),
        int(number),
        [Path(path) for path in snakemake.input.clouds],
        [Path(path) for path in snakemake.input.samples],
        result,
        Path(snakemake.params.checkpoints) / strategy / ratio / number,
        seed=snakemake.params.seed,
        settings=snakemake.params.settings,
        validation_clouds=next(map(Path, snakemake.input.validation_clouds), None),
        validation_samples=next(map(Path, snakemake.input.validation_samples), None),
        **snakemake.params.learning,
        **snakemake.params.trainer,
    )
