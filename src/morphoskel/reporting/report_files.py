"""Write the HTML report of a run from its files."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from pathlib import Path

from morphoskel.atomic import atomic_file
from morphoskel.errors import InputError
from morphoskel.reporting.page.configuration import read_configuration
from morphoskel.reporting.page.data_checksums import describe_manifest
from morphoskel.reporting.page.embedded_figures import FigureSource, embed_figures
from morphoskel.reporting.page.failures import collect_failures
from morphoskel.reporting.page.report_page import ReportContent, render_report
from morphoskel.reporting.page.reported_tables import read_reported_table
from morphoskel.reporting.page.run_scenes import SceneSources, run_scenes
from morphoskel.reporting.page.stage_times import sum_benchmarks
from morphoskel.run_provenance import read_provenance

logger = logging.getLogger(__name__)

MOST_BYTES = 15_000_000
"""Of a report, so that it can be sent and opens fast."""


def write_report(
    path: Path,
    *,
    run_folder: Path,
    tables: Sequence[Path],
    figures: Sequence[FigureSource],
    scenes: SceneSources | None,
    config: Path,
    provenance: Path,
    manifests: Sequence[Path],
) -> None:
    """Write one HTML file that holds all there is to see of a run and needs nothing from the network.

    Parameters
    ----------
    path
        The file to write.
    run_folder
        Folder of the run, ``results/{run}``; its name is the run's. Failures are read from every ``status.csv`` in
        it, and times from its folder ``benchmarks``.
    tables
        CSV files of the result tables, each with its Markdown file beside it, in the order of the page.
    figures
        In the order of the page.
    scenes
        Where the shapes to turn are; ``None`` for a report without.
    config
        The resolved configuration.
    provenance
        The file of :func:`morphoskel.run_provenance.write_provenance`.
    manifests
        One a data set.

    Raises
    ------
    InputError
        If a file is absent or is not what it should be, or the page would be larger than :data:`MOST_BYTES`.
    DatasetError
        If a manifest is absent or none.
    """
    content = ReportContent(
        run=run_folder.name,
        tables=[read_reported_table(table) for table in tables],
        figures=embed_figures(figures),
        scenes=[] if scenes is None else run_scenes(scenes),
        configuration=read_configuration(config),
        provenance=read_provenance(provenance),
        splits=[split for manifest in manifests for split in describe_manifest(manifest)],
        failures=collect_failures(run_folder),
        times=sum_benchmarks(run_folder / "benchmarks"),
    )
    page = render_report(content).encode()
    logger.info("%d tables, %d figures, %d shapes: %d bytes", len(content.tables), len(content.figures),
                len(content.scenes), len(page))  # fmt: skip
    if len(page) > MOST_BYTES:
        raise InputError(
            f"{path}: the report would have {len(page):,} bytes, more than {MOST_BYTES:,}; leave out a table, as "
            "pictures and shapes are bounded already"
        )
    with atomic_file(path) as partial:
        partial.write_bytes(page)
