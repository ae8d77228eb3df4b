"""Write the page that shows the whole run, and what it was made with."""

from pathlib import Path

from jinja2 import Template

from morphoskel.logs import log_to
from morphoskel.reporting.page.embedded_figures import FigureSource
from morphoskel.reporting.page.run_scenes import SceneSources
from morphoskel.reporting.paths import as_paths
from morphoskel.reporting.report_files import write_report
from morphoskel.run_provenance import write_provenance

log_to(snakemake.log[0])
params, files = snakemake.params, snakemake.input
run_folder = Path(snakemake.output[0]).parents[1]
write_provenance(Path(snakemake.output.provenance))
write_report(
    Path(snakemake.output[0]),
    run_folder=run_folder,
    tables=as_paths(files.tables),
    figures=[
        FigureSource(name, title, Template(Path(caption).read_text()).render(snakemake=snakemake), Path(path))
        for (name, title), caption, path in zip(params.titles.items(), files.captions, files.figures, strict=True)
    ],
    scenes=SceneSources(
        **as_paths(params.scenes),
        split=params.split,
        dataset=params.dataset,
        seed=params.seed,
        candidates=params.candidates,
        ratio=params.ratio,
    ),
    config=run_folder / "config.yaml",
    provenance=Path(snakemake.output.provenance),
    manifests=as_paths(files.manifests),
)
