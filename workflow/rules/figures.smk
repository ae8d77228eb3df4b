# Figures of shapes, skeletons, samples and parts.


rule figure_contact_sheet:
    input:
        flat({"manifest": MANIFEST}),
    output:
        png=report(
            "<results>/figures/contact_sheet.png",
            caption="../report/contact_sheet.rst",
            category="Figures",
            subcategory="Shapes",
            labels={"figure": "the data set"},
        ),
        pdf="<results>/figures/contact_sheet.pdf",
    log:
        "<logs>/figure_contact_sheet.log",
    benchmark:
        "<benchmarks>/figure_contact_sheet.tsv"
    conda:
        "../../environment.yml"
    resources:
        mem_mb=rising(2000),
        runtime=rising(60),
    params:
        figure="contact_sheet",
        files={"manifest": MANIFEST},
        values={**SHAPE_SOURCE, "split": CONFIG.evaluation.split},
        numbers=numbers("contact_sheet"),
        digest=code_digest("reporting.figures.contact_sheet"),
    script:
        "../scripts/draw_figure.py"


use rule figure_contact_sheet as figure_skeleton_sheet with:
    input:
        flat({"manifest": MANIFEST, **of_surface(MAIN_SURFACE)}),
    output:
        png=report(
            "<results>/figures/skeleton_sheet.png",
            caption="../report/skeleton_sheet.rst",
            category="Figures",
            subcategory="Shapes",
            labels={"figure": "a skeleton of every category"},
        ),
        pdf="<results>/figures/skeleton_sheet.pdf",
    log:
        "<logs>/figure_skeleton_sheet.log",
    benchmark:
        "<benchmarks>/figure_skeleton_sheet.tsv"
    params:
        figure="skeleton_sheet",
        files={"manifest": MANIFEST, **of_surface(MAIN_SURFACE)},
        values={"split": CONFIG.evaluation.split},
        numbers=numbers("skeleton_sheet"),
        digest=code_digest("reporting.figures.skeleton_sheet"),


use rule figure_contact_sheet as figure_spheres with:
    input:
        flat({"manifest": MANIFEST, "skeletons": of_surface(MAIN_SURFACE)["skeletons"]}),
    output:
        png=report(
            "<results>/figures/spheres.png",
            caption="../report/spheres.rst",
            category="Figures",
            subcategory="Shapes",
            labels={"figure": "balls and surface points"},
        ),
        pdf="<results>/figures/spheres.pdf",
    log:
        "<logs>/figure_spheres.log",
    benchmark:
        "<benchmarks>/figure_spheres.tsv"
    params:
        figure="spheres",
        files={"manifest": MANIFEST, "skeletons": of_surface(MAIN_SURFACE)["skeletons"]},
        values={
            **SHAPE_SOURCE,
            "split": CONFIG.evaluation.split,
            "wanted": CONFIG.figures.shapes,
        },
        numbers=numbers("spheres"),
        digest=code_digest("reporting.figures.spheres"),


use rule figure_contact_sheet as figure_skeletons with:
    input:
        flat(
            {
                "manifest": MANIFEST,
                "meshes": by_surface("surfaces"),
                "skeletons": gallery_skeletons(),
            }
        ),
    output:
        png=report(
            "<results>/figures/skeletons.png",
            caption="../report/skeletons.rst",
            category="Figures",
            subcategory="Shapes",
            labels={"figure": "all methods"},
        ),
        pdf="<results>/figures/skeletons.pdf",
    log:
        "<logs>/figure_skeletons.log",
    benchmark:
        "<benchmarks>/figure_skeletons.tsv"
    params:
        figure="skeletons",
        files={
            "manifest": MANIFEST,
            "meshes": by_surface("surfaces"),
            "skeletons": gallery_skeletons(),
        },
        values={"split": CONFIG.evaluation.split},
        numbers=numbers("skeletons"),
        digest=code_digest("reporting.figures.skeletons"),


