# The per-shape chain. Every rule runs one stage on a shard of shapes; the stages are modules of morphoskel.chain.


rule reconstruct:
    input:
        manifest="resources/manifest/{dataset}.csv",
    output:
        directory("<results>/surfaces/{dataset}/{split}/{surface}/{shard}"),
    log:
        "<logs>/reconstruct/{dataset}/{split}/{surface}/{shard}.log",
    benchmark:
        "<benchmarks>/reconstruct/{dataset}/{split}/{surface}/{shard}.tsv"
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
        surface="{surface}",
        reconstruction=reconstruction,
        seed=CONFIG.seed,
        digest=code_digest("chain.shard", "chain.reconstruct"),
    script:
        "../scripts/run_stage.py"


rule watertight:
    input:
        manifest="resources/manifest/{dataset}.csv",
        reconstruct=rules.reconstruct.output[0],
    output:
        directory("<results>/watertight/{dataset}/{split}/{surface}/{shard}"),
    log:
        "<logs>/watertight/{dataset}/{split}/{surface}/{shard}.log",
    benchmark:
        "<benchmarks>/watertight/{dataset}/{split}/{surface}/{shard}.tsv"
    conda:
        "../../environment.yml"
    threads: CONFIG.cores
    resources:
        mem_mb=rising(MEMORY),
        runtime=rising(MINUTES),
        shape_threads=CONFIG.threads,
    params:
        watertight=watertight,
        seed=CONFIG.seed,
        digest=code_digest("chain.shard", "chain.watertight"),
    script:
        "../scripts/run_stage.py"


rule occupancy:
    input:
        manifest="resources/manifest/{dataset}.csv",
        watertight=rules.watertight.output[0],
    output:
        intermediate("<results>/occupancy/{dataset}/{split}/{surface}/{shard}"),
    log:
        "<logs>/occupancy/{dataset}/{split}/{surface}/{shard}.log",
    benchmark:
        "<benchmarks>/occupancy/{dataset}/{split}/{surface}/{shard}.tsv"
    conda:
        "../../environment.yml"
    threads: CONFIG.cores
    resources:
        mem_mb=rising(MEMORY),
        runtime=rising(MINUTES),
        shape_threads=CONFIG.threads,
    params:
        candidates=candidates,
        seed=CONFIG.seed,
        digest=code_digest("chain.shard", "chain.occupancy"),
    script:
        "../scripts/run_stage.py"


rule udf:
    input:
        manifest="resources/manifest/{dataset}.csv",
        watertight=rules.watertight.output[0],
        occupancy=rules.occupancy.output[0],
    output:
        intermediate("<results>/udf/{dataset}/{split}/{surface}/{shard}"),
    log:
        "<logs>/udf/{dataset}/{split}/{surface}/{shard}.log",
    benchmark:
        "<benchmarks>/udf/{dataset}/{split}/{surface}/{shard}.tsv"
    conda:
        "../../environment.yml"
    threads: CONFIG.cores
    resources:
        mem_mb=rising(MEMORY),
        runtime=rising(MINUTES),
        shape_threads=CONFIG.threads,
    params:
        candidates=candidates,
        seed=CONFIG.seed,
        digest=code_digest("chain.shard", "chain.udf"),
    script:
        "../scripts/run_stage.py"


rule dilation:
    input:
        manifest="resources/manifest/{dataset}.csv",
        occupancy=rules.occupancy.output[0],
        udf=rules.udf.output[0],
    output:
        intermediate("<results>/dilation/{dataset}/{split}/{surface}/{shard}"),
    log:
        "<logs>/dilation/{dataset}/{split}/{surface}/{shard}.log",
    benchmark:
        "<benchmarks>/dilation/{dataset}/{split}/{surface}/{shard}.tsv"
    conda:
        "../../environment.yml"
    threads: CONFIG.cores
    resources:
        mem_mb=rising(MEMORY),
        runtime=rising(MINUTES),
        shape_threads=CONFIG.threads,
    params:
        candidates=candidates,
        k=CONFIG.skeleton.k,
        seed=CONFIG.seed,
        digest=code_digest("chain.shard", "chain.dilation"),
    script:
        "../scripts/run_stage.py"


rule select_skeleton:
    input:
        manifest="resources/manifest/{dataset}.csv",
        occupancy=rules.occupancy.output[0],
        udf=rules.udf.output[0],
        dilation=rules.dilation.output[0],
    output:
        directory("<results>/skeletons/{dataset}/{split}/{surface}/ms3d/{shard}"),
    log:
        "<logs>/select_skeleton/{dataset}/{split}/{surface}/{shard}.log",
    benchmark:
        "<benchmarks>/select_skeleton/{dataset}/{split}/{surface}/{shard}.tsv"
    conda:
        "../../environment.yml"
    threads: CONFIG.cores
    resources:
        mem_mb=rising(MEMORY),
        runtime=rising(MINUTES),
        shape_threads=CONFIG.threads,
    params:
        candidates=candidates,
        points=CONFIG.skeleton.points,
        seed=CONFIG.seed,
        digest=code_digest("chain.shard", "chain.select_skeleton"),
    script:
        "../scripts/run_stage.py"


rule cover_skeleton:
    input:
        manifest="resources/manifest/{dataset}.csv",
        occupancy=rules.occupancy.output[0],
        udf=rules.udf.output[0],
        dilation=rules.dilation.output[0],
    output:
        directory(
            "<results>/skeletons/{dataset}/{split}/{surface}/ms3d_coverage/{shard}"
        ),
    log:
        "<logs>/cover_skeleton/{dataset}/{split}/{surface}/{shard}.log",
    benchmark:
        "<benchmarks>/cover_skeleton/{dataset}/{split}/{surface}/{shard}.tsv"
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
        k=CONFIG.skeleton.k,
        points=CONFIG.skeleton.points,
        coverage=section("skeleton", "coverage"),
        seed=CONFIG.seed,
        digest=code_digest("chain.shard", "chain.cover_skeleton"),
    script:
        "../scripts/run_stage.py"
