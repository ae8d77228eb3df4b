"""Train a sampler for one ratio or several; checkpoints stay, so a killed training goes on."""

from pathlib import Path

from morphoskel.learning.sampler_training import train_sampler_on_files
from morphoskel.logs import log_to

log_to(snakemake.log[0])
for result in map(Path, snakemake.output):
    ratio, number = result.parts[-3:-1]
    train_sampler_on_files(
        snakemake.wildcards.sampler,
        Path(snakemake.input.clouds),
        [Path(path) for path in snakemake.input.classifiers],
        next(map(Path, snakemake.input.priors), None),
        result,
        Path(snakemake.params.checkpoints) / ratio / number,
        ratio=int(ratio),
        number=int(number),
        seed=snakemake.params.seed,
        settings=snakemake.params.settings,
        prior=snakemake.params.prior,
        steps=snakemake.params.steps,
        validation_share=snakemake.params.validation_share,
        **snakemake.params.trainer,
    )
