# Seconds a stage, measured in one process, stage after stage, never from cached results.


rule time_stages:
    input:
        manifest="resources/manifest/{dataset}.csv",
    output:
        "<results>/timing/{dataset}/{split}/{surface}.csv",
    log:
        "<logs>/time_stages/{dataset}/{split}/{surface}.log",
    benchmark:
        "<benchmarks>/time_stages/{dataset}/{split}/{surface}.tsv"
    conda:
        "../../environment.yml"
    # All cores, so that no other job disturbs the measurement.
    threads: ALL_CORES
    resources:
        mem_mb=rising(MEMORY),
        runtime=rising(240),
    params:
        dataset=dataset_section,
        reconstruction=reconstruction,
        watertight=section("watertight"),
        skeleton=section("skeleton"),
        timing=section("timing"),
        seed=CONFIG.seed,
        digest=code_digest("evaluation.timing"),
    script:
        "../scripts/time_stages.py"
