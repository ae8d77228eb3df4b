import numpy as np

from morphoskel.surface.ponq.cells import assign_to_cells, sum_in_cells


def test_every_sample_goes_to_its_nearest_site():
    generator = np.random.default_rng(0)
    samples, sites = generator.normal(size=(300, 3)), generator.normal(size=(40, 3))
    distances = np.linalg.norm(samples[:, None] - sites, axis=2)
    assert np.array_equal(assign_to_cells(samples, sites), distances.argmin(axis=1))


def test_of_coincident_sites_one_takes_all():
    samples = np.random.default_rng(1).normal(size=(50, 3))
    assert len(np.unique(assign_to_cells(samples, np.zeros((5, 3))))) == 1


def test_sums_cell_by_cell():
    generator = np.random.default_rng(2)
    values, cells = generator.normal(size=(100, 4)), generator.integers(0, 7, size=100)
    expected = np.zeros((9, 4))
    for value, cell in zip(values, cells, strict=True):
        expected[cell] += value
    assert np.array_equal(sum_in_cells(values, cells, 9), expected)
    assert not expected[7:].any()
