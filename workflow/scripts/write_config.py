"""Write the resolved configuration beside the results."""

from pathlib import Path

from omegaconf import OmegaConf

from morphoskel.atomic import atomic_file
from morphoskel.logs import log_to

log_to(snakemake.log[0])
with atomic_file(Path(snakemake.output[0])) as path:
    OmegaConf.save(OmegaConf.create(snakemake.params.config), path)
