# From a data set on disk to its manifest.


rule write_config:
    output:
        "<results>/config.yaml",
    log:
        "<logs>/write_config.log",
    conda:
        "../../environment.yml"
    params:
        digest=content_hash(SECTIONS),
    script:
        "../scripts/write_config.py"


if CONFIG.dataset.kind == "synthetic":

    rule generate_synthetic:
        output:
            directory(section("dataset", "root")),
        log:
            f"resources/logs/generate_{CONFIG.dataset.name}.log",
        benchmark:
            f"resources/benchmarks/generate_{CONFIG.dataset.name}.tsv"
        conda:
            "../../environment.yml"
        threads: ALL_CORES
        resources:
            mem_mb=rising(2000),
            runtime=rising(120),
        params:
            dataset=section("dataset"),
            seed=CONFIG.seed,
            digest=code_digest("datasets.synthetic.generate"),
        script:
            "../scripts/generate_synthetic.py"


if CONFIG.parts and CONFIG.parts.kind == "synthetic":

    rule generate_synthetic_parts:
        output:
            directory(section("parts", "root")),
        log:
            f"resources/logs/generate_{CONFIG.parts.name}.log",
        benchmark:
            f"resources/benchmarks/generate_{CONFIG.parts.name}.tsv"
        priority: EARLY
        conda:
            "../../environment.yml"
        threads: ALL_CORES
        resources:
            mem_mb=rising(2000),
            runtime=rising(120),
        params:
            dataset=section("parts"),
            seed=CONFIG.seed,
            digest=code_digest("datasets.synthetic.generate"),
        script:
            "../scripts/generate_synthetic.py"


if getattr(CONFIG.dataset, "url", None) and not CONFIG.dataset.root.exists():

    rule download_dataset:
        output:
            directory(section("dataset", "root")),
        log:
            f"resources/logs/download_{CONFIG.dataset.name}.log",
        conda:
            "../../environment.yml"
        resources:
            mem_mb=rising(1000),
            runtime=rising(600),
        params:
            url=CONFIG.dataset.url,
            sha256=CONFIG.dataset.sha256,
        script:
            "../scripts/download_dataset.py"


if getattr(CONFIG.parts, "url", None) and not CONFIG.parts.root.exists():

    rule download_parts:
        output:
            directory(section("parts", "root")),
        log:
            f"resources/logs/download_{CONFIG.parts.name}.log",
        conda:
            "../../environment.yml"
        resources:
            mem_mb=rising(1000),
            runtime=rising(600),
        params:
            url=CONFIG.parts.url,
            sha256=CONFIG.parts.sha256,
        script:
            "../scripts/download_dataset.py"


rule write_manifest:
    input:
        dataset_source,
    output:
        "resources/manifest/{dataset}.csv",
    log:
        "resources/logs/manifest_{dataset}.log",
    benchmark:
        "resources/benchmarks/manifest_{dataset}.tsv"
    priority: EARLY
    conda:
        "../../environment.yml"
    resources:
        mem_mb=rising(1000),
        runtime=rising(60),
    params:
        dataset=dataset_section,
        seed=CONFIG.seed,
        shard_size=CONFIG.shard_size,
        counts=shape_counts,
        digest=code_digest("datasets.manifest", "datasets.registry"),
    script:
        "../scripts/write_manifest.py"
