"""Tags of meshio's cells, and what they are called."""

from __future__ import annotations

import typing
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from ._masks import plain
from ._names import Names

_TAGS = ("gmsh:physical", "medit:ref", "cell_tags", "nastran:ref", "netgen:index", "su2:tag")
_DIMENSIONS = {"vertex": 0, "line": 1, "triangle": 2, "quad": 2, "polygon": 2}


class Tags(typing.NamedTuple):
    ids: Optional[list[npt.NDArray[Any]]]
    """A number for each cell of each block; None if the mesh has none."""
    names: Names


def kind_and_cells(block: Any) -> tuple[str, Any]:
    return (str(block.type), block.data) if hasattr(block, "type") else (str(block[0]), block[1])


def tags_of(mesh: Any, own: str) -> Tags:
    """The numbers in the array `own`, or as readers of meshio call it; without one, those of the sets of cells."""
    data = getattr(mesh, "cell_data", None) or {}
    name = next((n for n in (own, *_TAGS) if n in data), None)
    if name is None:
        return _tags_of_sets(mesh)
    ids = [_without_columns(plain(values, name)) for values in data[name]]
    names = names_in_fields(getattr(mesh, "field_data", None) or {})
    for number, groups in (getattr(mesh, "cell_tags", None) or {}).items():  # those of MED have no dimension
        for i, block in enumerate(mesh.cells):
            if groups and np.any(ids[i] == number):
                names[_field_of(kind_and_cells(block)[0])].setdefault(int(number), ", ".join(groups))
    return Tags(ids, names)


def _without_columns(values: npt.NDArray[Any]) -> npt.NDArray[Any]:
    """meshio's reader of legacy VTK gives arrays of one column."""
    return values[:, 0] if values.ndim == 2 and values.shape[1] == 1 else values


def _field_of(kind: str) -> int:
    """The place in Names of what cells of a kind are tagged by."""
    return _PLACES[_DIMENSIONS.get(kind.rstrip("0123456789"), 3)]


_PLACES = {dimension: Names._fields.index(field) for dimension, field in enumerate(("points", "segments", "triangles", "regions"))}


def _tags_of_sets(mesh: Any) -> Tags:
    """Sets are numbered from 1 in each dimension; a cell of several gets the number of the first."""
    names = Names({}, {}, {}, {})
    kinds = [kind_and_cells(block) for block in mesh.cells]
    ids = [np.zeros(len(cells), np.int64) for _, cells in kinds]
    for name, parts in (getattr(mesh, "cell_sets", None) or {}).items():
        if name.startswith("gmsh:"):
            continue
        for i, members in enumerate(parts):
            if members is None or len(members) == 0:
                continue
            known = names[_field_of(kinds[i][0])]
            number = next((n for n, other in known.items() if other == name), len(known) + 1)
            known[number] = name
            here = plain(members, f"the set {name!r}")
            ids[i][here[ids[i][here] == 0]] = number
    return Tags(ids if any(names) else None, names)


def names_in_fields(fields: typing.Mapping[str, Any]) -> Names:
    """Names as readers of meshio give them: pairs of id and dimension by name. Other fields are passed over."""
    names = Names({}, {}, {}, {})
    for name, values in fields.items():
        pairs = np.asarray(values)
        if pairs.dtype.kind not in "iu" or pairs.size == 0 or pairs.size % 2:
            continue
        for number, dimension in pairs.reshape(-1, 2).tolist():
            if dimension in _PLACES:
                names[_PLACES[dimension]].setdefault(number, name)
    return names


def pairs_of(names: Names) -> list[tuple[str, int, int]]:
    """Name, id and dimension of all that is named, larger dimensions first."""
    return [(name, number, dimension) for dimension in (3, 2, 1, 0) for number, name in names[_PLACES[dimension]].items()]


def fields_of(names: Names) -> dict[str, npt.NDArray[np.int32]]:
    """The reverse of names_in_fields. Writers of meshio take one pair for a name: a second one is called NAME_ID."""
    fields: dict[str, npt.NDArray[np.int32]] = {}
    for name, number, dimension in pairs_of(names):
        unused = name if name not in fields else f"{name}_{number}"
        while unused in fields:
            unused += "_"
        fields[unused] = np.array([number, dimension], np.int32)
    return fields
