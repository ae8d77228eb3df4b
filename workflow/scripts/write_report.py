"""Write the page that shows the whole run, and what it was made with."""

from pathlib import Path

from morphoskel.logs import log_to
from morphoskel.reporting.page.embedded_figures import FigureSource
from morphoskel.reporting.page.run_scenes import SceneSources
from morphoskel.reporting.paths import as_paths
from morphoskel.reporting.report_files import write_report
from morphoskel.run_provenance import write_provenance

log_to(snakemake.log[0])
params, files = snakemake.params, snakemake.input
write_provenance(Path(snakemake.output.provenance))
write_report(
    Path(snakemake.output[0]),
    run_folder=Path(params.run),
    tables=as_paths(files.tables),
    figures=[
        FigureSource(name, title, Path(caption).read_text(), Path(path))
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
    config=Path(params.run) / "config.yaml",
    provenance=Path(snakemake.output.provenance),
    manifests=as_paths(files.manifests),
)
