"""Notebooks of the tutorials: their cells run by plain Python, give the outputs that are stored, and become pages of the site."""

import json
import os
import shutil
import subprocess
import sys

import pages
import pytest
from support import ROOT

NOTEBOOKS = sorted((ROOT / "docs/tutorials").glob("*.ipynb"))


def cells_of(path, kind):
    """Sources of the cells of a kind."""
    return ["".join(cell["source"]) for cell in json.loads(path.read_text(encoding="utf-8"))["cells"] if cell["cell_type"] == kind]


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_notebook(gudgeon, path, tmp_path):
    """It runs; what it prints is what it shows; a number that is another one is told."""
    pytest.importorskip("pandas")
    if not shutil.which("gnuplot"):
        pytest.skip("gnuplot is not there")
    changed = tmp_path / "changed.ipynb"
    notebook = json.loads(path.read_text(encoding="utf-8"))
    printed = next(output for cell in notebook["cells"] for output in cell.get("outputs", []) if "text" in output)
    printed["text"][-1] = printed["text"][-1].replace("0", "1").replace("2", "3")
    changed.write_text(json.dumps(notebook), encoding="utf-8")
    done = subprocess.run([sys.executable, "-B", ROOT / "scripts/run_notebook", path, changed], capture_output=True, text=True, timeout=120,
                          env={**os.environ, "GUDGEON": str(gudgeon)})
    assert done.returncode == 1 and path.name not in done.stdout and "changed.ipynb, cell" in done.stdout, done.stdout + done.stderr


def test_there_are_notebooks():
    """Small ones, with a picture each, sentences as on other pages, and a check against something independent."""
    assert [path.stem for path in NOTEBOOKS] == ["7-counterweight", "8-restitution"]
    for path in NOTEBOOKS:
        text = path.read_text(encoding="utf-8")
        assert len(text) < 100_000 and text.count('"image/png"') == 1, path.name
        assert list(pages.long_sentences("\n\n".join(cells_of(path, "markdown")))) == [], path.name
    counterweight, restitution = (path.read_text(encoding="utf-8") for path in NOTEBOOKS)
    assert "relative difference below 1e-9: True" in counterweight and "holds 0.8: True" in restitution


def test_pages_of_notebooks(root, monkeypatch):
    """Cells, what they print and pictures, in their order."""
    monkeypatch.syspath_prepend(str(root / "scripts/site"))
    from notebook import page_of

    for path in NOTEBOOKS:
        page = page_of(path.read_text(encoding="utf-8"))
        places = [page.index(source) for source in cells_of(path, "markdown")]
        assert places == sorted(places) and page.count("```python\n") == len(cells_of(path, "code"))
        assert "](data:image/png;base64," in page
