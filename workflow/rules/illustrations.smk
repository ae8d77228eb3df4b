# Figures of the method itself, on shapes of which all that lies between the stages is kept.


rule illustrate:
    input:
        overview_source(),
    output:
        "<results>/illustrations/{shape}_{mode}_{candidates}.npz",
    log:
        "<logs>/illustrate/{shape}_{mode}_{candidates}.log",
    benchmark:
        "<benchmarks>/illustrate/{shape}_{mode}_{candidates}.tsv"
    conda:
        "../../environment.yml"
    threads: CONFIG.cores
    resources:
        mem_mb=lambda wildcards, attempt: attempt
        * (1500 + int(wildcards.candidates) * 400 // 1_000_000),
        runtime=rising(60),
    params:
        overview=CONFIG.figures.overview,
        skeleton=section("skeleton"),
        watertight=section("watertight"),
        seed=CONFIG.seed,
        digest=code_digest("reporting.illustration_file"),
    script:
        "../scripts/illustrate.py"


rule measure_scaling:
    input:
        illustration(OVERVIEW),
    output:
        "<results>/timing/scaling.csv",
    log:
        "<logs>/measure_scaling.log",
    benchmark:
        "<benchmarks>/measure_scaling.tsv"
    conda:
        "../../environment.yml"
    # All cores, so that no other job disturbs the measurement.
    threads: ALL_CORES
    resources:
        mem_mb=rising(1500 + max(CONFIG.figures.scaling) * 400 // 1_000_000),
        runtime=rising(60),
    params:
        counts=CONFIG.figures.scaling,
        repeats=CONFIG.figures.repeats,
        k=CONFIG.skeleton.k,
        seed=CONFIG.seed,
        digest=code_digest("evaluation.scaling"),
    script:
        "../scripts/measure_scaling.py"


rule figure_overview:
    input:
        flat({"illustration": illustration(OVERVIEW)}),
    output:
        png=report(
            "<results>/figures/overview.png",
            caption="../report/overview.rst",
            category="Figures",
            subcategory="Method",
            labels={"figure": "the pipeline"},
        ),
        pdf="<results>/figures/overview.pdf",
    log:
        "<logs>/figure_overview.log",
    benchmark:
        "<benchmarks>/figure_overview.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=rising(2000),
        runtime=rising(60),
    params:
        figure="overview",
        files={"illustration": illustration(OVERVIEW)},
        values={},
        numbers=numbers("overview"),
        digest=code_digest("reporting.figures.overview"),
    script:
        "../scripts/draw_figure.py"


use rule figure_overview as figure_occupancy with:
    input:
        flat(
            {
                "few": illustration(OVERVIEW, count=CONFIG.figures.sparse),
                "many": illustration(OVERVIEW),
            }
        ),
    output:
        png=report(
            "<results>/figures/occupancy.png",
            caption="../report/occupancy.rst",
            category="Figures",
            subcategory="Method",
            labels={"figure": "occupancy"},
        ),
        pdf="<results>/figures/occupancy.pdf",
    log:
        "<logs>/figure_occupancy.log",
    benchmark:
        "<benchmarks>/figure_occupancy.tsv"
    params:
        figure="occupancy",
        files={
            "few": illustration(OVERVIEW, count=CONFIG.figures.sparse),
            "many": illustration(OVERVIEW),
        },
        values={},
        numbers=numbers("occupancy"),
        digest=code_digest("reporting.figures.occupancy"),


use rule figure_overview as figure_dilation with:
    input:
        flat({"illustration": illustration(OVERVIEW)}),
    output:
        png=report(
            "<results>/figures/dilation.png",
            caption="../report/dilation.rst",
            category="Figures",
            subcategory="Method",
            labels={"figure": "UDF and dilation"},
        ),
        pdf="<results>/figures/dilation.pdf",
    log:
        "<logs>/figure_dilation.log",
    benchmark:
        "<benchmarks>/figure_dilation.tsv"
    params:
        figure="dilation",
        files={"illustration": illustration(OVERVIEW)},
        values={},
        numbers=numbers("dilation"),
        digest=code_digest("reporting.figures.dilation"),


use rule figure_overview as figure_residue with:
    input:
        flat({"illustration": illustration(OVERVIEW)}),
    output:
        png=report(
            "<results>/figures/residue.png",
            caption="../report/residue.rst",
            category="Figures",
            subcategory="Method",
            labels={"figure": "residue and skeleton"},
        ),
        pdf="<results>/figures/residue.pdf",
    log:
        "<logs>/figure_residue.log",
    benchmark:
        "<benchmarks>/figure_residue.tsv"
    params:
        figure="residue",
        files={"illustration": illustration(OVERVIEW)},
        values={},
        numbers=numbers("residue"),
        digest=code_digest("reporting.figures.residue"),


use rule figure_overview as figure_candidates with:
    input:
        flat(
            {
                "few": illustration(OVERVIEW),
                "many": illustration(OVERVIEW, count=CONFIG.figures.dense),
            }
        ),
    output:
        png=report(
            "<results>/figures/candidates.png",
            caption="../report/candidates.rst",
            category="Figures",
            subcategory="Method",
            labels={"figure": "more candidates"},
        ),
        pdf="<results>/figures/candidates.pdf",
    log:
        "<logs>/figure_candidates.log",
    benchmark:
        "<benchmarks>/figure_candidates.tsv"
    params:
        figure="candidates",
        files={
            "few": illustration(OVERVIEW),
            "many": illustration(OVERVIEW, count=CONFIG.figures.dense),
        },
        values={},
        numbers=numbers("candidates"),
        digest=code_digest("reporting.figures.candidates"),


use rule figure_overview as figure_rationale with:
    input:
        flat(rationale_illustrations()),
    output:
        png=report(
            "<results>/figures/rationale.png",
            caption="../report/rationale.rst",
            category="Figures",
            subcategory="Method",
            labels={"figure": "torus and box"},
        ),
        pdf="<results>/figures/rationale.pdf",
    log:
        "<logs>/figure_rationale.log",
    benchmark:
        "<benchmarks>/figure_rationale.tsv"
    params:
        figure="rationale",
        files=rationale_illustrations(),
        values={},
        numbers=numbers("rationale"),
        digest=code_digest("reporting.figures.rationale"),
