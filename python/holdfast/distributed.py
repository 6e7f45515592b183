"""One surface on many machines: `holdfast split`, one task per part on an executor or a Dask client, and `holdfast join`.

>>> import holdfast.distributed
>>> holdfast.distributed.mesh("part.stl", "part.vtu", parts=8, size=0.5)  # doctest: +SKIP
"""

from __future__ import annotations

import concurrent.futures
import contextlib
import json
import os
import statistics
import subprocess
import time
import typing
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Optional

from . import _core
from ._batch import PathLike, arguments_of, kill_children, run_part
from ._batch_records import Row, Task
from ._limits import MemoryAmount, bytes_of
from ._program import program
from .errors import (
    Cancelled,
    FileError,
    HoldfastError,
    InternalError,
    InvalidSurface,
    MemoryLimit,
    NotRepresentable,
    TimeLimit,
)

# A part that takes this many times the median of the others, and at least this long, is run again elsewhere.
STRAGGLES_BEYOND = 3.0
STRAGGLES_AFTER_SECONDS = 10.0
_POLL_SECONDS = 0.2

Progress = typing.Callable[[Row, int, int], None]


@dataclass(frozen=True)
class Division:
    """A surface in parts, in a folder that all workers see."""

    folder: Path
    manifest: dict[str, Any]

    @property
    def parts(self) -> list[dict[str, Any]]:
        return list(self.manifest["parts"])

    def surface(self, part: dict[str, Any]) -> Path:
        return self.folder / str(part["surface"])

    def volume(self, part: dict[str, Any]) -> Path:
        return self.folder / str(part["volume"])


def read(folder: PathLike) -> Division:
    """The division in a folder. Raises FileNotFoundError if there is none, ValueError for a manifest of another kind, or
    a damaged one."""
    path = Path(folder) / "manifest.json"
    try:
        manifest = json.loads(path.read_text(encoding="utf-8"))
    except ValueError as error:
        raise ValueError(f"{path}: {error}") from None
    if not isinstance(manifest, dict) or manifest.get("format") != "holdfast division":
        raise ValueError(f"{path} is not one of `holdfast split`")
    parts = manifest.get("parts")
    if not isinstance(parts, list) or not all(_is_part(part) for part in parts):
        raise ValueError(f'{path}: "parts" is missing or damaged; `holdfast split` writes the manifest anew')
    return Division(Path(folder), manifest)


def _is_part(part: Any) -> bool:
    return isinstance(part, dict) and all(isinstance(part.get(key), str) for key in ("surface", "volume"))


def _paths(surface: Any) -> list[PathLike]:
    if isinstance(surface, (str, os.PathLike)):
        return [surface]
    if not isinstance(surface, (list, tuple)) or not all(isinstance(file, (str, os.PathLike)) for file in surface):
        raise TypeError("a path is expected, or a list of paths, as the program reads the surface from files; "
                        f"not {type(surface).__name__}")
    return list(surface)


def split(
    surface: typing.Union[PathLike, typing.Sequence[PathLike]],
    folder: PathLike,
    *,
    parts: int,
    **options: Any,
) -> Division:
    """Cuts a surface into closed parts of about equal work (`holdfast split`).

    Parameters
    ----------
    surface
        A path, or several.
    folder
        Gets the parts and manifest.json; volumes of an earlier division there are removed.
    parts
        The number of parts.
    options
        Options of `mesh` that `holdfast split` has: size, keep, holes, regions, drop_outside, seed, threads, time_limit,
        memory_limit.

    Raises
    ------
    InvalidSurface, HoldfastError
        As `holdfast.mesh`.
    """
    files = _paths(surface)
    earlier: list[Path] = []
    with contextlib.suppress(FileNotFoundError, ValueError):
        there = read(folder)
        earlier = [there.volume(part) for part in there.parts]
    _run("split", *(os.fspath(f) for f in files), "--parts", str(parts), "-o", os.fspath(folder), "-q", *_with_limits(options))
    for volume in earlier:
        volume.unlink(missing_ok=True)
    return read(folder)


