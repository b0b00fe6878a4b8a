"""Texts that look like commands are drawn and written as text; nothing of them is run."""

import h5py
import pytest
from support import DECK, Run, call, changed, finished, plain, plain_deck, scratch, written

TITLES = [
    "`touch PWNED` and $(touch PWNED) and ${IFS}touch${IFS}PWNED",
    "it's \"quoted\" # no comment; system('touch PWNED')",
    "a line\n!touch PWNED\nand \\n!touch PWNED\\n and \\012!touch PWNED and \\",
    "| touch PWNED",
    "< touch PWNED",
    "!touch PWNED",
    "%s %d %n {/Symbol a}^2 _x @y ~a{.8-} \u00fcber \u2202x",
    "'; system \"touch PWNED\"; print '",
    "\u202eright to left, and " + "long " * 200,
]


def title_in_deck(title):
    """A title between the deck's quotes."""
    escaped = title.replace("\\", "\\\\").replace('"', '\\"').replace("\n", "\\n")
    return f'"{escaped}"'


def nothing_ran(*places):
    """No file was touched."""
    return not [path for place in places for path in place.rglob("*PWNED*")]


def test_hostile_titles(gudgeon, root):
    """Every title gives its figure, stands in run.h5 as it is, and touches no file."""
    directory = scratch()
    for k, title in enumerate(TITLES):
        text = changed(plain_deck([("analysis.dynamic", "end", "0.4 ms")]), "scene", title=title_in_deck(title))
        text = changed(text, "output", figures="slider.velocity")
        out = directory / f"out{k}"
        call(gudgeon, "run", written(directory, text), "--out", out, "--quiet", cwd=directory)
        figures = list(out.glob("figures/*.png"))
        assert len(figures) == 1 and figures[0].stat().st_size > 3000, title
        assert Run(out).read("deck") == text
    assert nothing_ran(directory)
    assert not (root / "PWNED").exists()


def test_a_title_changes_the_picture(gudgeon):
    """The title is drawn: two titles, two pictures."""
    pictures = set()
    directory = scratch()
    for title in ("one thing", "another thing", "`touch PWNED`"):
        text = changed(plain_deck([("analysis.dynamic", "end", "0.4 ms")]), "scene", title=f'"{title}"')
        text = changed(text, "output", figures="slider.velocity")
        call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet", cwd=directory)
        pictures.add(next((directory / "out" / "figures").glob("*.png")).read_bytes())
    assert len(pictures) == 3
    assert nothing_ran(directory)


@pytest.mark.parametrize("name", [
    "it's a directory", "`touch PWNED`", "$(touch PWNED)", "a;touch PWNED", "|touch PWNED", "<touch PWNED", "!touch PWNED",
    "-rf", "a\nb", "100%s", "\u00e4\u00f6\u00fc",
])
def test_hostile_directories(gudgeon, name):
    """A directory with such a name holds the run and its figure."""
    directory = scratch()
    text = changed(plain_deck([("analysis.dynamic", "end", "0.4 ms")]), "output", figures="slider.velocity")
    deck = written(directory, text)
    call(gudgeon, "run", deck, "--out", f"./{name}", "--quiet", cwd=directory)
    assert (directory / name / "run.h5").exists()
    assert len(list((directory / name / "figures").glob("*.png"))) == 1
    assert sorted(path.name for path in directory.iterdir() if path.is_dir()) == [name]


def test_hostile_deck_name(gudgeon):
    """So does the name of a deck."""
    directory = scratch()
    text = changed(plain_deck([("analysis.dynamic", "end", "0.4 ms")]), "output", figures="slider.velocity")
    deck = written(directory, text, "`touch PWNED`; it's $(touch PWNED).deck")
    call(gudgeon, "run", deck.name, "--quiet", cwd=directory)
    out = directory / "outputs" / deck.stem
    assert len(list(out.glob("figures/*.png"))) == 1
    assert nothing_ran(out) and not (directory / "PWNED").exists()


def test_hostile_words_in_messages(gudgeon):
    """A mistake is shown as it stands, without control characters that could fool a terminal."""
    deck = written(scratch(), DECK.read_text().replace("title    =", "\x1b]0;owned\x07title    ="))
    done = call(gudgeon, "check", deck, expect=3)
    assert "\x1b" not in done.stderr and "\x07" not in done.stderr


def test_provenance_holds_the_command(gudgeon):
    """The command line stands in /provenance as text."""
    with h5py.File(finished(gudgeon).directory / "run.h5", "r") as file:
        assert "run" in plain(file["provenance"].attrs["command"])
