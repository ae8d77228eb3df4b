from morphoskel.chain.status import Status, read_status, write_status


def test_rows_come_back_sorted_with_awkward_reasons(tmp_path):
    rows = [
        Status("b", "Mug", "failed", "udf", 'a "quoted", reason\nin two lines', 2, 1.25, 7.5, ""),
        Status("a", "Chair", "ok", "udf", "", 1, 0.5, 0.5, "inside=3;largest=0.1"),
    ]
    write_status(tmp_path, rows)
    assert read_status(tmp_path) == rows[::-1]
