# Reference axes, and distances between each skeleton, the cloud that it was made from, and the axis.


rule medial_axis:
    input:
        **(
            {}
            if CONFIG.medial_axis.folder
            else {
                "watertight": f"<results>/watertight/{{dataset}}/{{split}}/{CONFIG.medial_axis.surface}/{{shard}}"
            }
        ),
        manifest="resources/manifest/{dataset}.csv",
    output:
        directory(AXES),
    log:
        "<logs>/medial_axis/{dataset}/{split}/{shard}.log",
    benchmark:
        "<benchmarks>/medial_axis/{dataset}/{split}/{shard}.tsv"
    conda:
        "../../environment.yml"
    threads: CONFIG.cores
    resources:
        mem_mb=rising(MEMORY),
        runtime=rising(MINUTES),
        shape_threads=CONFIG.threads,
    params:
        medial_axis=section("medial_axis"),
        seed=CONFIG.seed,
        digest=code_digest("chain.shard", "chain.medial_axis"),
    script:
        "../scripts/run_stage.py"


rule evaluate_skeletons:
    input:
        manifest="resources/manifest/{dataset}.csv",
        skeletons=skeleton_shards,
        axes=axis_shards,
    output:
        EVALUATION,
    log:
        "<logs>/evaluate_skeletons/{dataset}/{split}/{surface}/{skeleton}.log",
    benchmark:
        "<benchmarks>/evaluate_skeletons/{dataset}/{split}/{surface}/{skeleton}.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=rising(1000),
        runtime=rising(120),
    params:
        dataset=dataset_section,
        balls=evaluated_balls,
        seed=CONFIG.seed,
        max_failed=CONFIG.max_failed,
        digest=code_digest("evaluation.skeletons"),
    script:
        "../scripts/evaluate_skeletons.py"
