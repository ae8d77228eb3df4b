# The experiments of MorphoSkel3D. Build everything with `snakemake --cores 2` or `morphoskel run`; one table with
# `morphoskel run table_surface_reconstruction`. Values live in config/, code in src/morphoskel, rules in paper order below.
from snakemake.utils import min_version

min_version("9.27")


include: "workflow/rules/common.smk"
include: "workflow/rules/skeleton_inputs.smk"
include: "workflow/rules/sampling_inputs.smk"
include: "workflow/rules/figure_inputs.smk"
include: "workflow/rules/data.smk"
include: "workflow/rules/skeleton.smk"
include: "workflow/rules/learning.smk"
include: "workflow/rules/methods.smk"
include: "workflow/rules/sampling.smk"
include: "workflow/rules/segmentation.smk"
include: "workflow/rules/timing.smk"
include: "workflow/rules/evaluation.smk"
include: "workflow/rules/tables.smk"
include: "workflow/rules/illustrations.smk"
include: "workflow/rules/figures.smk"
include: "workflow/rules/charts.smk"
include: "workflow/rules/report.smk"


report: "workflow/report/workflow.rst"


localrules:
    skeletons,
    write_config,


rule skeletons:
    input:
        every_skeleton(),


rule all:
    default_target: True
    input:
        rules.write_config.output,
        rules.table_skeleton_reconstruction.output,
        rules.table_surface_reconstruction.output,
        rules.table_processing_time.output,
        learning_tables(),
        expand(
            f"{RESULTS}/figures/{{name}}.{{kind}}",
            name=every_figure(),
            kind=["png", "pdf"],
        ),
        rules.html_report.output,
