"""The parts of a batch: tasks, and the rows that earlier runs wrote about them."""

from __future__ import annotations

import contextlib
import json
import os
import typing
import zlib
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Optional, Union

PathLike = Union[str, "os.PathLike[str]"]
Row = dict[str, Any]

_FILES_OF_FORMAT = {".node": (".node", ".ele", ".face", ".edge")}


@dataclass(frozen=True)
class Task:
    """One part, as a worker gets it; plain data that can be sent to other processes and machines."""

    file: str
    output: str
    arguments: tuple[str, ...]
    time_limit: Optional[float]
    format: str


def rows_of(path: Path) -> typing.Iterator[Row]:
    """Complete lines; a killed run may have left a part of one."""
    try:
        lines = path.read_text(encoding="utf-8").splitlines()
    except FileNotFoundError:
        return
    for line in lines:
        with contextlib.suppress(json.JSONDecodeError):
            row = json.loads(line)
            if isinstance(row, dict) and "output" in row and "status" in row:
                yield row


def keep_better(rows: dict[str, Row], row: Row) -> None:
    """The latest row of a part. A row that says "skipped" counts less than the row of the skipped result."""
    known = rows.get(row["output"])
    if known is not None and row.get("ended", 0) < known.get("ended", 0):
        return
    if known is None or row["status"] != "skipped":
        rows[row["output"]] = row


_NO_MATTER = {"-q": 0, "--quiet": 0, "-v": 0, "--verbose": 0, "--threads": 1, "--time-limit": 1, "--memory-limit": 1,
              "--report": 1, "--html": 1}
"""Options that do not change the mesh, and the number of their values."""


def options_that_matter(arguments: typing.Sequence[str]) -> list[str]:
    """The options of `mesh` on which the mesh depends, with `--option=value` as two words."""
    words: list[str] = []
    for argument in arguments:
        words += argument.split("=", 1) if argument.startswith("--") else [argument]
    found: list[str] = []
    at = 0
    while at < len(words):
        if (values := _NO_MATTER.get(words[at])) is not None:
            at += 1 + values
            continue
        found.append(words[at])
        at += 1
    return found


def checksum_of(file: PathLike) -> Optional[str]:
    """CRC-32 of a file's bytes, eight hexadecimal digits; None if it cannot be read."""
    sum = 0
    try:
        with open(file, "rb") as bytes_of_file:
            while block := bytes_of_file.read(2**20):
                sum = zlib.crc32(block, sum)
    except OSError:
        return None
    return f"{sum:08x}"


def is_current(task: Task, known: Row) -> bool:
    """Whether an earlier run wrote what this run would write: from the same file, with the same options, as far as
    `known`, the row of that run, shows."""
    if not known:
        return True
    if known["status"] not in ("done", "skipped"):  # the files are from an earlier run
        return False
    if known.get("options") != options_that_matter(task.arguments):  # a row without it may belong to any
        return False
    return "checksum" not in known or known["checksum"] == checksum_of(task.file)


def is_complete(task: Task, earlier: dict[str, Row]) -> bool:
    """Files appear complete or not at all. The first of several files may exist without the others."""
    if not is_current(task, earlier.get(task.output, {})):
        return False
    endings = _FILES_OF_FORMAT.get(task.format)
    if endings is None:
        return os.path.exists(task.output)
    stem = task.output[: -len(task.format)]
    known = earlier.get(task.output, {}).get("status") in ("done", "skipped")
    return known and all(os.path.exists(stem + e) for e in endings[:2])
