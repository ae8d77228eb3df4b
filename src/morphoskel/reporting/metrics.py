"""The quantities that tables show: their names, units, number formats, and which direction is better."""

from dataclasses import dataclass
from typing import Literal

from morphoskel.errors import InputError


@dataclass(frozen=True)
class Metric:
    """A quantity in a table.

    Parameters
    ----------
    name
        Its name in CSV files.
    title
        Its name for readers.
    unit
        Its unit for readers; empty for distances, which are in the units of the data set.
    decimals
        Number of decimals shown, as many as the paper prints.
    better
        Which direction is better; ``None`` if rows are not rivals, and no value is to be set in bold.
    part_of
        Name of the metric in whose cells readers see this one; empty if it has a table of its own.
    form
        How it is written there, behind the other value, with ``{}`` for the number.
    never_zero
        Whether a positive value that rounds to 0 is shown as less than the last decimal, since 0 would be wrong.
    """

    name: str
    title: str
    unit: str
    decimals: int
    better: Literal["lower", "higher"] | None
    part_of: str = ""
    form: str = "{}"
    never_zero: bool = False

    @property
    def heading(self) -> str:
        """Title, unit and direction."""
        details = [self.unit] if self.unit else []
        if self.better is not None:
            details.append(f"{self.better} is better")
        return f"{self.title} ({', '.join(details)})" if details else self.title


METRICS = {
    metric.name: metric
    for metric in (
        Metric("cd_recon", "CD-Recon", "", 4, "lower"),
        Metric("hd_recon", "HD-Recon", "", 4, "lower"),
        Metric("cd_mat", "CD-MAT", "", 4, "lower"),
        Metric("hd_mat", "HD-MAT", "", 4, "lower"),
        Metric("cd_mat_computed", "CD-MAT*", "", 4, "lower"),
        Metric("hd_mat_computed", "HD-MAT*", "", 4, "lower"),
        Metric("cd_recon_points", "CD-Recon, first term: points to spheres", "", 4, "lower"),
        Metric("cd_recon_spheres", "CD-Recon, second term: spheres to points", "", 4, "lower"),
        Metric("seconds", "Time a shape", "seconds", 2, None),
        Metric("seconds_total", "Time of all shapes", "seconds", 2, None),
        Metric("shapes", "Shapes", "count", 0, None),
        Metric("oa_all_points", "Overall accuracy of all points, without sampling", "%", 1, None),
        Metric("oa", "Overall accuracy", "%", 1, "higher"),
        Metric("oa_interval", "± half-width of the 95 % interval over shapes", "", 1, None, "oa", " ± {}"),
        Metric("oa_difference", "Difference of overall accuracies", "points of %", 1, None),
        Metric("oa_difference_low", "95 % interval over shapes", "", 1, None, "oa_difference", " ({}"),
        Metric("oa_difference_high", "", "", 1, None, "oa_difference", " to {})"),
        Metric("mcnemar_p", "P-value of McNemar's exact test, equal accuracies", "", 4, None, never_zero=True),
        Metric("oa_draws", "Overall accuracy, standard deviation over draws", "points of %", 2, None),
        Metric("map_all_points", "Mean average precision of all points, without sampling", "%", 1, None),
        Metric("map", "Mean average precision", "%", 1, "higher"),
        Metric("map_interval", "± half-width of the 95 % interval over shapes", "", 1, None, "map", " ± {}"),
        Metric("map_excluded", "Mean average precision, the query itself left out", "%", 1, "higher"),
        Metric("distinct_points", "Distinct points", "mean number a shape", 1, None),
        Metric("miou", "Mean intersection over union", "%", 1, "higher"),
        Metric("miou_interval", "± half-width of the 95 % interval over shapes", "", 1, None, "miou", " ± {}"),
        Metric("miou_difference", "Difference of mean intersections over union", "points of %", 1, None),
        Metric("miou_difference_low", "95 % interval over shapes", "", 1, None, "miou_difference", " ({}"),
        Metric("miou_difference_high", "", "", 1, None, "miou_difference", " to {})"),
        Metric("labels", "Points with a label", "mean number of different ones in a training shape", 1, None),
    )
}
"""Every metric by name, in the order in which a table shows them."""


def find_metric(name: str) -> Metric:
    """Return the metric of that name, or raise :class:`InputError` with the names that exist."""
    if name not in METRICS:
        raise InputError(f"there is no metric {name!r}; known are {', '.join(METRICS)} (morphoskel.reporting.metrics)")
    return METRICS[name]
