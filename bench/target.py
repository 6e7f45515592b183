"""A target, what was measured, and whether it is met; as lines of a table."""
from typing import NamedTuple


class Target(NamedTuple):
    text: str
    measured: str
    met: bool | None  # None: not measured, or no target

    @property
    def line(self):
        return f"| {self.text} | {self.measured} | {'-' if self.met is None else 'yes' if self.met else '**no**'} |"


def missing(*texts):
    return [Target(text, "not measured", None) for text in texts]


def table(targets):
    return ["| target | measured | met |", "|---|---|---|", *(t.line for t in targets)]
