# The paper's tables: paper | ours | difference, each as CSV, Markdown and LaTeX.


def of_every_surface(kind):
    """Return the result files of the evaluated split, one for each surface reconstruction."""
    return expand(
        "<results>/{kind}/{dataset}/{split}/{surface}.csv",
        kind=kind,
        dataset=CONFIG.dataset.name,
        split=CONFIG.evaluation.split,
        surface=CONFIG.surface.names,
    )


rule table_skeleton_reconstruction:
    input:
        rows=of_every_surface("evaluation"),
        published=Path(workflow.basedir) / "config/paper/skeleton_reconstruction.csv",
        counts=Path(workflow.basedir) / "config/paper/processing_time.csv",
    output:
        csv="<results>/tables/skeleton_reconstruction.csv",
        tex="<results>/tables/skeleton_reconstruction.tex",
        md=report(
            "<results>/tables/skeleton_reconstruction.md",
            caption="../report/skeleton_reconstruction.rst",
            category="Tables",
        ),
    params:
        provenance=provenance(),
        digest=code_digest("reporting.skeleton_table_files"),
    log:
        "<logs>/table_skeleton_reconstruction.log",
    resources:
        mem_mb=500,
        runtime=10,
    script:
        "../scripts/write_table.py"


rule table_surface_reconstruction:
    input:
        rows=of_every_surface("evaluation"),
        published=Path(workflow.basedir) / "config/paper/surface_reconstruction_ablation.csv",
        counts=Path(workflow.basedir) / "config/paper/processing_time.csv",
    output:
        csv="<results>/tables/surface_reconstruction.csv",
        tex="<results>/tables/surface_reconstruction.tex",
        md=report(
            "<results>/tables/surface_reconstruction.md",
            caption="../report/surface_reconstruction.rst",
            category="Tables",
        ),
    params:
        provenance=provenance(),
        digest=code_digest("reporting.skeleton_table_files"),
    log:
        "<logs>/table_surface_reconstruction.log",
    resources:
        mem_mb=500,
        runtime=10,
    script:
        "../scripts/write_table.py"


rule table_processing_time:
    input:
        rows=of_every_surface("timing"),
        published=Path(workflow.basedir) / "config/paper/processing_time.csv",
    output:
        csv="<results>/tables/processing_time.csv",
        tex="<results>/tables/processing_time.tex",
        md=report(
            "<results>/tables/processing_time.md",
            caption="../report/processing_time.rst",
            category="Tables",
        ),
    params:
        provenance=provenance(),
        digest=code_digest("reporting.skeleton_table_files"),
    log:
        "<logs>/table_processing_time.log",
    resources:
        mem_mb=500,
        runtime=10,
    script:
        "../scripts/write_table.py"
