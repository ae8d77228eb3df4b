"""Make the embedded data set."""

from morphoskel.datasets.configured import open_configured
from morphoskel.datasets.synthetic import write_shapes
from morphoskel.logs import log_to

log_to(snakemake.log[0])
dataset = open_configured(snakemake.params.dataset, seed=snakemake.params.seed)
write_shapes(dataset, workers=snakemake.threads, progress=True)
