# The page that shows the whole run.


rule html_report:
    input:
        flat(scene_files()),
        rules.write_config.output[0],
        tables=every_table(),
        figures=expand("<results>/figures/{name}.png", name=every_figure()),
        captions=expand(CLONE / "workflow/report/{name}.rst", name=every_figure()),
        manifests=expand("resources/manifest/{dataset}.csv", dataset=DATASETS),
    output:
        report(
            "<results>/report/index.html",
            caption="../report/html_report.rst",
            category="Report",
        ),
        provenance="<results>/report/provenance.json",
    log:
        "<logs>/html_report.log",
    benchmark:
        "<benchmarks>/html_report.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=rising(3000),
        runtime=rising(60),
    params:
        **SHAPE_SOURCE,
        titles=every_figure(),
        numbers=NUMBERS,
        scenes=scene_files(),
        candidates=section("skeleton", "candidates"),
        ratio=CONFIG.sampling.ratios[0],
        split=CONFIG.evaluation.split,
        digest=code_digest("reporting.report_files"),
        assets=assets_digest(),
    script:
        "../scripts/write_report.py"
