"""Run one stage of the chain, named like the rule, on a shard."""

from pathlib import Path

from morphoskel.chain.shard import run_shard
from morphoskel.logs import log_to

log_to(snakemake.log[0])
inputs = {name: Path(folder) for name, folder in snakemake.input.items() if name not in ("manifest", "network")}
settings = {name: value for name, value in snakemake.params.items() if name not in ("seed", "digest")}
if network := snakemake.input.get("network"):
    settings["network"] = network
run_shard(
    snakemake.rule,
    manifest=Path(snakemake.input.manifest),
    split=snakemake.wildcards.split,
    shard=int(snakemake.wildcards.shard),
    inputs=inputs,
    output=Path(snakemake.output[0]),
    settings=settings,
    seed=snakemake.params.seed,
    cores=snakemake.threads,
    threads=snakemake.resources.shape_threads,
    log=snakemake.log[0],
)
