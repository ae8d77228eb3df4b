"""List the shapes of a data set, cut them into shards and take their checksums."""

from pathlib import Path

from morphoskel.datasets.configured import check_plan, open_configured
from morphoskel.datasets.manifest import build_manifest, write_manifest
from morphoskel.logs import log_to

log_to(snakemake.log[0])
dataset = open_configured(snakemake.params.dataset, seed=snakemake.params.seed)
entries = dataset.list_shapes()
check_plan(entries, snakemake.params.counts)
write_manifest(
    Path(snakemake.output[0]), build_manifest(entries, shard_size=snakemake.params.shard_size, progress=True)
)
