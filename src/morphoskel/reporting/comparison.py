"""When the paper's numbers may stand beside ours, and what the reader must know if they do."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from fractions import Fraction
from typing import TYPE_CHECKING

from morphoskel.evaluation.averages import AVERAGES, Average
from morphoskel.reporting.published import published_footnotes
from morphoskel.reporting.table import MEASURED_COLUMNS

if TYPE_CHECKING:
    import pandas as pd


def measured_rows(method: str, metric: str, means: Mapping[str, Average]) -> list[dict[str, object]]:
    """Return one row of a result table for each group of `means`."""
    return [{"method": method, "group": group, "metric": metric, **vars(mean)} for group, mean in means.items()]


def measured_frame(rows: Sequence[Mapping[str, object]]) -> pd.DataFrame:
    """Return the rows as a frame that has its columns even without any row."""
    import pandas as pd

    return pd.DataFrame(rows, columns=list(MEASURED_COLUMNS))


def withhold_averages(published: pd.DataFrame, categories: Mapping[str, Iterable[str]]) -> tuple[pd.DataFrame, str]:
    """Take the paper's averages out of a table where ours are over other categories.

    Parameters
    ----------
    published
        Published rows, whose groups are categories and averages.
    categories
        The categories of the shapes that were run, by method; no method if nothing was run.

    Returns
    -------
    published, footnote
        The rows, with NaN as the value of each average withheld, and a sentence that says so, or an empty one. If
        ours taken together are the paper's categories, only methods that were run on others lose their averages.
    """
    printed = list(dict.fromkeys(group for group in published["group"] if group not in AVERAGES))
    ours = {method: set(names) for method, names in categories.items()}
    together = set().union(*ours.values())
    if all(names == set(printed) for names in ours.values()):
        return published, ""
    average = published["group"].isin(AVERAGES)
    if together == set(printed):
        average &= published["method"].isin([method for method, names in ours.items() if names != together])
    footnote = (
        f"The paper's averages are over {', '.join(printed)}. They are not shown where ours are over other categories."
    )
    return published.assign(value=published["value"].mask(average)), footnote


def weight_footnote(categories: Mapping[str, Sequence[str]], counts: Mapping[str, int]) -> str:
    """Say it if a mean over our shapes weighs the paper's categories otherwise than the paper does.

    Parameters
    ----------
    categories
        The category of every shape that was run, by method.
    counts
        The paper's number of shapes in each category.
    """
    for of_shapes in categories.values():
        ratios = {Fraction(of_shapes.count(category), count) for category, count in counts.items()}
        if set(of_shapes) == set(counts) and len(ratios) > 1:
            printed = ", ".join(f"{category} {count}" for category, count in counts.items())
            return (
                f"A mean over shapes weighs a category by its number of shapes. The paper's are {printed}; ours are in "
                "another proportion, so only the means over categories weigh alike."
            )
    return ""


def origin_footnote(dataset: str, counts: Mapping[str, int]) -> str:
    """Say what the lines of a table are, and on which shapes each was measured."""
    return (
        f"Lines: paper, as printed for the {sum(counts.values())} test shapes of the Point2Skeleton subset of "
        f"ShapeNet; ours, computed on the data set {dataset}; difference, ours minus paper, which compares like with "
        "like only if both used the same shapes. Categories are matched by name. Standard deviations: see the CSV file."
    )


def compose_footnotes(footnotes: Iterable[str], published: pd.DataFrame) -> tuple[str, ...]:
    """Return the footnotes that say something, then the notes of the published values that are shown."""
    shown = published[published["value"].notna()]
    return (*(note for note in footnotes if note), *published_footnotes(shown))
