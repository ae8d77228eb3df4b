"""The residue of a dilation: how far a point is from being a local maximum (paper, Eq. 5)."""

import numpy as np
import numpy.typing as npt


def residue(values: npt.NDArray[np.float32], dilated: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
    """Return `dilated` minus `values`; of the UDF, it is 0 exactly where a ball is locally maximal.

    Parameters
    ----------
    values, dilated
        ``(N,)`` float32, a function and its dilation.

    Returns
    -------
    ndarray
        ``(N,)`` float32, at least 0.
    """
    return dilated - values
