# Charts of what the tables hold.


rule figure_distances:
    input:
        flat({"table": f"{RESULTS}/tables/skeleton_reconstruction.csv"}),
    output:
        png=report(
            "<results>/figures/distances.png",
            caption="../report/distances.rst",
            category="Figures",
            subcategory="Charts",
            labels={"figure": "distances of methods"},
        ),
        pdf="<results>/figures/distances.pdf",
    log:
        "<logs>/figure_distances.log",
    benchmark:
        "<benchmarks>/figure_distances.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=rising(2000),
        runtime=rising(60),
    params:
        figure="distances",
        files={"table": f"{RESULTS}/tables/skeleton_reconstruction.csv"},
        values={"kind": "skeletons"},
        numbers=numbers("distances"),
        digest=code_digest("reporting.figures.distances"),
    script:
        "../scripts/draw_figure.py"


use rule figure_distances as figure_surface_distances with:
    input:
        flat({"table": f"{RESULTS}/tables/surface_reconstruction.csv"}),
    output:
        png=report(
            "<results>/figures/surface_distances.png",
            caption="../report/surface_distances.rst",
            category="Figures",
            subcategory="Charts",
            labels={"figure": "distances of surface reconstructions"},
        ),
        pdf="<results>/figures/surface_distances.pdf",
    log:
        "<logs>/figure_surface_distances.log",
    benchmark:
        "<benchmarks>/figure_surface_distances.tsv"
    params:
        figure="distances",
        files={"table": f"{RESULTS}/tables/surface_reconstruction.csv"},
        values={"kind": "surfaces"},
        numbers=numbers("surface_distances"),
        digest=code_digest("reporting.figures.distances"),


use rule figure_distances as figure_stage_times with:
    input:
        flat(
            {
                "times": list(map(str, rules.table_processing_time.input.rows)),
                "published_folder": str(CLONE / "config/paper"),
            }
        ),
    output:
        png=report(
            "<results>/figures/stage_times.png",
            caption="../report/stage_times.rst",
            category="Figures",
            subcategory="Charts",
            labels={"figure": "time of every stage"},
        ),
        pdf="<results>/figures/stage_times.pdf",
    log:
        "<logs>/figure_stage_times.log",
    benchmark:
        "<benchmarks>/figure_stage_times.tsv"
    params:
        figure="stage_times",
        module="stage_times_files",
        files={
            "times": list(map(str, rules.table_processing_time.input.rows)),
            "published_folder": str(CLONE / "config/paper"),
        },
        values={},
        numbers=numbers("stage_times"),
        digest=code_digest("reporting.figures.stage_times_files"),


use rule figure_distances as figure_scaling with:
    input:
        flat({"times": f"{RESULTS}/timing/scaling.csv"}),
    output:
        png=report(
            "<results>/figures/scaling.png",
            caption="../report/scaling.rst",
            category="Figures",
            subcategory="Charts",
            labels={"figure": "time by candidates"},
        ),
        pdf="<results>/figures/scaling.pdf",
    log:
        "<logs>/figure_scaling.log",
    benchmark:
        "<benchmarks>/figure_scaling.tsv"
    params:
        figure="scaling",
        files={"times": f"{RESULTS}/timing/scaling.csv"},
        values={},
        numbers=numbers("scaling"),
        digest=code_digest("reporting.figures.scaling"),


if samplers():

    use rule figure_distances as figure_accuracy with:
        input:
            flat(scores("object_classification", "skeleton_prior")),
        output:
            png=report(
                "<results>/figures/accuracy.png",
                caption="../report/accuracy.rst",
                category="Figures",
                subcategory="Charts",
                labels={"figure": "accuracy"},
            ),
            pdf="<results>/figures/accuracy.pdf",
        log:
            "<logs>/figure_accuracy.log",
        benchmark:
            "<benchmarks>/figure_accuracy.tsv"
        params:
            figure="against_ratio",
            files=scores("object_classification", "skeleton_prior"),
            values={"metric": "oa", "cloud_points": CONFIG.sampling.points},
            numbers=numbers("accuracy"),
            digest=code_digest("reporting.figures.against_ratio"),


if samplers():

    use rule figure_distances as figure_retrieval with:
        input:
            flat(scores("point_cloud_retrieval")),
        output:
            png=report(
                "<results>/figures/retrieval.png",
                caption="../report/retrieval.rst",
                category="Figures",
                subcategory="Charts",
                labels={"figure": "retrieval"},
            ),
            pdf="<results>/figures/retrieval.pdf",
        log:
            "<logs>/figure_retrieval.log",
        benchmark:
            "<benchmarks>/figure_retrieval.tsv"
        params:
            figure="against_ratio",
            files=scores("point_cloud_retrieval"),
            values={"metric": "map", "cloud_points": CONFIG.sampling.points},
            numbers=numbers("retrieval"),
            digest=code_digest("reporting.figures.against_ratio"),


if strategies():

    use rule figure_distances as figure_labels with:
        input:
            flat({"table": f"{RESULTS}/tables/part_segmentation.csv"}),
        output:
            png=report(
                "<results>/figures/labels.png",
                caption="../report/labels.rst",
                category="Figures",
                subcategory="Charts",
                labels={"figure": "parts by number of labels"},
            ),
            pdf="<results>/figures/labels.pdf",
        log:
            "<logs>/figure_labels.log",
        benchmark:
            "<benchmarks>/figure_labels.tsv"
        params:
            figure="labels",
            files={"table": f"{RESULTS}/tables/part_segmentation.csv"},
            values={},
            numbers=numbers("labels"),
            digest=code_digest("reporting.figures.labels"),
