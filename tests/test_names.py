from morphoskel.reporting.names import skeleton_name, surface_name


def test_names_of_the_paper_and_names_of_the_user():
    assert [surface_name(name) for name in ("poisson", "ball_pivoting", "mine")] == ["Poisson", "BPA", "mine"]
    assert [skeleton_name(name) for name in ("ms3d", "l1_medial", "mine")] == ["MS3D", "L1", "mine"]


def test_names_of_the_paper_stay():
    assert (surface_name("Alpha"), skeleton_name("P2S")) == ("Alpha", "P2S")
