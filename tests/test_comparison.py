import pandas as pd

from morphoskel.evaluation.averages import MEAN_OVER_SHAPES
from morphoskel.reporting.comparison import compose_footnotes, weight_footnote, withhold_averages


def published():
    rows = [
        ("set", method, group, "cd_recon", 0.1, "a note" if group == MEAN_OVER_SHAPES else "")
        for method in ("L1", "MS3D")
        for group in ("Mug", "Chair", MEAN_OVER_SHAPES)
    ]
    return pd.DataFrame(rows, columns=["table", "method", "group", "metric", "value", "note"])


def shown(frame):
    """Return the methods whose average is shown."""
    return list(frame.loc[(frame["group"] == MEAN_OVER_SHAPES) & frame["value"].notna(), "method"])


def test_averages_stay_over_the_same_categories_and_if_nothing_was_run():
    for categories in ({"MS3D": ["Chair", "Mug", "Mug"]}, {}):
        frame, footnote = withhold_averages(published(), categories)
        assert frame.equals(published())
        assert footnote == ""


def test_averages_go_over_other_categories():
    for categories in ({"MS3D": ["Chair"]}, {"MS3D": ["Chair", "Mug", "Torus"]}):
        frame, footnote = withhold_averages(published(), categories)
        assert shown(frame) == []
        assert frame.loc[frame["group"] == "Mug", "value"].notna().all()
        assert "averages are over Mug, Chair" in footnote


def test_only_the_method_on_fewer_categories_loses_its_average():
    frame, footnote = withhold_averages(published(), {"L1": ["Chair"], "MS3D": ["Chair", "Mug"]})
    assert shown(frame) == ["MS3D"]
    assert footnote


def test_notes_of_withheld_values_are_not_shown():
    frame, footnote = withhold_averages(published(), {"MS3D": ["Chair"]})
    assert compose_footnotes(["", footnote], frame) == (footnote,)
    assert len(compose_footnotes([], published())) == 1


def test_other_weights_are_told():
    counts = {"Mug": 2, "Chair": 4}
    assert weight_footnote({"MS3D": ["Mug", "Chair", "Chair"]}, counts) == ""
    assert "Mug 2, Chair 4" in weight_footnote({"MS3D": ["Mug", "Chair"]}, counts)
    assert weight_footnote({"MS3D": ["Mug"]}, counts) == ""
