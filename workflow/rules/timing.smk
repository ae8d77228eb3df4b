# Seconds a stage, measured in one process, stage after stage, never from cached results.


rule time_stages:
    input:
        manifest="resources/manifest/{dataset}.csv",
    output:
        "<results>/timing/{dataset}/{split}/{surface}.csv",
    params:
        dataset=section("dataset"),
        reconstruction=reconstruction,
        watertight=section("watertight"),
        skeleton=section("skeleton"),
        timing=section("timing"),
        seed=CONFIG.seed,
        digest=code_digest("evaluation.timing"),
    log:
        "<logs>/time_stages/{dataset}/{split}/{surface}.log",
    benchmark:
        "<benchmarks>/time_stages/{dataset}/{split}/{surface}.tsv"
    # All cores, so that no other job disturbs the measurement.
    threads: workflow.cores or 1
    resources:
        mem_mb=memory,
        runtime=240,
    script:
        "../scripts/time_stages.py"
