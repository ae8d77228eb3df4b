"""Fetch a public data set and unpack it."""

from pathlib import Path

from morphoskel.datasets.address import archive_name
from morphoskel.datasets.download import download, extract
from morphoskel.logs import log_to

log_to(snakemake.log[0])
root = Path(snakemake.output[0])
archive = root.with_name(archive_name(snakemake.params.url))
download(snakemake.params.url, archive, sha256=snakemake.params.sha256)
extract(archive, root)
