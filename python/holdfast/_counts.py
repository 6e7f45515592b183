"""Counts in messages: "1 point", "2 points"."""

from __future__ import annotations


def counted(count: int, one: str, many: str = "") -> str:
    """
    >>> counted(1, "point"), counted(0, "vertex", "vertices")
    ('1 point', '0 vertices')
    """
    return f"{count} {one if count == 1 else many or one + 's'}"
