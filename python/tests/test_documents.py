"""What the README shows runs."""

from __future__ import annotations

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

ROOT = Path(__file__).resolve().parents[2]


def test_readme(tmp_path, monkeypatch):
    (code,) = re.findall(r"```python\n(.*?)```", (ROOT / "README.md").read_text(), re.S)
    subprocess.run([sys.executable, ROOT / "examples/make_part.py", tmp_path / "part.stl"], check=True)
    monkeypatch.chdir(tmp_path)
    names = {}
    exec(compile(code, "README.md", "exec"), names)
    u, free = names["u"], names["free"]
    assert u.min() == pytest.approx(20) and u.max() == pytest.approx(100) and 30 < u[free].mean() < 90
    # Nothing flows in or out but at the top and the bottom.
    assert np.abs(names["stiffness"] @ u)[free].max() < 1e-6


def test_every_name_in_the_page_exists():
    import holdfast

    text = (ROOT / "docs/python.md").read_text()
    for name in set(re.findall(r"holdfast\.(\w+)\(", text)) - {"sh"}:
        assert hasattr(holdfast, name), name
    for path in re.findall(r"\]\(([^)#]+)\)", text):
        assert (ROOT / "docs" / path).exists(), path
