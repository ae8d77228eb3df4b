# Trainings: one rule a network.


if CONFIG.methods.point2skeleton:

    rule train_point2skeleton:
        input:
            manifest="resources/manifest/{dataset}.csv".format(
                dataset=CONFIG.dataset.name
            ),
        output:
            f"<results>/networks/{CONFIG.dataset.name}/point2skeleton/network.pt",
        log:
            "<logs>/train_point2skeleton.log",
        benchmark:
            "<benchmarks>/train_point2skeleton.tsv"
        conda:
            "../../environment.yml"
        threads: CONFIG.trainer.threads
        resources:
            **TRAINING_DEVICES,
            mem_mb=rising(8000),
            runtime=TRAINING_MINUTES,
        params:
            dataset=section("dataset"),
            seed=CONFIG.seed,
            network=section("methods", "point2skeleton", "network"),
            validation_share=CONFIG.methods.point2skeleton.validation_share,
            accelerator=CONFIG.trainer.accelerator,
            checkpoints=f"{RESULTS}/checkpoints/{CONFIG.dataset.name}/point2skeleton",
            digest=code_digest("learning.point2skeleton_training"),
        script:
            "../scripts/train_point2skeleton.py"


rule train_classifier:
    input:
        clouds=SAMPLED_CLOUDS.replace("{split}", "train"),
    output:
        f"{RESULTS}/networks/{{dataset}}/classifier/{{classifier}}/network.pt",
    log:
        "<logs>/train_classifier/{dataset}/{classifier}.log",
    benchmark:
        "<benchmarks>/train_classifier/{dataset}/{classifier}.tsv"
    conda:
        "../../environment.yml"
    threads: CONFIG.trainer.threads
    resources:
        **TRAINING_DEVICES,
        mem_mb=rising(8000),
        runtime=TRAINING_MINUTES,
    params:
        settings=classifier_settings,
        seed=CONFIG.seed,
        validation_share=CONFIG.sampling.validation_share,
        trainer=TRAINER,
        checkpoints=f"{RESULTS}/checkpoints/{{dataset}}/classifier/{{classifier}}",
        digest=code_digest("learning.classifier_training"),
    script:
        "../scripts/train_classifier.py"


if CONFIG.samplers.skeleton_aware:

    rule train_skeleton_aware:
        input:
            clouds=SAMPLED_CLOUDS.replace("{split}", "train").format(
                dataset=CONFIG.dataset.name
            ),
        output:
            f"<results>/networks/{CONFIG.dataset.name}/skeleton_aware/network.pt",
        log:
            "<logs>/train_skeleton_aware.log",
        benchmark:
            "<benchmarks>/train_skeleton_aware.tsv"
        conda:
            "../../environment.yml"
        threads: CONFIG.trainer.threads
        resources:
            **TRAINING_DEVICES,
            mem_mb=rising(8000),
            runtime=TRAINING_MINUTES,
        params:
            settings=section("samplers", "skeleton_aware", "skeleton"),
            seed=CONFIG.seed,
            validation_share=CONFIG.sampling.validation_share,
            trainer=TRAINER,
            checkpoints=f"{RESULTS}/checkpoints/{CONFIG.dataset.name}/skeleton_aware",
            digest=code_digest("learning.skeleton_aware_training"),
        script:
            "../scripts/train_skeleton_aware.py"


rule train_sampler:
    input:
        clouds=SAMPLED_CLOUDS.replace("{split}", "train"),
        priors=training_priors,
        classifiers=judging_classifiers,
    output:
        of_one_job(
            TRAINED_SAMPLER,
            ratio=CONFIG.sampling.ratios,
            seed=range(CONFIG.sampling.seeds),
        ),
    log:
        f"<logs>/train_sampler/{{dataset}}/{{sampler}}/{TRAINING}.log",
    benchmark:
        f"<benchmarks>/train_sampler/{{dataset}}/{{sampler}}/{TRAINING}.tsv"
    conda:
        "../../environment.yml"
    threads: CONFIG.trainer.threads
    resources:
        **TRAINING_DEVICES,
        mem_mb=rising(8000),
        runtime=TRAINING_MINUTES,
    params:
        settings=sampler_settings,
        prior=section("sampling", "prior"),
        steps=CONFIG.sampling.steps,
        validation_share=CONFIG.sampling.validation_share,
        seed=CONFIG.seed,
        trainer=TRAINER,
        checkpoints=f"{RESULTS}/checkpoints/{{dataset}}/sampler/{{sampler}}",
        digest=code_digest("learning.sampler_training"),
    script:
        "../scripts/train_sampler.py"