def mesh_parts(
    division: typing.Union[Division, PathLike],
    *,
    client: Any = None,
    jobs: Optional[int] = None,
    threads: int = 1,
    time_limit: Optional[float] = None,
    memory_limit: Optional[MemoryAmount] = None,
    progress: Optional[Progress] = None,
) -> list[Row]:
    """Meshes the parts that have no volume yet, or one that is older than the part, each in its own process.

    A part whose worker is lost runs again on another. One that takes much longer than the others runs a second time if
    a worker is free, and the first result counts: both are the same, bit for bit, and appear complete or not at all.

    Parameters
    ----------
    division
        What `split` returned, or its folder.
    client
        A Dask client or a `concurrent.futures` executor, whose workers see the folder; None: `jobs` threads here.
    threads, time_limit, memory_limit
        For each part.
    progress
        Called with (row, number finished, number of all).

    Returns
    -------
    One dict per part, in order, as in `holdfast.batch`.
    """
    if not isinstance(division, Division):
        division = read(division)
    limits = [] if time_limit is None else ["--time-limit", repr(float(time_limit))]
    memory = bytes_of(memory_limit)
    limits += [] if memory is None else ["--memory-limit", repr(memory / 1e9)]
    arguments = ("--threads", str(threads), *limits)
    # Workers may have another working folder.
    tasks = [Task(os.path.abspath(division.surface(p)), os.path.abspath(division.volume(p)), arguments, time_limit,
                  division.volume(p).suffix) for p in division.parts]
    rows: dict[str, Row] = {}

    def finish(row: Row) -> None:
        if row["output"] in rows and rows[row["output"]]["status"] in ("done", "skipped"):
            return
        rows[row["output"]] = row
        if progress is not None:
            progress(row, len(rows), len(tasks))

    to_do = []
    for task in tasks:
        if _is_newer(task.output, task.file):
            finish({"file": task.file, "output": task.output, "status": "skipped", "exit": 0, "seconds": 0.0,
                    "message": "complete already"})
        else:
            to_do.append(task)
    if client is None:
        with concurrent.futures.ThreadPoolExecutor(jobs or os.cpu_count() or 1) as own:
            _Race(own, finish).run(to_do)
    else:
        _Race(client, finish).run(to_do)
    return [rows[task.output] for task in tasks]


def _is_newer(volume: str, surface: str) -> bool:
    """A folder that was split again may still have volumes of the parts before."""
    with contextlib.suppress(FileNotFoundError):
        return os.stat(volume).st_mtime_ns >= os.stat(surface).st_mtime_ns
    return False


class _Race:
    """Runs tasks on an executor, and runs stragglers a second time."""

    def __init__(self, executor: Any, finish: typing.Callable[[Row], None]) -> None:
        self._executor = executor
        self._finish = finish
        self._is_dask = hasattr(executor, "scheduler_info")
        self._started: dict[Any, float] = {}
        self._task_of: dict[Any, Task] = {}
        self._took: list[float] = []

    def run(self, tasks: typing.Sequence[Task]) -> None:
        for task in tasks:
            self._submit(task)
        left = {task.output: task for task in tasks}
        doubled: set[str] = set()
        try:
            while left:
                for future in [f for f in self._task_of if f.done()]:
                    self._end(future, left)
                for task in self._stragglers(left, doubled):
                    doubled.add(task.output)
                    self._submit(task)
                if left:
                    time.sleep(_POLL_SECONDS)
        except BaseException:
            self._cancel()
            raise
        self._cancel()

    def _submit(self, task: Task) -> None:
        # The same task a second time must not count as the first.
        options = {"pure": False} if self._is_dask else {}
        future = self._executor.submit(run_part, task, **options)
        self._task_of[future] = task
        self._started[future] = time.monotonic()

    def _end(self, future: Any, left: dict[str, Task]) -> None:
        task = self._task_of.pop(future)
        if task.output not in left:
            return
        try:
            row = future.result()
        except Exception as error:  # of the worker, not of the part
            row = {"file": task.file, "output": task.output, "status": "failed", "exit": 1, "seconds": 0.0,
                   "message": f"the worker was lost: {type(error).__name__}: {error}"}
        others = any(t.output == task.output for t in self._task_of.values())
        if row["status"] != "done" and others:
            return
        del left[task.output]
        self._took.append(row["seconds"])
        self._finish(row)

    def _stragglers(self, left: dict[str, Task], doubled: set[str]) -> list[Task]:
        """Only when no task waits: a second run must not delay a first run."""
        if not self._took or len(left) > self._room():
            return []
        late = max(STRAGGLES_AFTER_SECONDS, STRAGGLES_BEYOND * statistics.median(self._took))
        now = time.monotonic()
        return [task for future, task in list(self._task_of.items())
                if task.output in left and task.output not in doubled and now - self._started[future] > late]

    def _room(self) -> int:
        """Half of the workers, when the other half is idle."""
        if self._is_dask:
            return int(sum(w["nthreads"] for w in self._executor.scheduler_info().get("workers", {}).values())) // 2
        return int(getattr(self._executor, "_max_workers", 0)) // 2

    def _cancel(self) -> None:
        for future in self._task_of:
            future.cancel()
        if self._task_of and not self._is_dask:
            kill_children()
        self._task_of.clear()


def join(folder: PathLike, output: PathLike) -> Path:
    """Joins the volumes of a division (`holdfast join`). Raises HoldfastError."""
    _run("join", os.fspath(folder), "-o", os.fspath(output), "-q")
    return Path(output)


