"""The per-shape chain: one module a stage, each reading and writing files; the shard runs a stage on many shapes."""
