"""The workflow as a user runs it: the smallest experiment in a copy of the repository that the tests may edit."""

import hashlib
import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pandas as pd
import pytest
from conftest import REPOSITORY
from passed_on import telling
from workflow_copy import copy_repository, environment, run

pytestmark = [pytest.mark.workflow, pytest.mark.timeout(1800)]  # the first test waits for the whole run

EXPERIMENTS = sorted(path.stem for path in (REPOSITORY / "config" / "experiment").glob("*.yaml"))
TABLES = ["skeleton_reconstruction", "surface_reconstruction", "processing_time"]
SAMPLING_TABLES = ["object_classification", "point_cloud_retrieval", "skeleton_prior"]
EVERY_TABLE = [f"table_{name}" for name in [*TABLES, *SAMPLING_TABLES, "part_segmentation"]]
CHAIN = ["reconstruct", "watertight", "occupancy", "udf", "dilation", "select_skeleton"]


def planned(repository: Path, *words: str) -> set[str]:
    """Return the rules that would run."""
    output = run(repository, "experiment=smoke", *words, "--", "--dry-run", "--quiet", "rules")
    detailed = run(repository, "experiment=smoke", *words, "--", "--dry-run")
    if "Nothing to be done" in detailed + output:
        return set()
    return set(re.findall(r"^(?:local)?rule (\w+):", detailed, re.MULTILINE)) - {"all"}


def without_pictures(rules: set[str]) -> set[str]:
    """Leave out figures, what is computed for them alone, and the report."""
    return {rule for rule in rules if not rule.startswith("figure_")} - {"illustrate", "measure_scaling", "html_report"}


def fingerprints(repository: Path, run_name: str = "smoke") -> dict[str, str]:
    folder = repository / "results" / run_name / "skeletons"
    return {path.name: hashlib.sha256(path.read_bytes()).hexdigest()
            for path in sorted(folder.rglob("poisson/ms3d/*/*.ply"))}  # fmt: skip


@pytest.fixture(scope="module")
def smoke(tmp_path_factory):
    repository = copy_repository(tmp_path_factory.mktemp("smoke") / "repository")
    return repository, run(repository, "experiment=smoke")


@pytest.fixture
def restored(smoke):
    """Hand out the finished run, and put back whatever file of the library the test edits."""
    repository = smoke[0]
    yield repository
    for path in (REPOSITORY / "src").rglob("*.py"):
        copy = repository / path.relative_to(REPOSITORY)
        if copy.read_bytes() != path.read_bytes():
            shutil.copy(path, copy)


@pytest.mark.parametrize("experiment", EXPERIMENTS)
def test_every_experiment_can_be_planned(experiment, tmp_path):
    output = run(copy_repository(tmp_path / "repository"), f"experiment={experiment}", "--", "--dry-run")
    assert "table_skeleton_reconstruction" in output


@pytest.mark.parametrize("table", TABLES)
def test_smoke_writes_every_table(smoke, table):
    repository, output = smoke
    assert f"results/smoke/tables/{table}.{{csv,md,tex}}" in output
    for suffix in ("csv", "md", "tex"):
        assert (repository / f"results/smoke/tables/{table}.{suffix}").stat().st_size > 500
    frame = pd.read_csv(repository / f"results/smoke/tables/{table}.csv", keep_default_na=False)
    assert list(frame.columns) == ["dataset", "method", "group", "metric", "value", "std", "paper", "n", "n_failed",
                                   "seeds", "protocol"]  # fmt: skip
    assert (frame["n_failed"].astype(int) == 0).all()
    measured = frame[(frame["value"] != "not run") & (frame["group"] == "Chair")]
    # The second term of the Chamfer distance is 0 where radii are distances to the nearest point.
    assert (measured["value"].astype(float) >= 0).all()
    assert (measured.loc[measured["metric"] != "cd_recon_spheres", "value"].astype(float) > 0).all()
    assert len(measured) > 0


