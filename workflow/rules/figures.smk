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
        meshes=of_shards(
            rules.watertight.output[0],
            CONFIG.evaluation.split,
            surface=CONFIG.surface.names,
        ),
        skeletons=[
            folder for folders in gallery_skeletons().values() for folder in folders
        ],
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
            name: of_shards(
                rules.watertight.output[0], CONFIG.evaluation.split, surface=name
            )
            for name in CONFIG.surface.names
        },
        skeletons=gallery_skeletons(),
        split=CONFIG.evaluation.split,
        digest=code_digest("reporting.skeleton_gallery"),
    script:
        "../scripts/draw_skeletons.py"


if len(CONFIG.skeleton.selection) > 1:

    rule figure_explanation:
        input:
            manifest="resources/manifest/{dataset}.csv".format(
                dataset=CONFIG.dataset.name
            ),
            skeletons=[
                folder
                for folders in explained_skeletons().values()
                for folder in folders
            ],
        output:
            report(
                "<results>/figures/explanation.png",
                caption="../report/explanation.rst",
                category="Figures",
            ),
        log:
            "<logs>/figure_explanation.log",
        conda:
            "../../environment.yml"
        resources:
            mem_mb=1500,
            runtime=30,
        params:
            dataset=section("dataset"),
            seed=CONFIG.seed,
            skeletons=explained_skeletons(),
            split=CONFIG.evaluation.split,
            digest=code_digest("reporting.explanation_figure"),
        script:
            "../scripts/draw_explanations.py"
