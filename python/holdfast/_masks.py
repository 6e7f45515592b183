"""numpy's masked arrays as arguments: without masked entries they are ordinary arrays; a masked entry is an error."""

from __future__ import annotations

import typing
from typing import Any

import numpy as np
import numpy.ma as ma
import numpy.typing as npt


def plain(values: Any, what: str, dtype: npt.DTypeLike = None) -> npt.NDArray[Any]:
    """The argument as an array, without a copy if it is one. Raises ValueError for the first masked entry.

    >>> plain(np.ma.array([1, 2], mask=[False, False]), "sizes")
    array([1, 2])
    >>> plain(np.ma.array([1, 2], mask=[False, True]), "sizes")
    Traceback (most recent call last):
    ValueError: sizes[1] is masked: it has no value
    """
    if isinstance(values, (list, tuple)) and any(isinstance(value, ma.MaskedArray) for value in values):
        values = ma.array([ma.asarray(value) for value in values])  # type: ignore[no-untyped-call]
    if isinstance(values, ma.MaskedArray):
        require_unmasked(values, what)
        values = values.data
    return np.asarray(values, dtype)


def require_unmasked(values: Any, what: str) -> None:
    """Raises ValueError if it is an array with a masked entry."""
    if not isinstance(values, ma.MaskedArray):
        return
    mask = ma.getmaskarray(values)  # type: ignore[no-untyped-call]
    if mask.any():
        at: typing.Sequence[Any] = np.unravel_index(int(np.argmax(mask)), mask.shape)
        place = "[" + ", ".join(str(int(i)) for i in at) + "]" if mask.ndim else ""
        raise ValueError(f"{what}{place} is masked: it has no value")