def test_every_method_is_compared_with_its_own_balls_and_with_equal_counts(smoke):
    frame = pd.read_csv(smoke[0] / "results/smoke/tables/skeleton_reconstruction.csv", keep_default_na=False)
    chair = frame[(frame["group"] == "Chair") & (frame["value"] != "not run")]
    methods = ["L1", "DPC", "P2S", "MS3D", "MS3D coverage", "Coverage Axis++"]
    repaired = [f"{method}, repaired Poisson" for method in methods[3:]]
    own = {"cd_recon", "hd_recon", "cd_mat_computed", "hd_mat_computed"}
    for method in [*methods, *repaired]:
        for row in (method, f"{method}, 50 balls", f"{method}, 256 balls"):
            assert own <= set(chair.loc[chair["method"] == row, "metric"]), row
    surfaces = pd.read_csv(smoke[0] / "results/smoke/tables/surface_reconstruction.csv", keep_default_na=False)
    measured = surfaces[(surfaces["group"] == "Chair") & (surfaces["value"] != "not run")]
    assert set(measured["method"]) == {"BPA", "Alpha", "Poisson", "PoNQ", "repaired Poisson", "P2S"}


def test_what_did_not_run_says_so(smoke):
    frame = pd.read_csv(smoke[0] / "results/smoke/tables/skeleton_reconstruction.csv", keep_default_na=False)
    assert set(frame.loc[frame["group"] == "Airplane", "value"]) == {"not run"}
    assert set(frame.loc[frame["metric"] == "cd_mat", "value"]) == {"not run"}
    output = run(smoke[0], "table_skeleton_reconstruction", "experiment=smoke", "skeleton=[ms3d]", "--", "--dry-run")
    assert not re.search(r"rule (l1_medial|dpc|train_point2skeleton|coverage_axis):", output)


def test_a_change_of_one_method_leaves_the_others(smoke):
    rules = planned(smoke[0], "methods.dpc.iterations=2")
    assert {"dpc", "evaluate_skeletons", "table_skeleton_reconstruction"} <= rules
    assert not rules & {*CHAIN, "l1_medial", "train_point2skeleton", "point2skeleton", "medial_axis", "cover_skeleton"}


def test_results_hold_the_resolved_configuration(smoke):
    assert "count: 40000" in (smoke[0] / "results/smoke/config.yaml").read_text()


def test_nothing_half_written_stays(smoke):
    assert list(smoke[0].rglob("*.partial")) == []


def test_a_second_run_has_nothing_to_do(smoke):
    assert planned(smoke[0]) == set()


def test_a_new_k_reruns_the_dilation_and_what_follows(smoke):
    rules = planned(smoke[0], "skeleton.k=10")
    assert {"figure_skeletons", "figure_explanation", "figure_dilation", "illustrate", "html_report"} <= rules
    assert "figure_contact_sheet" not in rules
    assert without_pictures(rules) == {
                     "dilation", "select_skeleton", "cover_skeleton", "evaluate_skeletons", "time_stages",
                     "write_config", *EVERY_TABLE,
                     "local_feature_size", "train_sampler", "choose_points", "evaluate_samples",
                     "choose_labelled_points", "train_segmentation", "evaluate_segmentation"}  # fmt: skip


def test_only_samplers_with_a_skeleton_of_ms3d_are_trained_again_for_a_new_k(smoke):
    output = run(smoke[0], "experiment=smoke", "skeleton.k=10", "--", "--dry-run")
    assert set(re.findall(r"networks/synthetic_smoke/sampler/(\w+)/8/0/network.pt$", output, re.MULTILINE)) == {
        "ms3d",
        "shuffled",
    }


def test_every_sampler_is_judged_by_both_classifiers(smoke):
    """Two steps teach nothing: what is tested is that every row is there, computed, and legal."""
    published = {"FPS", "S-NET", "SampleNet", "MetaSampler", "SA", "MS3D"}
    for table, metric in (("object_classification", "oa"), ("point_cloud_retrieval", "map")):
        path = smoke[0] / f"results/smoke/tables/{table}.csv"
        frame = pd.read_csv(path, keep_default_na=False, dtype={"group": str})
        measured = frame[(frame["value"] != "not run") & (frame["group"] == "8") & (frame["metric"] == metric)]
        twins = {f"{method}, classifier without point dropout" for method in published}
        assert published | {"Random", "LFS-weighted FPS"} | twins <= set(measured["method"])
        assert measured["value"].astype(float).between(0, 100).all()
        assert (measured["n"].astype(int) == 4).all()
        assert set(frame.loc[frame["group"] == "16", "value"]) == {"not run"}
    frame = pd.read_csv(smoke[0] / "results/smoke/tables/skeleton_prior.csv", keep_default_na=False)
    assert {"SA", "MS3D", "DPC", "L1", "uniform prior", "shuffled prior"} <= set(frame["method"])
    differences = set(frame.loc[frame["metric"] == "oa_difference", "method"])
    assert {"MS3D minus SA", "MS3D minus uniform prior", "MS3D minus shuffled prior"} <= differences


