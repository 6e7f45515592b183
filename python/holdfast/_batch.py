"""Many parts: one child process each, so that one failure costs one part."""

from __future__ import annotations

import concurrent.futures
import contextlib
import dataclasses
import fcntl
import importlib
import json
import os
import re
import shutil
import signal
import subprocess
import threading
import time
import typing
from dataclasses import dataclass
from pathlib import Path
from typing import Any, Optional, Union

from ._batch_records import Row, Task, checksum_of, is_complete, keep_better, options_that_matter, rows_of
from ._limits import MemoryAmount, bytes_of, weld_of
from ._program import program
from ._repair import most_sides

PathLike = Union[str, "os.PathLike[str]"]

STATUSES = ("done", "skipped", "invalid", "limit", "failed")
_BY_EXIT = {0: "done", 4: "invalid", 5: "limit"}


# Options of `mesh` that a batch sets, or whose files would be overwritten by the next part.
_OF_ONE_RUN = {
    "-o": "the folder of the batch is -o before it",
    "--format": "give it before --",
    "--report": "results.jsonl has a line for each part",
    **dict.fromkeys(("--html", "--exact", "--repaired"), "parts would overwrite each other's"),
}


class BatchError(ValueError):
    """A batch that cannot begin: two files with one stem, a file for all parts, or a shard that does not exist."""


@dataclass
class Batch:
    """The tasks of a batch, and what earlier runs recorded of them."""

    tasks: list[Task]
    results: Path
    shard: Optional[tuple[int, int]]
    earlier: dict[str, Row] = dataclasses.field(default_factory=dict)

    @property
    def results_of_shard(self) -> Path:
        return self.results if self.shard is None else _shard_file(self.results, *self.shard)


def stem_of(file: PathLike) -> str:
    """The name without its ending, compressed or not: "part" of "a/part.stl.gz"."""
    name = Path(file).name
    if name.lower().endswith(".gz"):
        name = name[:-3]
    return Path(name).stem


