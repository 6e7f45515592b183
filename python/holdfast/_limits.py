"""Limits and progress of calls."""

from __future__ import annotations

import importlib
import numbers
import operator
import re
import sys
import typing
from typing import Any, Optional, Union

import numpy as np

from ._core import CancelToken as CancelToken
from ._core import now

ProgressCallback = typing.Callable[[str, float], Any]
Progress = Union[None, bool, ProgressCallback]
MemoryAmount = Union[float, str]

_UNITS = {"": 1e9, "B": 1.0, "KB": 1e3, "MB": 1e6, "GB": 1e9, "TB": 1e12, "KIB": 2.0**10, "MIB": 2.0**20, "GIB": 2.0**30,
          "TIB": 2.0**40}


def bytes_of(amount: Optional[MemoryAmount]) -> Optional[int]:
    """An amount of memory in bytes, given as text with a unit ("500 MB", "2 GiB") or as a number. Numbers below a
    million are gigabytes, others are bytes: no machine has a million gigabytes, and no process fits into a million
    bytes."""
    if amount is None:
        return None
    found = re.fullmatch(r"\s*([0-9.eE+]+)\s*([A-Za-z]*)\s*", str(amount))
    factor = _UNITS.get(found.group(2).upper()) if found else None
    if found is None or factor is None:
        raise ValueError(f"memory_limit={amount!r}: gigabytes, bytes, or text such as '500 MB', is expected")
    number = float(found.group(1))
    size = number if not found.group(2) and number >= 1e6 else number * factor
    if not 0 < size < 2.0**63:
        raise ValueError(f"memory_limit={amount!r}: a positive amount that a machine can have is expected, in gigabytes")
    return int(size)


def limits(
    time_limit: Optional[float], memory_limit: Optional[MemoryAmount], cancel: Optional[CancelToken]
) -> dict[str, Any]:
    if time_limit is not None and (is_truth(time_limit) or not isinstance(time_limit, numbers.Real)):
        raise TypeError(f"time_limit={time_limit!r}: a number of seconds is expected; None is no limit")
    if time_limit is not None and not 0 < time_limit < float("inf"):
        raise ValueError(f"time_limit={time_limit!r}: a positive number of seconds is expected; None is no limit")
    if cancel is not None and not isinstance(cancel, CancelToken):
        raise TypeError(f"cancel={cancel!r}: a CancelToken is expected")
    return {"time_limit": time_limit, "memory_limit": bytes_of(memory_limit), "cancel": cancel, "started": now()}


def is_truth(value: Any) -> bool:
    """Python counts True and False as 1 and 0, but they are not meant as numbers."""
    return isinstance(value, (bool, np.bool_))


def whole(value: Any, what: str) -> int:
    """An integer of Python or NumPy; numbers that would have to be rounded are refused."""
    try:
        if not is_truth(value):
            return operator.index(value)
    except TypeError:
        pass
    raise TypeError(f"{what}={value!r}: an integer is expected")


def threads_of(threads: Any) -> int:
    count = whole(threads, "threads")
    if not 0 <= count <= 4096:
        raise ValueError(f"threads={count}: 0 (all there are) to 4096 are expected")
    return count


def length(value: Any, what: str) -> float:
    """A finite length that is not negative."""
    if is_truth(value):
        raise TypeError(f"{what}={value!r}: a length is expected, in the surface's unit")
    try:
        number = float(value)
    except OverflowError:
        number = float("inf")
    except (TypeError, ValueError):
        raise TypeError(f"{what}={value!r}: a length is expected, in the surface's unit") from None
    if not 0 <= number < float("inf"):
        raise ValueError(f"{what}={number}: the length must be finite and not negative")
    return number


def weld_of(repair: Any) -> Optional[float]:
    """The distance within which `repair`, a truth value or a length, joins points; None for no repair."""
    if is_truth(repair):
        return 0.0 if repair else None
    return length(repair, "repair")


class _Bar:
    """A bar on standard error: tqdm's if it is installed, otherwise a plain line."""

    def __init__(self, what: str) -> None:
        self.done = 0.0
        self.bar: Any = None
        self.what = what
        try:
            self.bar = importlib.import_module("tqdm.auto").tqdm(total=100, desc=what, unit="%", leave=False,
                            bar_format="{desc}: {percentage:3.0f}%|{bar}| {elapsed}<{remaining}")
        except ImportError:
            pass

    def __call__(self, stage: str, fraction: float) -> None:
        percent = 100 * fraction
        if self.bar is not None:
            self.bar.set_description(f"{self.what} {stage}", refresh=False)
            self.bar.update(max(0.0, percent - self.done))
        elif int(percent) > int(self.done):
            sys.stderr.write(f"\r{self.what}: {int(percent):3d} % {stage:<12}")
            sys.stderr.flush()
        self.done = max(self.done, percent)

    def close(self) -> None:
        if self.bar is not None:
            self.bar.close()
        elif self.done > 0:
            sys.stderr.write("\r" + 60 * " " + "\r")
            sys.stderr.flush()


class Shown:
    """A context that returns the callback for the extension: None, the user's, or a bar for True."""

    def __init__(self, progress: Progress, what: str) -> None:
        if progress is not None and not isinstance(progress, bool) and not callable(progress):
            raise TypeError("progress must be True, or a function that takes (stage, fraction)")
        self.progress = progress
        self.what = what
        self.bar: Optional[_Bar] = None

    def __enter__(self) -> Optional[ProgressCallback]:
        if self.progress is True:
            self.bar = _Bar(self.what)
            return self.bar
        return self.progress if callable(self.progress) else None

    def __exit__(self, *_: object) -> None:
        if self.bar is not None:
            self.bar.close()
