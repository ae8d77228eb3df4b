# The paper's tables: paper | ours | difference, each as CSV, Markdown and LaTeX.


rule table_skeleton_reconstruction:
    input:
        rows=evaluations(skeleton_methods()),
        published=CLONE / "config/paper/skeleton_reconstruction.csv",
        counts=CLONE / "config/paper/processing_time.csv",
    output:
        csv="<results>/tables/skeleton_reconstruction.csv",
        tex="<results>/tables/skeleton_reconstruction.tex",
        md=report(
            "<results>/tables/skeleton_reconstruction.md",
            caption="../report/skeleton_reconstruction.rst",
            category="Tables",
        ),
    log:
        "<logs>/table_skeleton_reconstruction.log",
    benchmark:
        "<benchmarks>/table_skeleton_reconstruction.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=rising(1000),
        runtime=rising(10),
    params:
        provenance=provenance(),
        digest=code_digest("reporting.skeleton_table_files"),
    script:
        "../scripts/write_table.py"


rule table_surface_reconstruction:
    input:
        rows=evaluations(surface_methods()),
        published=CLONE / "config/paper/surface_reconstruction_ablation.csv",
        counts=CLONE / "config/paper/processing_time.csv",
    output:
        csv="<results>/tables/surface_reconstruction.csv",
        tex="<results>/tables/surface_reconstruction.tex",
        md=report(
            "<results>/tables/surface_reconstruction.md",
            caption="../report/surface_reconstruction.rst",
            category="Tables",
        ),
    log:
        "<logs>/table_surface_reconstruction.log",
    benchmark:
        "<benchmarks>/table_surface_reconstruction.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=rising(1000),
        runtime=rising(10),
    params:
        provenance=provenance(),
        digest=code_digest("reporting.skeleton_table_files"),
    script:
        "../scripts/write_table.py"


rule table_processing_time:
    input:
        rows=expand(
            rules.time_stages.output[0],
            dataset=CONFIG.dataset.name,
            split=CONFIG.evaluation.split,
            surface=CONFIG.surface.names,
        ),
        published=CLONE / "config/paper/processing_time.csv",
    output:
        csv="<results>/tables/processing_time.csv",
        tex="<results>/tables/processing_time.tex",
        md=report(
            "<results>/tables/processing_time.md",
            caption="../report/processing_time.rst",
            category="Tables",
        ),
    log:
        "<logs>/table_processing_time.log",
    benchmark:
        "<benchmarks>/table_processing_time.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=rising(1000),
        runtime=rising(10),
    params:
        provenance=provenance(),
        digest=code_digest("reporting.skeleton_table_files"),
    script:
        "../scripts/write_table.py"


rule table_object_classification:
    input:
        shapes=judged("shapes"),
        draws=judged("draws"),
        published=CLONE / "config/paper/object_classification_oa.csv",
    output:
        csv="<results>/tables/object_classification.csv",
        tex="<results>/tables/object_classification.tex",
        md=report(
            "<results>/tables/object_classification.md",
            caption="../report/object_classification.rst",
            category="Tables",
        ),
    log:
        "<logs>/table_object_classification.log",
    benchmark:
        "<benchmarks>/table_object_classification.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=rising(2000),
        runtime=rising(10),
    params:
        provenance=sampling_provenance(),
        digest=code_digest("reporting.sampling_table_files"),
    script:
        "../scripts/write_sampling_table.py"


rule table_point_cloud_retrieval:
    input:
        shapes=judged("shapes"),
        draws=judged("draws"),
        published=CLONE / "config/paper/point_cloud_retrieval_map.csv",
    output:
        csv="<results>/tables/point_cloud_retrieval.csv",
        tex="<results>/tables/point_cloud_retrieval.tex",
        md=report(
            "<results>/tables/point_cloud_retrieval.md",
            caption="../report/point_cloud_retrieval.rst",
            category="Tables",
        ),
    log:
        "<logs>/table_point_cloud_retrieval.log",
    benchmark:
        "<benchmarks>/table_point_cloud_retrieval.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=rising(2000),
        runtime=rising(10),
    params:
        provenance=sampling_provenance(),
        digest=code_digest("reporting.sampling_table_files"),
    script:
        "../scripts/write_sampling_table.py"


rule table_skeleton_prior:
    input:
        shapes=judged("shapes"),
        draws=judged("draws"),
        published=CLONE / "config/paper/skeleton_prior_oa.csv",
    output:
        csv="<results>/tables/skeleton_prior.csv",
        tex="<results>/tables/skeleton_prior.tex",
        md=report(
            "<results>/tables/skeleton_prior.md",
            caption="../report/skeleton_prior.rst",
            category="Tables",
        ),
    log:
        "<logs>/table_skeleton_prior.log",
    benchmark:
        "<benchmarks>/table_skeleton_prior.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=rising(2000),
        runtime=rising(10),
    params:
        provenance=sampling_provenance(),
        digest=code_digest("reporting.sampling_table_files"),
    script:
        "../scripts/write_sampling_table.py"


rule table_part_segmentation:
    input:
        rows=segmented(),
        published=CLONE / "config/paper/part_segmentation_miou.csv",
    output:
        csv="<results>/tables/part_segmentation.csv",
        tex="<results>/tables/part_segmentation.tex",
        md=report(
            "<results>/tables/part_segmentation.md",
            caption="../report/part_segmentation.rst",
            category="Tables",
        ),
    log:
        "<logs>/table_part_segmentation.log",
    benchmark:
        "<benchmarks>/table_part_segmentation.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=rising(2000),
        runtime=rising(10),
    params:
        provenance=segmentation_provenance(),
        digest=code_digest("reporting.segmentation_table_files"),
    script:
        "../scripts/write_segmentation_table.py"