def shard_of_slurm(environment: Optional[dict[str, str]] = None) -> Optional[tuple[int, int]]:
    """(I, N) of a Slurm array's task, I from 0; None outside one."""
    env = dict(os.environ) if environment is None else environment
    if "SLURM_ARRAY_TASK_ID" not in env:
        return None
    task = int(env["SLURM_ARRAY_TASK_ID"])
    first = int(env.get("SLURM_ARRAY_TASK_MIN", 0))
    step = int(env.get("SLURM_ARRAY_TASK_STEP", 1)) or 1
    last = int(env.get("SLURM_ARRAY_TASK_MAX", task))
    count = int(env.get("SLURM_ARRAY_TASK_COUNT", (last - first) // step + 1))
    return _sensible_shard((task - first) // step, count)


def _sensible_shard(index: int, count: int) -> tuple[int, int]:
    if not 0 <= index < count:
        raise BatchError(f"shard {index}/{count}: I of I/N counts from 0 to N - 1")
    return index, count


def _shard_file(results: Path, index: int, count: int) -> Path:
    return results.with_name(f"{results.stem}.{index}-of-{count}{results.suffix}")


def plan(
    files: typing.Iterable[PathLike],
    output: PathLike,
    *,
    format: str = ".vtu",
    arguments: typing.Sequence[str] = (),
    time_limit: Optional[float] = None,
    memory_limit: Optional[MemoryAmount] = None,
    resume: bool = False,
    results: Optional[PathLike] = None,
    shard: Optional[tuple[int, int]] = None,
) -> Batch:
    """Tasks of a batch, or of its shard. Raises BatchError."""
    names = [os.fspath(f) for f in files]
    if not names:
        raise BatchError("there are no files")
    for argument in arguments:
        option = "-o" if re.match("-o|--output(=|$)", argument) else argument.partition("=")[0]
        if option in _OF_ONE_RUN:
            raise BatchError(f"{option} after -- names one file for all parts: {_OF_ONE_RUN[option]}")
    by_stem: dict[str, str] = {}
    for name in names:
        other = by_stem.setdefault(stem_of(name), name)
        if other is not name:
            raise BatchError(f"{other} and {name} would both be written as {stem_of(name)}; rename one, or use two folders")
    ending = "." + format.lstrip(".")
    for stem, name in by_stem.items():
        if ending == ".vtu" and stem + "_surface" in by_stem:
            raise BatchError(f"the triangles of {name} would be written over {by_stem[stem + '_surface']}'s volume; "
                             "rename one, or use two folders")
    limits = [] if time_limit is None else ["--time-limit", repr(float(time_limit))]
    memory = bytes_of(memory_limit)
    limits += [] if memory is None else ["--memory-limit", repr(memory / 1e9)]
    to_format = ["--format", "msh2"] if ending == ".msh2" else []
    suffix = ".msh" if ending == ".msh2" else ending
    folder = Path(output)
    tasks = [
        Task(name, str(folder / (stem_of(name) + suffix)), (*arguments, *limits, *to_format), time_limit, suffix)
        for name in names
    ]
    if shard is not None:
        index, count = _sensible_shard(*shard)
        tasks = tasks[index::count]
    batch = Batch(tasks, Path(results) if results is not None else folder / "results.jsonl", shard)
    if resume:
        for path in _all_results(batch.results):
            for row in rows_of(path):
                keep_better(batch.earlier, row)
    return batch


def _all_results(results: Path) -> list[Path]:
    return [results, *sorted(results.parent.glob(f"{results.stem}.*-of-*{results.suffix}"))]


def run_part(task: Task) -> Row:
    """Meshes one part in a child process, which dies with its parent, and reports the outcome."""
    started = time.monotonic()
    Path(task.output).parent.mkdir(parents=True, exist_ok=True)
    command = [program(), "mesh", task.file, "-o", task.output, "--report", "-", *task.arguments]
    if setpriv := shutil.which("setpriv"):
        command = [setpriv, "--pdeathsig", "KILL", "--", *command]
    row: Row = {"file": task.file, "output": task.output, "options": options_that_matter(task.arguments)}
    if (checksum := checksum_of(task.file)) is not None:
        row["checksum"] = checksum
    # A child beyond its limit is stuck in a system call, where its own limits have no effect.
    patience = None if task.time_limit is None else 2 * task.time_limit + 60
    child = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    _children.add(child)
    try:
        out, err = child.communicate(timeout=patience)
        exit_code = child.returncode
    except subprocess.TimeoutExpired:
        child.kill()
        out, err = child.communicate()
        exit_code = 5
    except BaseException:
        child.kill()
        child.wait()
        raise
    finally:
        _children.discard(child)
    message = err.decode("utf-8", "replace").strip()
    report = _report_of(out)
    row["status"] = _BY_EXIT.get(exit_code, "failed")
    row["exit"] = exit_code
    row["seconds"] = round(time.monotonic() - started, 3)
    row["ended"] = round(time.time(), 3)
    row["message"] = _told(exit_code, message)
    if report and row["status"] == "done":
        row["points"] = report["mesh"]["vertices"]
        row["tetrahedra"] = report["mesh"]["tetrahedra"]
        row["regions"] = report["mesh"]["regions"]
        row["steiner_points"] = report["steiner"]["count"]
        row["min_dihedral_deg"] = report["quality"]["min_dihedral_deg"]
        row["below_10_deg"] = report["quality"]["below_10_deg"]
    return row


_children: set["subprocess.Popen[bytes]"] = set()


def kill_children() -> None:
    """The child processes of this process that still run."""
    for child in list(_children):
        with contextlib.suppress(OSError):
            child.kill()


def _report_of(out: bytes) -> Optional[dict[str, Any]]:
    try:
        report = json.loads(out)
    except ValueError:
        return None
    return report if isinstance(report, dict) else None


def _told(exit_code: int, message: str) -> str:
    if exit_code < 0:
        with contextlib.suppress(ValueError):
            name = signal.Signals(-exit_code).name
            return f"killed by {name}" + (": " + message.splitlines()[-1] if message else "")
    lines = message.splitlines()
    if not lines:
        return ""
    # An error begins with the program's name and follows the remarks on the file; a success is the last line.
    if exit_code != 0:
        return next((line for line in reversed(lines) if line.startswith("holdfast: ")), lines[0])
    return lines[-1]


@contextlib.contextmanager
def _locked(folder: Path) -> typing.Iterator[None]:
    """Shards of one machine, or of a file system with locks, merge one after the other."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        with contextlib.suppress(OSError):
            fcntl.flock(handle, fcntl.LOCK_EX)
        yield
    finally:
        os.close(handle)


def merge(batch: Batch) -> None:
    """One results file with all records: of all shards, and of earlier runs if this run resumes them."""
    if batch.shard is None and not batch.earlier:
        return
    with _locked(batch.results.parent):
        rows = dict(batch.earlier)
        sources = [batch.results_of_shard]
        if batch.shard is not None:
            sources = [_shard_file(batch.results, i, batch.shard[1]) for i in range(batch.shard[1])]
        for source in sources:
            for row in rows_of(source):
                keep_better(rows, row)
        partial = batch.results.with_name(f".{batch.results.name}.{os.getpid()}")
        partial.write_text("".join(json.dumps(r) + "\n" for r in rows.values()), encoding="utf-8")
        os.replace(partial, batch.results)


def execute(
    batch: Batch,
    *,
    executor: Any = None,
    jobs: Optional[int] = None,
    resume: bool = False,
    tell: Optional[typing.Callable[[Row, int, int], None]] = None,
) -> list[Row]:
    """Runs the tasks and returns a row for each, in their order. Each row is written to the results file when it is ready."""
    batch.results.parent.mkdir(parents=True, exist_ok=True)
    rows: dict[str, Row] = {}
    lock = threading.Lock()
    with open(batch.results_of_shard, "a" if resume else "w", encoding="utf-8") as lines:

        def finish(row: Row) -> None:
            with lock:
                rows[row["output"]] = row
                lines.write(json.dumps(row) + "\n")
                lines.flush()
                if tell is not None:
                    tell(row, len(rows), len(batch.tasks))

        to_do: list[Task] = []
        for task in batch.tasks:
            if resume and is_complete(task, batch.earlier):
                finish(_skipped(task, batch.earlier))
            else:
                to_do.append(task)
        if executor is None:
            with concurrent.futures.ThreadPoolExecutor(jobs or os.cpu_count() or 1) as own:
                _run_on(own, to_do, finish)
        else:
            _run_on(executor, to_do, finish)
    merge(batch)
    return [rows[task.output] for task in batch.tasks]


def _skipped(task: Task, earlier: dict[str, Row]) -> Row:
    known = {k: v for k, v in earlier.get(task.output, {}).items() if k not in ("status", "message", "seconds", "exit")}
    return {"file": task.file, "output": task.output, **known, "status": "skipped", "exit": 0, "seconds": 0.0,
            "message": "complete already"}


def _run_on(executor: Any, tasks: typing.Sequence[Task], finish: typing.Callable[[Row], None]) -> None:
    is_dask = hasattr(executor, "scheduler_info")
    # The program differs between workers, so results of the same task must not come from a cache.
    options = {"pure": False} if is_dask else {}
    futures = {executor.submit(run_part, task, **options): task for task in tasks}
    try:
        for future in _as_completed(futures, is_dask):
            try:
                finish(future.result())
            except Exception as error:  # of the worker, not of the part
                finish(_lost(futures[future], error))
    except BaseException:
        for future in futures:
            future.cancel()
        kill_children()
        raise


def _as_completed(futures: typing.Iterable[Any], is_dask: bool) -> typing.Iterator[Any]:
    if not is_dask:
        return concurrent.futures.as_completed(list(futures))
    return iter(importlib.import_module("distributed").as_completed(list(futures)))


def _lost(task: Task, error: Exception) -> Row:
    return {"file": task.file, "output": task.output, "status": "failed", "exit": 1, "seconds": 0.0,
            "ended": round(time.time(), 3), "message": f"the worker was lost: {type(error).__name__}: {error}"}


_FLAGS = {"fill": "--fill", "drop_outside": "--drop-outside", "surface_of": "--surface-of", "union": "--union"}
_VALUES = {"size": "--size", "gradation": "--gradation", "quality": "--quality", "seed": "--seed", "threads": "--threads",
           "size_field": "--size-field", "max_ratio": "--max-ratio", "layers": "--layers", "order": "--order"}


def _number(value: Any) -> str:
    """The value as the program reads it: the id of a region is an integer, also in a row of an array."""
    return str(int(value)) if isinstance(value, float) and value.is_integer() and abs(value) < 2**53 else str(value)


def arguments_of(options: dict[str, Any]) -> list[str]:
    """Options of `mesh` as the program takes them. Raises TypeError for those that files cannot have."""
    found: list[str] = []
    left = dict(options)
    for name, flag in _FLAGS.items():
        if left.pop(name, False):
            found.append(flag)
    if not left.pop("growth", True):
        found.append("--no-growth")
    for name, option in _VALUES.items():
        if (value := left.pop(name, None)) is not None:
            if callable(value) or (hasattr(value, "__len__") and not isinstance(value, str)):
                raise TypeError(f"batch: {name} must be a number or a path, as it holds for every file")
            found += [option, str(value)]
    keep, margin = left.pop("keep", None), left.pop("box_margin", None)
    if margin is not None and keep != "box":
        raise ValueError('batch: box_margin does nothing without keep="box"')
    if keep is not None:
        found += ["--keep", str(keep) if margin is None else f"{keep}={margin}"]
    for name, option in (("holes", "--hole"), ("regions", "--region")):
        for values in left.pop(name, ()):
            found += [option, ",".join(_number(v) for v in values)]
    bounds = left.pop("max_volume", None)
    for region, volume in bounds.items() if isinstance(bounds, typing.Mapping) else [(None, bounds)]:
        if volume is not None:
            found += ["--max-volume", str(volume) if region is None else f"{region}={volume}"]
    if (weld := weld_of(left.pop("repair", False))) is not None:
        found.append(f"--repair={weld!r}" if weld > 0 else "--repair")
    fill_holes = left.pop("fill_holes", False)
    if sides := most_sides(fill_holes):
        found += ["--fill-holes"] if fill_holes is True else ["--fill-holes", str(sides)]
    without = left.pop("without", ())
    for step in [without] if isinstance(without, str) else without:
        found += ["--without", step]
    if left:
        raise TypeError(f"batch: there is no option {', '.join(sorted(left))}")
    return found


def batch(
    files: typing.Iterable[PathLike],
    output: PathLike,
    *,
    executor: Any = None,
    jobs: Optional[int] = None,
    format: str = ".vtu",
    time_limit: Optional[float] = None,
    memory_limit: Optional[MemoryAmount] = None,
    resume: bool = False,
    results: Optional[PathLike] = None,
    shard: Optional[tuple[int, int]] = None,
    progress: Optional[typing.Callable[[Row, int, int], None]] = None,
    **options: Any,
) -> list[Row]:
    """Meshes many files, each in a process of its own, into `output`/STEM.vtu.

    Parameters
    ----------
    files
        Surface files with distinct stems.
    executor
        A `concurrent.futures` executor or a Dask client, whose workers see the same files; None: `jobs` threads in this process.
    jobs
        The number of parts at a time without an executor; None: one per processor.
    time_limit, memory_limit
        For each part, as in `mesh`.
    resume
        Skips parts with complete output from the same file and the same options, and merges the results of earlier
        runs and shards. Results without options count as having the same ones.
    results
        File with one JSON line per part (default `output`/results.jsonl; shard I of N writes results.I-of-N.jsonl and merges
        those that exist).
    shard
        (I, N): only every N-th file from the I-th on, from 0.
    progress
        Called with (row, number finished, number of all).
    options
        Options of `mesh`: fill, size (a number or, as `size_field`, a path), gradation, growth, max_volume, max_ratio,
        layers, quality, keep, box_margin, holes, regions, drop_outside, repair, fill_holes, union, without, order, seed and
        threads; and surface_of=True for files of volumes.

    Returns
    -------
    One dict per file: "file", "output", "status" ("done", "skipped", "invalid", "limit" or "failed"), "exit", "seconds",
    "message", "ended" (seconds since 1970), "options" (those on which the mesh depends), "checksum" (of the file), and for
    done parts "points", "tetrahedra", "regions", "steiner_points", "min_dihedral_deg", "below_10_deg".

    Raises
    ------
    ValueError
        For equal stems, and for a shard that does not exist.
    TypeError
        For options of `mesh` that are not among these.

    Example
    -------
    >>> import holdfast
    >>> rows = holdfast.batch(["a.stl", "b.stl"], "meshes", time_limit=60)  # doctest: +SKIP
    """
    planned = plan(files, output, format=format, arguments=arguments_of(options), time_limit=time_limit,
                   memory_limit=memory_limit, resume=resume, results=results, shard=shard)
    return execute(planned, executor=executor, jobs=jobs, resume=resume, tell=progress)