def test_parts_are_segmented_from_the_labels_of_every_strategy(smoke):
    frame = pd.read_csv(smoke[0] / "results/smoke/tables/part_segmentation.csv", keep_default_na=False)
    measured = frame[(frame["value"] != "not run") & (frame["metric"] == "miou") & (frame["group"] == "Chair")]
    few = ["FPS, ratio 16", "LFS-weighted FPS, ratio 16", "MS3D, ratio 16"]
    assert set(measured["method"]) == {"PointNet (all labels)", *few}
    assert measured["value"].astype(float).between(0, 100).all()
    assert (measured["n"].astype(int) == 2).all()
    labels = frame[frame["metric"] == "labels"].set_index("method")["value"]
    assert float(labels["FPS, ratio 16"]) == 16
    assert float(labels["MS3D, ratio 16"]) <= 16


def test_only_the_second_data_set_has_coarser_skeletons(smoke):
    output = run(smoke[0], "experiment=smoke", "tasks.segmentation.skeletons.candidates=30000", "--", "--dry-run")
    outputs = re.findall(r"^    output: (results/smoke/occupancy/\S+)", output, re.MULTILINE)
    assert outputs
    assert all("/synthetic_smoke_parts/train/" in path for path in outputs)


def test_trainings_leave_logs_and_curves(smoke):
    folders = list((smoke[0] / "results/smoke/checkpoints").rglob("training.json"))
    # Two teachers instead of three, samplers, two skeleton networks, and networks for parts.
    assert len(folders) == 5 - 1 + 9 + 1 + 1 + 4
    for folder in (path.parent for path in folders):
        assert list(folder.glob("*.csv"))
        assert list(folder.glob("curves/*/events*"))


def test_a_new_protocol_rewrites_the_tables_only(smoke):
    assert without_pictures(planned(smoke[0], "protocol=released")) == {"write_config", *EVERY_TABLE}


def test_every_figure_is_a_png_and_a_pdf(smoke):
    folder = smoke[0] / "results/smoke/figures"
    drawn = {path.stem for path in folder.glob("*.png")}
    assert {path.stem for path in folder.glob("*.pdf")} == drawn
    assert {"overview", "rationale", "spheres", "samples", "segmentation", "accuracy", "scaling"} <= drawn
    assert all((folder / f"{name}.png").stat().st_size > 10_000 for name in drawn)


def test_the_page_shows_every_table_and_figure(smoke):
    page = (smoke[0] / "results/smoke/report/index.html").read_text(encoding="utf-8")
    assert len(page) < 15_000_000
    assert str(smoke[0]) not in page
    for path in [*smoke[0].glob("results/smoke/figures/*.png"), *smoke[0].glob("results/smoke/tables/*.csv")]:
        assert path.stem in page


def test_what_is_passed_on_tells_nothing_of_this_machine(smoke):
    """Report, tables and figures, and the report that Snakemake makes of them."""
    folder = smoke[0] / "results/smoke"
    (folder / "snakemake").mkdir()
    run(smoke[0], "experiment=smoke", "--", "--report", "results/smoke/snakemake/report.html")
    for name in ("report", "tables", "figures", "snakemake"):
        assert telling(folder / name, [str(smoke[0]), str(Path.home())]) == []


def test_a_docstring_reruns_nothing(restored):
    edit(restored / "src/morphoskel/morphology/dilation.py", '"""Return the largest value', '"""Give the largest value')
    edit(restored / "src/morphoskel/surface/watertight.py", '"""Return a closed', '"""Give a closed')
    assert planned(restored) == set()


def test_an_imported_function_reruns_what_runs_it(restored):
    edit(restored / "src/morphoskel/morphology/dilation.py", "threads=threads", "threads=1")
    rules = planned(restored)
    assert {"dilation", "select_skeleton", "evaluate_skeletons", "time_stages"} <= rules
    assert not rules & {"reconstruct", "watertight", "occupancy", "udf", "write_manifest", "generate_synthetic"}


