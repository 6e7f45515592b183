"""`python3 -m holdfast` and the script `holdfast`: the program, and `batch`."""

from __future__ import annotations

import sys
import typing
from typing import Optional


def main(arguments: Optional[typing.Sequence[str]] = None) -> int:
    given = list(sys.argv[1:] if arguments is None else arguments)
    if given[:1] == ["batch"]:
        from ._batch_cli import main as batch_main

        return batch_main(given[1:])
    from ._program import run

    run(given)


if __name__ == "__main__":
    sys.exit(main())
