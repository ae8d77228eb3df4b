import pytest
from charts import entries, lines_of, page
from test_skeleton_tables import CATEGORIES, build, failed, row, with_axis

from morphoskel.errors import InputError
from morphoskel.evaluation.averages import AVERAGES
from morphoskel.reporting.figure_page import TEXT_WIDTH
from morphoskel.reporting.figures.distances import (
    SKELETON_ROWS,
    SURFACE_ROWS,
    choose_panels,
    draw_distances_from_files,
    plot_distances,
)
from morphoskel.reporting.figures.marks import mark_of
from morphoskel.reporting.skeleton_tables import skeleton_reconstruction, surface_reconstruction
from morphoskel.reporting.table import read_table, write_table

METHODS = {"l1_medial": "cloud", "dpc": "cloud", "coverage_axis": "poisson", "ms3d": "poisson",
           "ms3d_coverage": "poisson"}  # fmt: skip


def shapes(total=1.0, **more):
    """One shape of every method and category, and axes of this run."""
    rows = [
        with_axis(total * (2 + number), shape=f"{category}-1", category=category, method=method, surface=surface)
        for number, (method, surface) in enumerate(METHODS.items())
        for category in CATEGORIES
    ]
    dense = [row(f"{category}-1", category, "cloud", "point2skeleton", balls="dense") for category in CATEGORIES]
    return [*rows, *dense]


def frame(folder, *rows, table=skeleton_reconstruction, **options):
    result = build(table, *rows, **options)
    write_table(result.frame, folder / "table", "Caption.", result.footnotes)
    return read_table(folder / "table.csv")


def dots(panels, title, name):
    of_panel = dict(panels)[title]
    return next(dots for dots in of_panel if dots.name == name)


def test_values_are_those_of_the_table(tmp_path):
    table = frame(tmp_path, *shapes())
    panels = choose_panels(table, SKELETON_ROWS)
    cells = table.set_index(["method", "group", "metric"])
    for title, metric in (("CD-Recon", "cd_recon"), ("HD-Recon", "hd_recon")):
        for name, method in SKELETON_ROWS.items():
            for group in (*CATEGORIES, *AVERAGES):
                cell = cells.loc[(method, group, metric)] if (method, group, metric) in cells.index else None
                assert dots(panels, title, name).measured.get(group) == pytest.approx(cell["value"])
    assert dots(panels, "CD-Recon", "ms3d").published["Mug"] == 0.058
    assert dots(panels, "CD-Recon", "ms3d_coverage").published == {}


def test_distances_to_axes_of_the_run_stand_alone(tmp_path):
    panels = choose_panels(frame(tmp_path, *shapes(), axis="computed"), SKELETON_ROWS)
    assert [title for title, _ in panels] == ["CD-Recon", "HD-Recon", "CD-MAT*", "HD-MAT*"]
    assert dots(panels, "CD-MAT*", "ms3d").measured["Mug"] > 0
    assert dots(panels, "CD-MAT*", "ms3d").published == {}


def test_distances_to_given_axes_stand_beside_published_ones(tmp_path):
    panels = choose_panels(frame(tmp_path, *shapes(), axis="given"), SKELETON_ROWS)
    assert [title for title, _ in panels] == ["CD-Recon", "HD-Recon", "CD-MAT", "HD-MAT"]
    assert dots(panels, "CD-MAT", "ms3d").measured["Mug"] > 0
    assert dots(panels, "CD-MAT", "ms3d").published["Mug"] == 0.1126


def test_every_word_can_be_read_and_every_dot_lies_in_the_row_of_its_category(tmp_path):
    panels = choose_panels(frame(tmp_path, *shapes()), SKELETON_ROWS)
    groups = [*CATEGORIES, *AVERAGES]
    with page(TEXT_WIDTH, 6.0) as figure:
        plot_distances(figure, groups, panels)
        places = figure.axes[0].get_yticks()
        assert [label.get_text().replace("\n", " ") for label in figure.axes[0].get_yticklabels()] == groups
        halfway = (places[1] - places[0]) / 2
        for axes, (_, of_panel) in zip(figure.axes, panels, strict=True):
            for of in of_panel:
                if of.name == "point2skeleton":  # shares black with the words
                    continue
                drawn = lines_of(axes, mark_of(of.name).colour)
                assert [x for (x,), _ in drawn] == [of.measured[group] for group in groups if group in of.measured]
                assert all(abs(y - place) < halfway for (_, (y,)), place in zip(drawn, places, strict=True))
        assert entries(figure) == [*SKELETON_ROWS.values(), "this run", "published"]


def test_methods_do_not_share_a_line(tmp_path):
    panels = choose_panels(frame(tmp_path, *shapes()), SKELETON_ROWS)
    with page(TEXT_WIDTH, 6.0) as figure:
        plot_distances(figure, [*CATEGORIES, *AVERAGES], panels)
        lines = [lines_of(figure.axes[0], mark_of(name).colour)[0][1][0] for name in SKELETON_ROWS]
    assert len(set(lines)) == len(SKELETON_ROWS)


def test_what_was_not_run_or_failed_is_said(tmp_path):
    rows = [row("a", "Mug"), failed("a", "Mug", "cloud", "dpc")]
    panels = choose_panels(frame(tmp_path, *rows), SKELETON_ROWS)
    with page(TEXT_WIDTH, 6.0) as figure:
        plot_distances(figure, [*CATEGORIES, *AVERAGES], panels)
        words = entries(figure)
    assert words == [
        *("L1 (not run)", "DPC (failed)", "P2S (not run)", "Coverage Axis++ (not run)", "MS3D"),
        *("MS3D coverage (not run)", "this run", "published"),
    ]


@pytest.mark.parametrize(
    ("table", "kind"), [(skeleton_reconstruction, "skeletons"), (surface_reconstruction, "surfaces")]
)
def test_files_are_written_from_a_table(tmp_path, table, kind):
    surfaces = [row("a", "Mug", surface) for surface in ("ball_pivoting", "ponq", "repaired_poisson")]
    frame(tmp_path, row("a", "Mug"), *surfaces, table=table)
    paths = [tmp_path / "figure.png", tmp_path / "figure.pdf"]
    draw_distances_from_files(paths, tmp_path / "table.csv", kind=kind)
    assert paths[0].read_bytes().startswith(b"\x89PNG")
    assert paths[1].read_bytes().startswith(b"%PDF")


def test_the_rows_of_surfaces_are_those_of_their_table(tmp_path):
    surfaces = ("ball_pivoting", "alpha_shape", "ponq", "poisson", "repaired_poisson")
    table = frame(
        tmp_path,
        *(row("a", "Mug", surface) for surface in surfaces),
        row("a", "Mug", "cloud", "point2skeleton", balls="dense"),
        table=surface_reconstruction,
    )
    panels = choose_panels(table, SURFACE_ROWS)
    assert all(dots(panels, "CD-Recon", name).measured["Mug"] > 0 for name in SURFACE_ROWS)


def test_a_table_without_the_rows_is_refused(tmp_path):
    frame(tmp_path, row("a", "Mug"))
    table = tmp_path / "table.csv"
    table.write_text(table.read_text().splitlines(keepends=True)[0])
    with pytest.raises(InputError, match="no value of any of the rows"):
        draw_distances_from_files([tmp_path / "a.png"], table, kind="surfaces")
