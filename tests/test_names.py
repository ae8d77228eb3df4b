from morphoskel.reporting.names import method_name, skeleton_name, surface_name


def test_names_of_the_paper_and_names_of_the_user():
    assert [surface_name(name) for name in ("poisson", "ball_pivoting", "mine")] == ["Poisson", "BPA", "mine"]
    assert [skeleton_name(name) for name in ("ms3d", "l1_medial", "mine")] == ["MS3D", "L1", "mine"]


def test_names_of_the_paper_stay():
    assert (surface_name("Alpha"), skeleton_name("P2S")) == ("Alpha", "P2S")


def test_rows_that_the_paper_has_keep_its_names():
    assert method_name("ms3d", "poisson") == "MS3D"
    assert method_name("l1_medial", "cloud") == "L1"
    assert method_name("point2skeleton", "cloud", "dense") == "P2S"


def test_other_rows_say_what_they_are():
    assert method_name("point2skeleton", "cloud") == "P2S, own balls"
    assert method_name("ms3d_coverage", "repaired_poisson", "100") == "MS3D coverage, repaired Poisson, 100 balls"
