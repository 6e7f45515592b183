"""Measurements are kept, row by row, in <build>/bench/<part>.json, so that a run continues where the last one ended.

A part of the benchmark requests its rows by names that contain everything on which a row depends, except the programs.
These are the file's key, and rows of other programs are dropped. Text and figures are computed from the rows each time.
"""
import hashlib
import json


class NotMeasured(Exception):
    """A row is missing that may not be measured now."""


def digest(path):
    """Block by block: what this process once held would count as memory of the programs that it starts (process.py)."""
    with open(path, "rb") as file:
        return hashlib.file_digest(file, "sha256").hexdigest()[:16]


class Rows:
    def __init__(self, path, key, measuring, again=False):
        self.path, self.key, self.measuring = path, key, measuring
        kept = json.loads(path.read_text(encoding="utf-8")) if path.exists() else {}
        self.rows = kept["rows"] if kept.get("key") == key and not again else {}

    def get(self, name, measure, *arguments):
        """The row of that name: plain JSON, from `measure(*arguments)` if it is not kept."""
        if name not in self.rows:
            if not self.measuring:
                raise NotMeasured(name)
            print(f"{self.path.stem}: {name}", flush=True)
            self.rows[name] = measure(*arguments)
            self.save()
        return self.rows[name]

    def save(self):
        """Under its name the file is always complete."""
        self.path.parent.mkdir(parents=True, exist_ok=True)
        new = self.path.with_suffix(".new")
        new.write_text(json.dumps({"key": self.key, "rows": self.rows}, indent=1), encoding="utf-8")
        new.replace(self.path)
