"""`holdfast batch`: the command."""

from __future__ import annotations

import argparse
import signal
import sys
import typing
from typing import Any, Optional

from ._batch import STATUSES, BatchError, execute, kill_children, plan, shard_of_slurm
from ._batch_records import Row

_USAGE, _INTERRUPTED = 2, 5


def _shard(text: str) -> tuple[int, int]:
    index, slash, count = text.partition("/")
    if not slash or not index.isdigit() or not count.isdigit():
        raise argparse.ArgumentTypeError(f"{text}: I/N is expected, I from 0")
    return int(index), int(count)


def _positive(text: str) -> float:
    value = float(text)
    if not 0 < value < float("inf"):
        raise argparse.ArgumentTypeError(f"{text}: a positive number is expected")
    return value


def _jobs(text: str) -> int:
    value = int(text)
    if value < 0:
        raise argparse.ArgumentTypeError(f"{text}: 0 (all processors) or more")
    return value


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="holdfast batch",
        description="Mesh many surfaces, each in its own process, so that one failure costs one part.",
        epilog="What follows `--` goes to `holdfast mesh` as it is, for every part: holdfast batch *.stl -o out -- --fill. "
        "Exit codes: 0 all are done; 1 some are not; 2 wrong usage; 5 interrupted.",
        allow_abbrev=False,
    )
    parser.add_argument("files", nargs="+", metavar="FILE", help="surface files with distinct stems")
    parser.add_argument("-o", "--output", required=True, metavar="DIR", help="folder for STEM.vtu of each")
    parser.add_argument("--format", default=".vtu", help="volume format: vtu (default), vtk, mesh, meshb, msh, msh2, node")
    parser.add_argument("--jobs", type=_jobs, default=0, metavar="N", help="parts at a time (default 0: as many as processors)")
    parser.add_argument("--time-limit", type=_positive, metavar="S", help="seconds for each part")
    parser.add_argument("--memory-limit", type=_positive, metavar="GB", help="gigabytes for each part")
    parser.add_argument("--resume", action="store_true",
                        help="leave out parts whose output is complete, of the same file and by the same options, and merge the results of "
                        "earlier runs and shards")
    parser.add_argument("--results", metavar="FILE.jsonl", help="a JSON line a part (default DIR/results.jsonl)")
    parser.add_argument("--shard", type=_shard, metavar="I/N",
                        help="only every N-th file from the I-th on, from 0 (default: of a Slurm array's task)")
    parser.add_argument("-q", "--quiet", action="store_true", help="neither progress nor table")
    return parser


def _split(arguments: typing.Sequence[str]) -> tuple[list[str], list[str]]:
    given = list(arguments)
    if "--" not in given:
        return given, []
    at = given.index("--")
    return given[:at], given[at + 1 :]


def _tell(row: Row, finished: int, count: int) -> None:
    width = len(str(count))
    what = f"{row['tetrahedra']} tetrahedra" if "tetrahedra" in row and row["status"] == "done" else row["message"]
    print(f"[{finished:{width}}/{count}] {row['status']:<7} {row['file']}: {what}", file=sys.stderr, flush=True)


def _table(rows: typing.Sequence[Row]) -> str:
    """Parts, then how many of each status."""
    cells = [("file", "status", "seconds", "tetrahedra", "least angle", "message")]
    for row in rows:
        angle = row.get("min_dihedral_deg")
        bad = row["status"] in ("invalid", "limit", "failed")
        cells.append((row["file"], row["status"], f"{row['seconds']:.2f}", str(row.get("tetrahedra", "")),
                      "" if angle is None else f"{angle:.3g}", row["message"][:100] if bad else ""))
    widths = [max(len(line[i]) for line in cells) for i in range(5)]
    right = (False, False, True, True, True)
    lines = []
    for line in cells:
        padded = [c.rjust(w) if r else c.ljust(w) for c, w, r in zip(line, widths, right)]
        lines.append("  ".join([*padded, line[5]]).rstrip())
    counts = {s: sum(row["status"] == s for row in rows) for s in STATUSES}
    told = ", ".join(f"{n} {s}" for s, n in counts.items() if n or s == "done")
    lines.append(f"{len(rows)} part{'' if len(rows) == 1 else 's'}: {told}")
    return "\n".join(lines)


class _Terminated(BaseException):
    pass


def _on_terminate(*_: Any) -> None:
    raise _Terminated


def main(arguments: Optional[typing.Sequence[str]] = None) -> int:
    own, for_mesh = _split(sys.argv[1:] if arguments is None else arguments)
    given = _parser().parse_args(own)
    signal.signal(signal.SIGTERM, _on_terminate)
    try:
        shard = given.shard if given.shard is not None else shard_of_slurm()
        batch = plan(given.files, given.output, format=given.format, arguments=for_mesh, time_limit=given.time_limit,
                     memory_limit=given.memory_limit, resume=given.resume, results=given.results, shard=shard)
    except BatchError as error:
        print(f"holdfast batch: {error}", file=sys.stderr)
        return _USAGE
    try:
        rows = execute(batch, jobs=given.jobs or None, resume=given.resume, tell=None if given.quiet else _tell)
    except (KeyboardInterrupt, _Terminated):
        kill_children()
        print("holdfast batch: interrupted; --resume goes on where this stopped", file=sys.stderr)
        return _INTERRUPTED
    except OSError as error:
        print(f"holdfast batch: {error}", file=sys.stderr)
        return 3
    if not given.quiet:
        print(_table(rows))
    return 0 if all(row["status"] in ("done", "skipped") for row in rows) else 1


if __name__ == "__main__":
    sys.exit(main())
