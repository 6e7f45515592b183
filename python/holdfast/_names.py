"""Names of markers and regions."""

from __future__ import annotations

import typing
from typing import Any, NoReturn, Optional, Union


class Fixed(dict[int, str]):
    """Names of a mesh. It keeps its own, so that one that is put here would be in no file."""

    def _refuse(self, *_: Any, **__: Any) -> NoReturn:
        raise TypeError("the names of a mesh cannot be changed: give others to save(path, names={...})")

    __setitem__ = __delitem__ = __ior__ = update = setdefault = pop = popitem = clear = _refuse  # type: ignore[assignment]

    def __reduce__(self) -> tuple[Any, ...]:
        return dict, (dict(self),)


class Names(typing.NamedTuple):
    """What ids mean: dictionaries of names by id.

    >>> Names(triangles={3: "inlet"}).triangles[3]
    'inlet'
    """

    triangles: dict[int, str] = {}
    """Names of triangle markers."""
    regions: dict[int, str] = {}
    """Names of region ids."""
    segments: dict[int, str] = {}
    """Names of segment markers."""
    points: dict[int, str] = {}
    """Names of point markers."""

    def __bool__(self) -> bool:
        return any(len(names) > 0 for names in self)


def names_of(names: Union[None, Names, typing.Mapping[str, typing.Mapping[int, str]]]) -> Names:
    """A copy; names may be given as a dictionary of dictionaries, {"triangles": {3: "inlet"}}."""
    if names is None:
        return Names({}, {}, {}, {})
    found = dict(names._asdict() if isinstance(names, Names) else names)
    unknown = sorted(set(found) - set(Names._fields))
    if unknown:
        raise ValueError(f"names: there is no {unknown[0]!r}; there are {', '.join(Names._fields)}")
    return Names(**{field: _checked(found.get(field)) for field in Names._fields})


def _checked(names: Optional[typing.Mapping[int, str]]) -> dict[int, str]:
    checked = {int(i): name for i, name in (names or {}).items()}
    for i, name in checked.items():
        if not isinstance(name, str):
            raise TypeError(f"names: the name of {i} must be a str, not {type(name).__name__}")
    return checked
