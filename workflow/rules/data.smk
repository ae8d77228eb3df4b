# From a data set on disk to its manifest.


def dataset_source(wildcards):
    """Return the folder of the data set if it is there or a rule makes it; else the manifest job says what to fetch."""
    made = CONFIG.dataset.kind == "synthetic" or getattr(CONFIG.dataset, "url", None)
    return [ancient(section("dataset", "root"))] if made or CONFIG.dataset.root.exists() else []


rule write_config:
    output:
        "<results>/config.yaml",
    params:
        config=SECTIONS,
    log:
        "<logs>/write_config.log",
    script:
        "../scripts/write_config.py"


if CONFIG.dataset.kind == "synthetic":

    rule generate_synthetic:
        output:
            directory(section("dataset", "root")),
        params:
            dataset=section("dataset"),
            seed=CONFIG.seed,
            digest=code_digest("datasets.synthetic.generate"),
        log:
            f"resources/logs/generate_{CONFIG.dataset.name}.log",
        benchmark:
            f"resources/benchmarks/generate_{CONFIG.dataset.name}.tsv"
        threads: workflow.cores or 1
        resources:
            mem_mb=2000,
            runtime=120,
        script:
            "../scripts/generate_synthetic.py"


if getattr(CONFIG.dataset, "url", None) and not CONFIG.dataset.root.exists():

    rule download_dataset:
        output:
            directory(section("dataset", "root")),
        params:
            url=CONFIG.dataset.url,
            sha256=CONFIG.dataset.sha256,
        log:
            f"resources/logs/download_{CONFIG.dataset.name}.log",
        resources:
            mem_mb=500,
            runtime=600,
        script:
            "../scripts/download_dataset.py"


rule write_manifest:
    input:
        dataset_source,
    output:
        "resources/manifest/{dataset}.csv",
    params:
        dataset=section("dataset"),
        seed=CONFIG.seed,
        shard_size=CONFIG.shard_size,
        counts=SHAPES,
        digest=code_digest("datasets.manifest", "datasets.registry"),
    log:
        "resources/logs/manifest_{dataset}.log",
    benchmark:
        "resources/benchmarks/manifest_{dataset}.tsv"
    resources:
        mem_mb=500,
        runtime=60,
    script:
        "../scripts/write_manifest.py"