use rule figure_contact_sheet as figure_reconstructions with:
    input:
        flat(
            {
                "manifest": MANIFEST,
                "surfaces": by_surface("surfaces"),
                "skeletons": by_surface("skeletons"),
            }
        ),
    output:
        png=report(
            "<results>/figures/reconstructions.png",
            caption="../report/reconstructions.rst",
            category="Figures",
            subcategory="Shapes",
            labels={"figure": "surface reconstructions"},
        ),
        pdf="<results>/figures/reconstructions.pdf",
    log:
        "<logs>/figure_reconstructions.log",
    benchmark:
        "<benchmarks>/figure_reconstructions.tsv"
    params:
        figure="reconstructions",
        files={
            "manifest": MANIFEST,
            "surfaces": by_surface("surfaces"),
            "skeletons": by_surface("skeletons"),
        },
        values={"split": CONFIG.evaluation.split, "wanted": CONFIG.figures.shapes},
        numbers=numbers("reconstructions"),
        digest=code_digest("reporting.figures.reconstructions"),


if len(CONFIG.skeleton.selection) > 1:

    use rule figure_contact_sheet as figure_explanation with:
        input:
            flat({"manifest": MANIFEST, "skeletons": explained_skeletons()}),
        output:
            png=report(
                "<results>/figures/explanation.png",
                caption="../report/explanation.rst",
                category="Figures",
                subcategory="Shapes",
                labels={"figure": "what balls explain"},
            ),
            pdf="<results>/figures/explanation.pdf",
        log:
            "<logs>/figure_explanation.log",
        benchmark:
            "<benchmarks>/figure_explanation.tsv"
        params:
            figure="explanation",
            files={"manifest": MANIFEST, "skeletons": explained_skeletons()},
            values={**SHAPE_SOURCE, "split": CONFIG.evaluation.split},
            numbers=numbers("explanation"),
            digest=code_digest("reporting.figures.explanation"),


if shown_priors():

    use rule figure_contact_sheet as figure_size_map with:
        input:
            flat({"clouds": shown_clouds(), "priors": shown_priors()}),
        output:
            png=report(
                "<results>/figures/size_map.png",
                caption="../report/size_map.rst",
                category="Figures",
                subcategory="Sampling",
                labels={"figure": "local feature size"},
            ),
            pdf="<results>/figures/size_map.pdf",
        log:
            "<logs>/figure_size_map.log",
        benchmark:
            "<benchmarks>/figure_size_map.tsv"
        params:
            figure="size_map",
            module="local_feature_size",
            files={"clouds": shown_clouds(), "priors": shown_priors()},
            values={
                "prior": section("sampling", "prior"),
                "wanted": CONFIG.figures.shapes,
            },
            numbers=numbers("size_map"),
            digest=code_digest("reporting.figures.local_feature_size"),


if shown_samples():

    use rule figure_contact_sheet as figure_samples with:
        input:
            flat(
                {
                    "clouds": shown_clouds(),
                    "samples": shown_samples(),
                    "priors": shown_priors(),
                }
            ),
        output:
            png=report(
                "<results>/figures/samples.png",
                caption="../report/samples.rst",
                category="Figures",
                subcategory="Sampling",
                labels={"figure": "chosen points"},
            ),
            pdf="<results>/figures/samples.pdf",
        log:
            "<logs>/figure_samples.log",
        benchmark:
            "<benchmarks>/figure_samples.tsv"
        params:
            figure="samples",
            files={
                "clouds": shown_clouds(),
                "samples": shown_samples(),
                "priors": shown_priors(),
            },
            values={},
            numbers=numbers("samples"),
            digest=code_digest("reporting.figures.samples"),


if strategies():

    use rule figure_contact_sheet as figure_segmentation with:
        input:
            flat(shown_segmenters()),
        output:
            png=report(
                "<results>/figures/segmentation.png",
                caption="../report/segmentation.rst",
                category="Figures",
                subcategory="Segmentation",
                labels={"figure": "prediction and truth"},
            ),
            pdf="<results>/figures/segmentation.pdf",
        log:
            "<logs>/figure_segmentation.log",
        benchmark:
            "<benchmarks>/figure_segmentation.tsv"
        params:
            figure="segmentation",
            files=shown_segmenters(),
            values={},
            numbers=numbers("segmentation"),
            digest=code_digest("reporting.figures.segmentation"),
