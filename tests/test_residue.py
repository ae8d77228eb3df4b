import numpy as np

from morphoskel.morphology import dilation, residue


def test_residue_vanishes_exactly_at_local_maxima():
    generator = np.random.default_rng(0)
    points, values = generator.random((500, 3), dtype=np.float32), generator.random(500, dtype=np.float32)
    dilated = dilation(points, values, 10)
    residues = residue(values, dilated)
    assert (residues >= 0).all()
    assert np.array_equal(residues == 0, dilated == values)
    assert residues[np.argmax(values)] == 0
