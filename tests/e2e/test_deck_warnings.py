"""docs/reference/warnings.md: what every deck of inputs/ warns of, and what a user should do; no more and no less than that."""

import json
import re

import pytest
from support import ROOT, call, scratch

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


@pytest.mark.slow
@pytest.mark.parametrize("deck", DECKS)
def test_warnings(gudgeon, deck):
    """The warnings of a deck's run, or sweep, are those of the table."""
    out = scratch() / "out"
    options = ("sweep",) if "studies/" in deck else ("run", "--write", "channels")
    call(gudgeon, options[0], ROOT / deck, "--out", out, *options[1:], "--quiet", expect=5 if "dead_point" in deck else 0)
    told = [words for words in json.loads((out / "summary.json").read_text())["warnings"] if "omitted: --write" not in words]
    rows = [pattern(warning) for name, warning, _ in ROWS if name.strip("`") == deck]
    for words in told:
        assert any(row.match(words) for row in rows), words
    for row in rows:
        assert any(row.match(words) for words in told), row.pattern