def test_a_changed_builder_makes_the_shapes_and_all_that_follows_again(restored):
    edit(restored / "src/morphoskel/datasets/synthetic/categories/mug.py", "draw = generator.uniform",
         "draw = generator.normal")  # fmt: skip
    assert {"generate_synthetic", "write_manifest", *CHAIN} <= planned(restored)


def test_a_lost_shard_is_made_again_alone(smoke):
    folder = next((smoke[0] / "results/smoke/udf").rglob("status.csv")).parent
    kept = folder.rename(folder.with_name("kept"))
    output = run(smoke[0], "experiment=smoke", "--", "--dry-run", "--", str(folder.relative_to(smoke[0])))
    kept.rename(folder)
    assert re.findall(r"^(?:local)?rule (\w+):", output, re.MULTILINE) == ["udf"]


def edit(path: Path, old: str, new: str):
    text = path.read_text()
    assert old in text
    path.write_text(text.replace(old, new))


def test_a_killed_run_goes_on_to_the_same_skeletons(smoke, tmp_path):
    repository = copy_repository(tmp_path / "repository")
    shutil.copytree(smoke[0] / "resources" / "data", repository / "resources" / "data")
    words = ["experiment=smoke", "surface=[poisson]", "skeleton=[ms3d]", "shard_size=1"]
    target = "results/smoke/evaluation/synthetic_smoke/test/poisson/ms3d.csv"
    command = [sys.executable, "-m", "morphoskel.cli", "run", target, *words]
    first = subprocess.Popen(command, cwd=repository, env=environment(repository), start_new_session=True,
                             stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)  # fmt: skip
    deadline = time.monotonic() + 200
    while not list(repository.glob("results/smoke/occupancy/**/status.csv")) and time.monotonic() < deadline:
        assert first.poll() is None
        time.sleep(0.05)
    os.killpg(first.pid, signal.SIGKILL)
    first.wait()
    assert not (repository / target).exists()
    output = run(repository, target, *words)
    assert "its lock is removed" in output
    assert fingerprints(repository) == fingerprints(smoke[0])
    assert list(repository.rglob("*.partial")) == []


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["skeleton.kk=3"], "did you mean 'skeleton.k'"),
        (["dataset=folder", "dataset.root=absent"], "absent"),
        (["dataset=point2skeleton", "dataset.root=absent"], "absent"),
        (["dataset.categories=[Char]"], "Chair"),
    ],
)
def test_mistakes_are_told_before_or_instead_of_work(words, message, tmp_path):
    repository = copy_repository(tmp_path / "repository")
    output = run(repository, "table_surface_reconstruction", *words, check=False)
    assert message in output
    assert not (repository / "results").exists() or not list(repository.glob("results/*/tables/*"))


def test_a_public_archive_is_fetched_unpacked_and_listed(tmp_path):
    """ModelNet40 in miniature, served from this machine."""
    import functools
    import http.server
    import threading
    import zipfile

    import numpy as np

    served = tmp_path / "served"
    served.mkdir()
    generator = np.random.default_rng(0)
    with zipfile.ZipFile(served / "mini.zip", "w") as archive:
        for name, split in (("chair_0001", "train"), ("chair_0002", "test")):
            rows = "\n".join(",".join(f"{value:.6f}" for value in row) for row in generator.normal(size=(50, 6)))
            archive.writestr(f"mini/chair/{name}.txt", rows + "\n")
            archive.writestr(f"mini/modelnet40_{split}.txt", name + "\n")
        archive.writestr("mini/modelnet40_shape_names.txt", "chair\n")
    digest = hashlib.sha256((served / "mini.zip").read_bytes()).hexdigest()
    handler = functools.partial(http.server.SimpleHTTPRequestHandler, directory=str(served))
    server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), handler)
    threading.Thread(target=server.serve_forever, daemon=True).start()
    repository = copy_repository(tmp_path / "repository")
    words = ["resources/manifest/modelnet40.csv", "dataset=modelnet40", "dataset.counts={train: 1, test: 1}",
             f"dataset.url=http://127.0.0.1:{server.server_address[1]}/mini.zip"]  # fmt: skip
    try:
        assert digest in run(repository, *words, check=False)  # asks to confirm the sum that it found
        run(repository, *words, f"dataset.sha256={digest}")
    finally:
        server.shutdown()
        server.server_close()
    manifest = pd.read_csv(repository / "resources/manifest/modelnet40.csv")
    assert manifest["id"].tolist() == ["chair_0002", "chair_0001"]
