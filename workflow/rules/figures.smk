# Pictures.


rule figure_contact_sheet:
    input:
        manifest="resources/manifest/{dataset}.csv".format(dataset=CONFIG.dataset.name),
    output:
        report(
            "<results>/figures/contact_sheet.png",
            caption="../report/contact_sheet.rst",
            category="Figures",
        ),
    log:
        "<logs>/figure_contact_sheet.log",
    conda:
        "../../environment.yml"
    resources:
        mem_mb=1500,
        runtime=30,
    params:
        dataset=section("dataset"),
        split=CONFIG.evaluation.split,
        seed=CONFIG.seed,
        digest=code_digest("reporting.contact_sheet"),
    script:
        "../scripts/draw_contact_sheet.py"


rule figure_skeletons:
    input:
        manifest="resources/manifest/{dataset}.csv".format(dataset=CONFIG.dataset.name),
        meshes=evaluated_shards(rules.watertight.output[0], CONFIG.surface.names),
        skeletons=evaluated_shards(
            rules.select_skeleton.output[0], CONFIG.surface.names
        ),
    output:
        report(
            "<results>/figures/skeletons.png",
            caption="../report/skeletons.rst",
            category="Figures",
        ),
    log:
        "<logs>/figure_skeletons.log",
    conda:
        "../../environment.yml"
    resources:
        mem_mb=1500,
        runtime=30,
    params:
        meshes={
            name: evaluated_shards(rules.watertight.output[0], name)
            for name in CONFIG.surface.names
        },
        skeletons={
            name: evaluated_shards(rules.select_skeleton.output[0], name)
            for name in CONFIG.surface.names
        },
        split=CONFIG.evaluation.split,
        digest=code_digest("reporting.skeleton_gallery"),
    script:
        "../scripts/draw_skeletons.py"
