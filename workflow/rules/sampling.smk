# From skeletons to samplers: clouds of equal size, their local feature sizes, the points chosen, and how they are judged.
# The trainings are in learning.smk.


rule gather_clouds:
    input:
        manifest="resources/manifest/{dataset}.csv",
    output:
        CLOUDS,
    log:
        "<logs>/gather_clouds/{dataset}/{split}/{points}.log",
    benchmark:
        "<benchmarks>/gather_clouds/{dataset}/{split}/{points}.tsv"
    priority: EARLY
    conda:
        "../../environment.yml"
    resources:
        mem_mb=rising(2000),
        runtime=rising(60),
    params:
        dataset=dataset_section,
        points="{points}",
        repeat=repeats,
        seed=CONFIG.seed,
        digest=code_digest("datasets.cloud_set"),
    script:
        "../scripts/gather_clouds.py"


rule local_feature_size:
    input:
        clouds=CLOUDS,
        skeletons=prior_skeletons,
    output:
        PRIORS,
    log:
        "<logs>/local_feature_size/{dataset}/{split}/{points}/{skeleton}.log",
    benchmark:
        "<benchmarks>/local_feature_size/{dataset}/{split}/{points}/{skeleton}.tsv"
    wildcard_constraints:
        skeleton="ms3d|dpc|l1_medial",
    conda:
        "../../environment.yml"
    resources:
        mem_mb=rising(2000),
        runtime=rising(60),
    params:
        max_failed=CONFIG.max_failed,
        digest=code_digest("sampling.prior_set"),
    script:
        "../scripts/local_feature_size.py"


if CONFIG.samplers.skeleton_aware:

    rule predict_local_feature_size:
        input:
            clouds=CLOUDS,
            network=rules.train_skeleton_aware.output[0],
        output:
            PRIORS.replace("{skeleton}", "skeleton_aware"),
        log:
            "<logs>/local_feature_size/{dataset}/{split}/{points}/skeleton_aware.log",
        benchmark:
            "<benchmarks>/local_feature_size/{dataset}/{split}/{points}/skeleton_aware.tsv"
        conda:
            "../../environment.yml"
        threads: CONFIG.trainer.threads
        resources:
            mem_mb=rising(8000),
            runtime=rising(240),
        params:
            digest=code_digest("learning.skeleton_aware_training"),
        script:
            "../scripts/predict_local_feature_size.py"


rule choose_points:
    input:
        clouds=SAMPLED_CLOUDS,
        priors=sampler_priors,
        networks=trained_samplers,
    output:
        directory(SAMPLES),
    log:
        "<logs>/choose_points/{dataset}/{split}/{sampler}.log",
    benchmark:
        "<benchmarks>/choose_points/{dataset}/{split}/{sampler}.tsv"
    conda:
        "../../environment.yml"
    threads: CONFIG.trainer.threads
    resources:
        mem_mb=rising(4000),
        runtime=rising(240),
    params:
        ratios=section("sampling", "ratios"),
        draws=CONFIG.sampling.draws,
        prior=section("sampling", "prior"),
        lfs=section("samplers", "lfs"),
        seed=CONFIG.seed,
        digest=code_digest("sampling.choose_for_split"),
    script:
        "../scripts/choose_points.py"


rule evaluate_samples:
    input:
        clouds=SAMPLED_CLOUDS,
        priors=sampler_priors,
        samples=samples_to_judge,
        classifiers=expand(
            rules.train_classifier.output[0],
            dataset=CONFIG.dataset.name,
            classifier=["task", "plain"],
        ),
    output:
        shapes=JUDGED.format(level="shapes"),
        draws=JUDGED.format(level="draws"),
    log:
        "<logs>/evaluate_samples/{dataset}/{split}/{sampler}.log",
    benchmark:
        "<benchmarks>/evaluate_samples/{dataset}/{split}/{sampler}.tsv"
    conda:
        "../../environment.yml"
    threads: CONFIG.trainer.threads
    resources:
        mem_mb=rising(4000),
        runtime=rising(240),
    params:
        digest=code_digest("evaluation.sampled_shapes", "sampling.choose_for_split"),
    script:
        "../scripts/evaluate_samples.py"
