"""Surfaces of the corpus to measure with."""
import sys
from pathlib import Path
from typing import NamedTuple

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "scripts"))
import corpus  # noqa: E402  (finds the surfaces)

ABSENT = ["No corpus of surfaces: not measured.", ""]


class Surface(NamedTuple):
    path: Path
    triangles: int

    @property
    def name(self):
        return self.path.stem

    @property
    def generated(self):
        """Generated, not a real part."""
        return self.name.startswith("gen_")


def closed_surfaces(folder):
    """Those that are valid, each segment with two facets or more; by size."""
    if not (folder / "valid").is_dir():
        sys.exit(f"{folder}/valid: no such folder of surfaces")
    manifest = corpus.manifest_of(folder)
    told = [(path, *corpus.describe(path, manifest.get(path.stem))) for path in (folder / "valid").glob("*.off")]
    return sorted((Surface(path, triangles) for path, triangles, group in told if group == "closed"),
                  key=lambda s: (s.triangles, s.name))


def evenly(surfaces, count):
    """About `count` of them, over all sizes."""
    return surfaces[:: max(1, len(surfaces) // count)]


def largest(folder):
    return max((p for p in folder.rglob("*.off") if p.parent.name != "invalid"), key=lambda p: p.stat().st_size)
