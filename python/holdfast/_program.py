"""The program `holdfast` that comes with the package."""

from __future__ import annotations

import os
import shutil
import sys
import typing
from pathlib import Path
from typing import NoReturn


def program() -> str:
    """Its path: HOLDFAST_PROGRAM, the package's own, or the one on PATH. Raises FileNotFoundError."""
    if named := os.environ.get("HOLDFAST_PROGRAM"):
        return named
    own = Path(__file__).parent / "bin" / "holdfast"
    if own.is_file():
        return str(own)
    found = shutil.which("holdfast")
    if found is None:
        raise FileNotFoundError("the program holdfast is neither in the package nor on PATH; HOLDFAST_PROGRAM may name it")
    return found


def run(arguments: typing.Sequence[str]) -> NoReturn:
    """Replaces this process by the program."""
    sys.stdout.flush()
    sys.stderr.flush()
    path = program()
    os.execv(path, [path, *arguments])
