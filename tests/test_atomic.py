import contextlib
import multiprocessing
import time

from morphoskel.atomic import atomic_file, atomic_folder


def test_a_failed_write_leaves_the_old_file(tmp_path):
    path = tmp_path / "deep" / "table.csv"
    with atomic_file(path) as partial:
        partial.write_text("old")
    with contextlib.suppress(RuntimeError), atomic_file(path) as partial:
        partial.write_text("half")
        raise RuntimeError
    assert path.read_text() == "old"
    assert [entry.name for entry in path.parent.iterdir()] == ["table.csv"]


def test_a_failed_folder_leaves_the_old_folder(tmp_path):
    folder = tmp_path / "shard"
    with atomic_folder(folder) as partial:
        (partial / "a").write_text("old")
        assert not folder.exists()
    with contextlib.suppress(RuntimeError), atomic_folder(folder) as partial:
        (partial / "b").write_text("half")
        raise RuntimeError
    assert [entry.name for entry in folder.iterdir()] == ["a"]
    assert [entry.name for entry in tmp_path.iterdir()] == ["shard"]


def test_what_a_dead_job_left_is_replaced(tmp_path):
    (tmp_path / "shard.partial").mkdir()
    (tmp_path / "shard.partial" / "stale").write_text("")
    with atomic_folder(tmp_path / "shard") as partial:
        (partial / "fresh").write_text("")
    assert [entry.name for entry in (tmp_path / "shard").iterdir()] == ["fresh"]


def _write_slowly(folder, started, name):
    with atomic_folder(folder) as partial:
        started.set()
        (partial / name).write_text("")
        time.sleep(0.5)


def test_a_second_writer_waits_for_the_first(tmp_path):
    """Both would otherwise fill the same temporary folder, as after the kill of a workflow whose job lives on."""
    context = multiprocessing.get_context("spawn")
    started = context.Event()
    first = context.Process(target=_write_slowly, args=(tmp_path / "shard", started, "first"))
    first.start()
    started.wait()
    with atomic_folder(tmp_path / "shard") as partial:
        assert (tmp_path / "shard" / "first").exists()
        (partial / "second").write_text("")
    first.join()
    assert first.exitcode == 0
    assert [entry.name for entry in (tmp_path / "shard").iterdir()] == ["second"]
