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
            mem_mb=8000,
            runtime=2880,
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
