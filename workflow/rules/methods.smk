# The skeleton methods that MorphoSkel3D is compared with. Each is a stage that runs on a shard, like those of the chain.


rule coverage_axis:
    input:
        manifest="resources/manifest/{dataset}.csv",
        occupancy=rules.occupancy.output[0],
    output:
        directory(
            "<results>/skeletons/{dataset}/{split}/{surface}/coverage_axis/{shard}"
        ),
    log:
        "<logs>/coverage_axis/{dataset}/{split}/{surface}/{shard}.log",
    benchmark:
        "<benchmarks>/coverage_axis/{dataset}/{split}/{surface}/{shard}.tsv"
    conda:
        "../../environment.yml"
    threads: CONFIG.cores
    resources:
        mem_mb=rising(MEMORY),
        runtime=rising(MINUTES),
        shape_threads=CONFIG.threads,
    params:
        dataset=dataset_section,
        dataset_seed=CONFIG.seed,
        candidates=candidates,
        coverage_axis=section("methods", "coverage_axis"),
        seed=CONFIG.seed,
        digest=code_digest("chain.shard", "chain.coverage_axis"),
    script:
        "../scripts/run_stage.py"


rule l1_medial:
    input:
        manifest="resources/manifest/{dataset}.csv",
    output:
        directory("<results>/skeletons/{dataset}/{split}/cloud/l1_medial/{shard}"),
    log:
        "<logs>/l1_medial/{dataset}/{split}/{shard}.log",
    benchmark:
        "<benchmarks>/l1_medial/{dataset}/{split}/{shard}.tsv"
    conda:
        "../../environment.yml"
    threads: CONFIG.cores
    resources:
        mem_mb=rising(MEMORY),
        runtime=rising(MINUTES),
        shape_threads=CONFIG.threads,
    params:
        dataset=dataset_section,
        dataset_seed=CONFIG.seed,
        l1_medial=section("methods", "l1_medial"),
        seed=CONFIG.seed,
        digest=code_digest("chain.shard", "chain.l1_medial"),
    script:
        "../scripts/run_stage.py"


rule dpc:
    input:
        manifest="resources/manifest/{dataset}.csv",
    output:
        directory("<results>/skeletons/{dataset}/{split}/cloud/dpc/{shard}"),
    log:
        "<logs>/dpc/{dataset}/{split}/{shard}.log",
    benchmark:
        "<benchmarks>/dpc/{dataset}/{split}/{shard}.tsv"
    conda:
        "../../environment.yml"
    threads: CONFIG.cores
    resources:
        mem_mb=rising(MEMORY),
        runtime=rising(MINUTES),
        shape_threads=CONFIG.threads,
    params:
        dataset=dataset_section,
        dataset_seed=CONFIG.seed,
        dpc=section("methods", "dpc"),
        seed=CONFIG.seed,
        digest=code_digest("chain.shard", "chain.dpc"),
    script:
        "../scripts/run_stage.py"


if CONFIG.methods.point2skeleton:

    rule point2skeleton:
        input:
            manifest="resources/manifest/{dataset}.csv",
            network=CONFIG.methods.point2skeleton.trained
            or rules.train_point2skeleton.output[0],
        output:
            directory(
                "<results>/skeletons/{dataset}/{split}/cloud/point2skeleton/{shard}"
            ),
        log:
            "<logs>/point2skeleton/{dataset}/{split}/{shard}.log",
        benchmark:
            "<benchmarks>/point2skeleton/{dataset}/{split}/{shard}.tsv"
        conda:
            "../../environment.yml"
        threads: CONFIG.cores
        resources:
            mem_mb=rising(MEMORY),
            runtime=rising(MINUTES),
            shape_threads=CONFIG.threads,
        params:
            dataset=dataset_section,
            dataset_seed=CONFIG.seed,
            refine_radii=CONFIG.methods.point2skeleton.refine_radii,
            seed=CONFIG.seed,
            digest=code_digest("chain.shard", "chain.point2skeleton"),
        script:
            "../scripts/run_stage.py"
