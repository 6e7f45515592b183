"""Files of meshes in other formats, as the program's `convert` writes them."""

from __future__ import annotations

import os
import subprocess
import typing
from typing import Optional, Union

from ._limits import MemoryAmount, bytes_of, threads_of
from ._names import Names, names_of
from ._program import program
from ._surface import PathLike
from .errors import FileError, HoldfastError, MemoryLimit, TimeLimit

_KINDS = (("triangles", ""), ("regions", "region:"), ("segments", "segment:"), ("points", "vertex:"))


def convert(
    source: PathLike,
    target: PathLike,
    *,
    only: Union[None, str, typing.Sequence[str]] = None,
    each_region: bool = False,
    scale: Optional[float] = None,
    order: Optional[int] = None,
    curved: Optional[PathLike] = None,
    curved_tolerance: Optional[float] = None,
    names: Union[None, Names, typing.Mapping[str, typing.Mapping[int, str]]] = None,
    format: Optional[str] = None,
    input_format: Optional[str] = None,
    binary: bool = False,
    one_file: bool = False,
    gzip: bool = False,
    shells: bool = False,
    threads: int = 1,
    time_limit: Optional[float] = None,
    memory_limit: Optional[MemoryAmount] = None,
) -> list[str]:
    """Converts a file of a surface or a volume: from any format that the program reads to any that it writes.

    Parameters
    ----------
    source, target
        Files; their endings give the formats, unless `input_format` and `format` do ("msh2" is version 2.2 of .msh).
        A volume becomes its boundary and interfaces in a format that only holds surfaces (.stl, .ply, .obj, .off, .poly).
    only
        "volume" (only the tetrahedra), "surface", or "region=ID" with an id or a name; several of these in a list.
    each_region
        A file for each region, NAME_REGION beside `target`.
    scale
        A factor on all lengths.
    order
        1 or 2: without or with nodes in the middle of edges; None leaves them as they are. `curved` and
        `curved_tolerance` are those of `TetMesh.second_order`.
    names
        Names of ids, which take precedence over those of the file: {"triangles": {3: "inlet"}, "regions": {10: "core"}}.
    binary, one_file, gzip, shells, threads
        As `TetMesh.save` takes them.
    time_limit, memory_limit
        As `mesh` takes them.

    Returns
    -------
    list of str
        What the target cannot hold, or holds in another form, one line each.

    Raises
    ------
    FileError
        If a file cannot be read or written.
    ValueError
        For options that make no sense, or do nothing in the format.
    TimeLimit, MemoryLimit
        If a limit was reached; then there is no new file.

    >>> import holdfast, os, tempfile
    >>> mesh = holdfast.mesh([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)],
    ...                      [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)], fill=True)
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     one, two = os.path.join(folder, "one.vtu"), os.path.join(folder, "two.med")
    ...     told = mesh.save(one)
    ...     told = holdfast.convert(one, two, scale=2, order=2, names={"regions": {1: "core"}})
    ...     found = holdfast.info(two)
    >>> found["order"], round(found["volume"], 6), found["regions"][0]["name"]
    (2, 1.333333, 'core')
    """
    words = [program(), "convert", os.fsdecode(source), os.fsdecode(target), "--threads", str(threads_of(threads))]
    for part in [only] if isinstance(only, str) else only or []:
        words += ["--only", part]
    for option, value in (("--scale", scale), ("--order", order), ("--curved", curved), ("--curved-tolerance", curved_tolerance),
                          ("--format", format), ("--input-format", input_format), ("--time-limit", time_limit)):
        if value is not None:
            words += [option, os.fsdecode(value) if isinstance(value, os.PathLike) else str(value)]
    if (memory := bytes_of(memory_limit)) is not None:
        words += ["--memory-limit", repr(memory / 1e9)]
    for option, given in (("--each-region", each_region), ("--binary", binary), ("--one-file", one_file), ("--gzip", gzip),
                          ("--shells", shells)):
        words += [option] if given else []
    table = names_of(names)
    for kind, prefix in _KINDS:
        for id, name in getattr(table, kind).items():
            words += ["--name", f"{prefix}{id}={name}"]
    done = subprocess.run(words, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, check=False,
                          encoding="utf-8", errors="replace")
    lines = [line.removeprefix("holdfast: ") for line in done.stderr.splitlines()]
    if done.returncode == 0:
        return lines[:-1] if lines and not done.stderr.splitlines()[-1].startswith("holdfast: ") else lines
    message = "; ".join(lines) or f"the program ended with {done.returncode}"
    if done.returncode == 2:
        raise ValueError(message)
    if done.returncode == 3:
        raise FileError(message, next((f for f in (os.fsdecode(source), os.fsdecode(target)) if message.startswith(f)), ""))
    if done.returncode == 5:
        raise MemoryLimit(message) if "memory" in message else TimeLimit(message)
    raise HoldfastError(message)