def check(folder: PathLike) -> bool:
    """Whether the volumes are a mesh of the surface that was split (`holdfast check DIR`)."""
    ended = subprocess.run([program(), "check", os.fspath(folder), "-q"], stdin=subprocess.DEVNULL, capture_output=True)
    if ended.returncode not in (0, 6):
        raise _error_of(ended.returncode, ended.stderr)
    return ended.returncode == 0


def mesh(
    surface: typing.Union[PathLike, typing.Sequence[PathLike]],
    output: Optional[PathLike] = None,
    *,
    parts: int,
    folder: Optional[PathLike] = None,
    client: Any = None,
    jobs: Optional[int] = None,
    threads: int = 1,
    time_limit: Optional[float] = None,
    memory_limit: Optional[MemoryAmount] = None,
    progress: Optional[Progress] = None,
    **options: Any,
) -> Division:
    """Meshes a surface in parts, on the workers of `client`.

    Parameters
    ----------
    surface
        A path, or several.
    output
        Gets the joined volume; None: the parts are not joined.
    parts
        The number of parts; more than workers, so that a lost worker costs little.
    folder
        For the parts (default: `output` without its ending, with ".parts"). Finished parts of the same call are kept.
    client
        A Dask client or a `concurrent.futures` executor, whose workers see `folder`; None: `jobs` threads here.
    threads, time_limit, memory_limit
        For each part.
    options
        Options of `split`.

    Raises
    ------
    HoldfastError
        If a part failed; the others stay, and the same call continues with it.
    """
    if folder is None:
        if output is None:
            raise ValueError("distributed.mesh: an output or a folder is needed")
        folder = Path(output).with_suffix(".parts")
    if output is not None:
        _require_format(output)
    division = _division_of(surface, folder, parts, options)
    rows = mesh_parts(division, client=client, jobs=jobs, threads=threads, time_limit=time_limit,
                      memory_limit=memory_limit, progress=progress)
    failed = [row for row in rows if row["status"] not in ("done", "skipped")]
    if failed:
        raise HoldfastError(f"{len(failed)} of {len(rows)} parts were not done; the first: {failed[0]['file']}: "
                            f"{failed[0]['message']}")
    if output is not None:
        join(folder, output)
    return division


def _require_format(output: PathLike) -> None:
    """`join` would refuse the output, but only once all parts are done."""
    ending = Path(output).suffix.lower()
    formats = [*_core.volume_formats(), ".pvtu"]
    if ending not in formats:
        raise ValueError(f"{os.fspath(output)}: the format {ending!r} cannot be written; the formats are {', '.join(formats)}")


def _division_of(surface: Any, folder: PathLike, parts: int, options: dict[str, Any]) -> Division:
    """The existing division, if it comes from the same call and no input is newer."""
    files = _paths(surface)
    call = {"inputs": [os.path.abspath(f) for f in files], "parts": parts, "options": _with_limits(options)}
    record = Path(folder) / "call.json"
    with contextlib.suppress(OSError, ValueError):
        division = read(folder)
        written = record.stat().st_mtime
        if json.loads(record.read_text(encoding="utf-8")) == call and all(os.stat(f).st_mtime <= written for f in files):
            return division
    division = split(files, folder, parts=parts, **options)
    record.write_text(json.dumps(call), encoding="utf-8")
    return division


_SPLIT_OPTIONS = ("size", "keep", "holes", "regions", "drop_outside", "seed", "threads")


def _with_limits(options: dict[str, Any]) -> list[str]:
    left = dict(options)
    limits = []
    if (seconds := left.pop("time_limit", None)) is not None:
        limits += ["--time-limit", repr(float(seconds))]
    if (memory := bytes_of(left.pop("memory_limit", None))) is not None:
        limits += ["--memory-limit", repr(memory / 1e9)]
    if unknown := sorted(set(left) - set(_SPLIT_OPTIONS)):
        raise TypeError(f"split: there is no option {', '.join(unknown)}")
    return arguments_of(left) + limits


_ERRORS: dict[int, type[HoldfastError]] = {1: InternalError, 3: FileError, 4: InvalidSurface, 7: NotRepresentable}


def _error_of(code: int, stderr: bytes) -> Exception:
    message = stderr.decode("utf-8", "replace").strip() or f"the program ended with {code}"
    if code == 2:
        return ValueError(message)
    if code == 5:
        kinds: dict[str, type[HoldfastError]] = {"time": TimeLimit, "memory": MemoryLimit}
        return next((kind for word, kind in kinds.items() if word in message), Cancelled)(message)
    return _ERRORS.get(code, HoldfastError)(message)


def _run(*arguments: str) -> None:
    ended = subprocess.run([program(), *arguments], stdin=subprocess.DEVNULL, capture_output=True)
    if ended.returncode != 0:
        raise _error_of(ended.returncode, ended.stderr)
