"""docs/reference/warnings.md: what every deck of inputs/ warns of, and what a user should do; no more and no less than that."""

import json
import re

import pytest
from support import ROOT, call, changed, scratch, written

DECKS = sorted(str(path.relative_to(ROOT)) for path in (ROOT / "inputs").rglob("*.deck"))
ROWS = [[cell.strip() for cell in line.strip("|\n ").split("|")] for line in (ROOT / "docs/reference/warnings.md").read_text().splitlines()
        if line.startswith("| `inputs/")]


def pattern(words):
    """A warning of the table: `...` stands for numbers and names."""
    return re.compile(".*".join(re.escape(part) for part in words.strip("`").split("...")))


def test_rows_name_decks():
    """Every row is of a deck that there is, and says what to do."""
    for deck, warning, what in ROWS:
        assert deck.strip("`") in DECKS and len(warning) > 10 and len(what) > 10


def with_fewer_members(path):
    """A deck whose cases have at most two members, which differ by 1 nm: there are sixteen for their statistics' sake."""
    text = re.sub(r'(?m)^(\s*include\s+)"([^"]+)"', lambda found: f'{found.group(1)}"{path.parent / found.group(2)}"', path.read_text())
    return written(scratch(), changed(text, "ensemble", runs=2) if re.search(r"(?m)^ *\[ensemble\]", text) else text)


@pytest.mark.parametrize("deck", DECKS)
def test_warnings(gudgeon, deck):
    """The warnings of a deck's run, or sweep of all cases, are those of the table."""
    out = scratch() / "out"
    if "studies/" in deck:
        call(gudgeon, "sweep", with_fewer_members(ROOT / deck), "--out", out, "--quiet")
    else:
        call(gudgeon, "run", ROOT / deck, "--out", out, "--write", "channels", "--quiet", expect=5 if "dead_point" in deck else 0)
    told = [words for words in json.loads((out / "summary.json").read_text())["warnings"] if "omitted: --write" not in words]
    rows = [pattern(warning) for name, warning, _ in ROWS if name.strip("`") == deck]
    for words in told:
        assert any(row.match(words) for row in rows), words
    for row in rows:
        assert any(row.match(words) for words in told), row.pattern
