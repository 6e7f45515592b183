"""The inputs of `mesh`: one surface, several parts, or pasted parts."""

from __future__ import annotations

import typing
from typing import Any, Optional, Union

import numpy as np

from . import _core
from ._limits import Progress, length
from ._paste import Pasted, names_of_parts, parts_in, pasted_parts
from ._surface import Surface, _of_data, surface_of


class Given(typing.NamedTuple):
    surface: Surface
    pasted: Optional[Pasted]


def joined(surfaces: typing.Sequence[Surface], names: typing.Sequence[str]) -> Surface:
    """Parts as one surface, joined as the program joins files: a part without markers gets one, with the part's name."""
    if not surfaces:
        raise ValueError("there is no surface")
    if len(surfaces) == 1:
        return surfaces[0]
    for k, part in enumerate(surfaces, 1):
        _require_own_points(part, k)
    return _of_data(_core.join_parts([s._given() for s in surfaces], names))


def _require_own_points(part: Surface, number: int) -> None:
    """Refuses indices beyond a part's own points: they would name points of the next part."""
    for what, rows in (("triangle", part.triangles), ("segment", part.segments)):
        if rows is None or not len(rows):
            continue
        bad = (np.asarray(rows) < 0) | (np.asarray(rows) >= len(part.points))
        if bad.any():
            row = int(np.argmax(bad.any(axis=1)))
            raise ValueError(f"{what} {row} of part {number} names point {int(rows[row][np.argmax(bad[row])])}, "
                             f"of {len(part.points)}")


def given(
    surface: Any,
    triangles: Any,
    more: dict[str, Any],
    *,
    paste: Union[bool, float],
    overlap: str,
    repairs: bool,
    options: dict[str, Any],
    progress: Progress,
) -> Given:
    """Takes the arguments of `mesh`; `more` are segments and markers, `options` those of limits and threads."""
    if isinstance(paste, np.bool_):
        paste = bool(paste)
    if not isinstance(overlap, str):
        raise TypeError(f'overlap={overlap!r}: "refuse", "first", "last" or "new" is expected')
    pastes = paste is not False
    if repairs and (pastes or overlap != "refuse"):
        raise ValueError("paste and overlap are for parts that are valid; with repair all parts are one surface")
    if isinstance(surface, Pasted):
        return _as_pasted(surface, triangles, more, pastes, overlap, repairs)
    parts = parts_in(surface) if triangles is None else None
    several = parts is not None and len(parts) != 1
    if several and any(x is not None for x in more.values()):
        raise ValueError("segments and markers are those of each part: leave them out beside several, or give a `Surface` for each")
    if parts is not None and repairs:
        surfaces = [surface_of(part, reading=options) for part in parts]
        return Given(surface_of(joined(surfaces, names_of_parts(parts, None)), **more), None)
    if not several and not pastes:
        if overlap != "refuse":
            raise ValueError(f"overlap={overlap!r} does nothing for one surface: paste=True makes parts of its components")
        return Given(surface_of(surface if parts is None else parts[0], triangles, **more, reading=options), None)
    if parts == []:
        raise ValueError("there is no surface")
    how = dict(options, overlap=overlap, cut=pastes, judge=False)
    if pastes and paste is not True:
        how["tolerance"] = length(paste, "paste")
        if how["tolerance"] == 0:
            raise ValueError("paste=0.0: a positive tolerance is expected; True is none")
    if several:
        assert parts is not None
        surfaces = [surface_of(part, reading=options) for part in parts]
    else:
        surfaces = [surface_of(surface if parts is None else parts[0], triangles, **more, reading=options)]
    names = names_of_parts([surface] if parts is None else parts, None)
    pasted = pasted_parts(surfaces, names, how, progress)
    if not pastes and overlap == "refuse" and pasted.shared_triangles == 0:
        return Given(joined(surfaces, names), None)
    return Given(pasted.surface, pasted)


def _as_pasted(pasted: Pasted, triangles: Any, more: dict[str, Any], pastes: bool, overlap: str, repairs: bool) -> Given:
    if triangles is not None or any(x is not None for x in more.values()):
        raise ValueError("a pasted surface is meshed as it is: leave out triangles, segments and markers")
    if repairs:
        raise ValueError("a pasted surface is valid: leave out repair")
    if pastes or overlap != "refuse":
        raise ValueError("the parts are pasted already: leave out paste and overlap, which `paste` takes")
    if pasted.mesh is not None:
        raise ValueError("the pasted meshes are one already, `Pasted.mesh`; `mesh(pasted.surface)` fills their boundary anew")
    return Given(pasted.surface, pasted)
