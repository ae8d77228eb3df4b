"""Write the resolved configuration beside the results."""

from pathlib import Path

from omegaconf import OmegaConf

from morphoskel.atomic import atomic_file
from morphoskel.config import compose
from morphoskel.logs import log_to

log_to(snakemake.log[0])
config = compose(snakemake.config.get("overrides", []))
with atomic_file(Path(snakemake.output[0])) as path:
    OmegaConf.save(OmegaConf.create(config.model_dump(mode="json")), path)
