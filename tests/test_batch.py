import pytest
from solids import sphere_cloud

from morphoskel import skeletonization
from morphoskel.batch import arguments_of, skeletonize_files
from morphoskel.config import compose
from morphoskel.errors import ConfigError
from morphoskel.formats import write_cloud_ply
from morphoskel.methods import METHODS
from morphoskel.run_method import check_settings


@pytest.mark.parametrize("method", METHODS)
def test_the_configuration_gives_settings_that_the_method_has(method):
    check_settings(method, arguments_of(compose(), method, "poisson")["settings"])


def test_values_come_from_the_sections_of_the_method():
    config = compose(
        [
            "skeleton.points=7",
            "skeleton.coverage.nominees=3",
            "methods.coverage_axis.points=5",
            "methods.dpc.step=0.3",
            "surface.ponq.sites=9",
        ]
    )
    coverage = arguments_of(config, "ms3d_coverage", "ponq")
    assert (coverage["points"], coverage["settings"]["nominees"]) == (7, 3)
    assert coverage["reconstruction"]["sites"] == 9
    assert arguments_of(config, "coverage_axis", "ponq")["points"] == 5
    deep = arguments_of(config, "dpc", "no surface is needed")
    assert deep["settings"]["step"] == 0.3
    assert "surface" not in deep


@pytest.mark.parametrize(
    ("overrides", "method", "surface", "message"),
    [
        (["skeleton=[ms3d,dpc]"], "l1_medial", "poisson", r"configured are ms3d, ms3d_coverage, dpc.*ms3d,l1_medial\]"),
        (["surface=[poisson]"], "ms3d", "ponq", r"configured are poisson\. .*surface="),
        ([], "ms4d", "poisson", "did you mean 'ms3d'"),
    ],
)
def test_what_is_not_configured_is_refused(overrides, method, surface, message):
    with pytest.raises(ConfigError, match=message):
        arguments_of(compose(overrides), method, surface)


def test_an_unexpected_error_does_not_stop_the_other_files(tmp_path, monkeypatch):
    files = [tmp_path / f"{name}.ply" for name in "ab"]
    for path in files:
        write_cloud_ply(path, sphere_cloud(200))
    real = skeletonization.skeletonize_shape

    def give_up_on_a(shape, *, name, **arguments):
        if name == "a":
            raise RuntimeError("no facet\nmany lines follow")
        return real(shape, name=name, **arguments)

    monkeypatch.setattr(skeletonization, "skeletonize_shape", give_up_on_a)
    result = skeletonize_files(
        files, tmp_path / "out", compose(), method="l1_medial", surface="poisson", progress=False
    )
    assert result.failures == {files[0]: "RuntimeError: no facet"}
    assert [path.name for path in result.written] == ["b.ply", "b.npz"]
