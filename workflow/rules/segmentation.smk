# Part segmentation from the labels of chosen points.


if strategies():

    use rule choose_points as choose_labelled_points with:
        input:
            clouds=PART_CLOUDS,
            priors=labelling_priors,
            networks=transferred_samplers,
        output:
            directory(LABELLED_POINTS),
        log:
            "<logs>/choose_labelled_points/{dataset}/{split}/{sampler}.log",
        benchmark:
            "<benchmarks>/choose_labelled_points/{dataset}/{split}/{sampler}.tsv"
        params:
            ratios=section("tasks", "segmentation", "ratios"),
            draws=CONFIG.tasks.segmentation.seeds * CONFIG.tasks.segmentation.label_sets,
            prior=section("sampling", "prior"),
            lfs=section("samplers", "lfs"),
            seed=CONFIG.seed,
            digest=code_digest("sampling.choose_for_split"),

    rule train_segmentation:
        input:
            clouds=part_clouds(part_splits()[0]),
            samples=training_labels,
            validation_clouds=part_clouds(part_splits()[1] or []),
            validation_samples=validation_labels,
        output:
            of_one_job(
                TRAINED_SEGMENTER,
                ratio=CONFIG.tasks.segmentation.ratios,
                seed=range(CONFIG.tasks.segmentation.seeds),
            ),
        log:
            f"<logs>/train_segmentation/{{dataset}}/{{strategy}}/{TRAINING}.log",
        benchmark:
            f"<benchmarks>/train_segmentation/{{dataset}}/{{strategy}}/{TRAINING}.tsv"
        wildcard_constraints:
            strategy=f"(?!{EVERY_LABEL}/)[a-z0-9_]+",
        priority: EARLY
        conda:
            "../../environment.yml"
        threads: CONFIG.trainer.threads
        resources:
            **TRAINING_DEVICES,
            mem_mb=rising(8000),
            runtime=TRAINING_MINUTES,
        params:
            settings=section("tasks", "segmentation", "network"),
            learning={
                name: section("tasks", "segmentation", name)
                for name in (
                    "validation_share",
                    "validation_labels",
                    "completed",
                    "label_sets",
                    "full_supervision",
                )
            },
            seed=CONFIG.seed,
            trainer=TRAINER,
            checkpoints=f"{RESULTS}/checkpoints/{{dataset}}/segmentation",
            digest=code_digest("learning.segmentation_training"),
        script:
            "../scripts/train_segmentation.py"

    use rule train_segmentation as train_full_segmentation with:
        input:
            clouds=part_clouds(part_splits()[0]),
            samples=[],
            validation_clouds=part_clouds(part_splits()[1] or []),
            validation_samples=[],
        output:
            TRAINED_SEGMENTER.replace("{strategy}", EVERY_LABEL).replace("{ratio}", "1"),
        log:
            f"<logs>/train_segmentation/{{dataset}}/{EVERY_LABEL}/{{seed}}.log",
        benchmark:
            f"<benchmarks>/train_segmentation/{{dataset}}/{EVERY_LABEL}/{{seed}}.tsv"

    rule evaluate_segmentation:
        input:
            clouds=PART_CLOUDS,
            networks=trained_segmenters,
            training_clouds=part_clouds(part_splits()[0]),
            samples=training_labels,
        output:
            SEGMENTED,
        log:
            "<logs>/evaluate_segmentation/{dataset}/{split}/{strategy}.log",
        benchmark:
            "<benchmarks>/evaluate_segmentation/{dataset}/{split}/{strategy}.tsv"
        conda:
            "../../environment.yml"
        threads: CONFIG.trainer.threads
        resources:
            mem_mb=rising(6000),
            runtime=rising(240),
        params:
            completed=CONFIG.tasks.segmentation.completed,
            label_sets=CONFIG.tasks.segmentation.label_sets,
            digest=code_digest("evaluation.segmentation"),
        script:
            "../scripts/evaluate_segmentation.py"
