"""scripts/release: version and date of source, changelog, citation, manual and man page agree."""

import shutil
import subprocess

import pytest
from conftest import ROOT
from scripts_of_root import load

FILES = ("CHANGELOG.md", "CITATION.cff", "docs/reference/verbs.md", "scripts/python/pyproject.toml")


@pytest.fixture
def man_page(gudgeon):
    """What the program writes."""
    return subprocess.run([gudgeon, "help", "--man"], capture_output=True, text=True, check=True, timeout=60).stdout


def test_release_agrees(man_page):
    """Nothing differs in this tree."""
    assert load("release").disagreements(ROOT, man_page) == []


@pytest.mark.parametrize(("place", "old", "new"), [
    ("CHANGELOG.md", "## ", "## 9.9.9 (2000-01-01)\n\n## "), ("CITATION.cff", "version: ", "version: 9"),
    ("CITATION.cff", 'date-released: "', 'date-released: "1'), ("docs/reference/verbs.md", "Those of gudgeon ", "Those of gudgeon 9"),
    ("scripts/python/pyproject.toml", 'version = "', 'version = "9'),
    ("CHANGELOG.md", "- ", f"- {'x' * 120}"),
])
def test_a_difference_is_told(man_page, tmp_path, place, old, new):
    """One line for a file that differs, which names it."""
    for name in FILES:
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(ROOT / name, tmp_path / name)
    source = next((ROOT / "src").rglob("version.f90"))
    (tmp_path / "src").mkdir()
    shutil.copy(source, tmp_path / "src")
    path = tmp_path / place
    text = path.read_text(encoding="utf-8")
    at = text.index("\n" + old) + 1
    path.write_text(text[:at] + text[at:].replace(old, new, 1), encoding="utf-8")
    told = load("release").disagreements(tmp_path, man_page)
    assert len(told) == 1 and told[0].startswith(place)


def test_another_man_page_is_told(man_page):
    """The man page of another version."""
    told = load("release").disagreements(ROOT, man_page.replace('"gudgeon ', '"gudgeon 9', 1))
    assert len(told) == 1 and told[0].startswith("man page")
