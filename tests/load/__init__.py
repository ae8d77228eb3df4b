"""The load test: as many shapes as ModelNet40 has through the chain in one run, interrupted twice. See docs/load.md."""
