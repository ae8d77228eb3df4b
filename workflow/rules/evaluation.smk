# Distances between each skeleton's balls and the cloud that it was made from.


rule evaluate_skeletons:
    input:
        manifest="resources/manifest/{dataset}.csv",
        skeletons=skeleton_shards,
    output:
        "<results>/evaluation/{dataset}/{split}/{surface}.csv",
    log:
        "<logs>/evaluate_skeletons/{dataset}/{split}/{surface}.log",
    benchmark:
        "<benchmarks>/evaluate_skeletons/{dataset}/{split}/{surface}.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=1000,
        runtime=60,
    params:
        dataset=section("dataset"),
        seed=CONFIG.seed,
        max_failed=CONFIG.max_failed,
        digest=code_digest("evaluation.skeletons"),
    script:
        "../scripts/evaluate_skeletons.py"
