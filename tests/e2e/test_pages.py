"""Tutorials, how-to pages and pages of the reference that are written by hand: every deck that they show is run, every command gives the output and the exit code that they say."""

import re

import pages
import pytest
from support import ROOT, scratch

KINDS = {"deck", "sh", "text", "csv", "python", "octave", "matlab"}
IDS = [f"{page.parent.name}/{page.stem}" for page in pages.PAGES]
LISTED = [(page, fence) for page in pages.PAGES for fence in pages.fences(page.read_text(encoding="utf-8"))
          if fence.kind == "sh" and not fence.is_run]


def test_there_are_pages():
    """Both folders have pages."""
    assert {page.parent.name for page in pages.PAGES} == {"tutorials", "how-to"}


@pytest.mark.parametrize("shown, is_there", [
    ("rod  1.00 ... m", True), ("rod 1.01 ... m", True), ("rod 1.03 ... m", False), ("rot 1.00 ... m", False), ("rod 1.00", False),
    ("rod 0.99... 5 7 m", True), ("rod 0.98... 5 7 m", False), ("pin 3\nrod ...", False), ("rod ...\npin 3", True),
    ("rod -1.00 ...", False),
])
def test_output_is_compared(shown, is_there):
    """Words, numbers within TOLERANCE, the order of lines, and what `...` stands for."""
    said = "rod 0.9999 5 7 m\npin 3\n"
    assert (pages.missing(shown, said) is None) == is_there


@pytest.mark.slow
@pytest.mark.parametrize("page", pages.PAGES, ids=IDS)
def test_page(gudgeon, page):
    """The commands of a page, in their order, in one directory."""
    directory = scratch()
    assert pages.run_page(page, gudgeon, directory) > 0
    for path, run, figure in pages.pictures(page.read_text(encoding="utf-8")):
        assert (page.parent / path).exists(), f"{page.name}: {path} is not there: tests/e2e/pages.py --figures"
        assert (directory / "outputs" / run / "figures" / f"{figure}.png").exists(), f"{page.name}: no command draws {path}"


@pytest.mark.slow
@pytest.mark.parametrize("page", pages.REFERENCE, ids=lambda page: page.stem)
def test_reference_page(gudgeon, page):
    """The same of pages of the reference; no command of theirs stands in indented text, where it is not run."""
    assert pages.run_page(page, gudgeon, scratch()) > 0
    text = pages.prose(page.read_text(encoding="utf-8"))
    assert not re.search(r"^    (?:gudgeon|python3|scripts/)", text, re.M), "use a fence"


def test_fragment_with_an_unknown_column(gudgeon):
    """What a fragment must not have is found."""
    directory = scratch()
    page = directory / "page.md"
    page.write_text("```deck\n[points]\nname body xi[m] theta[m]\np ground 0 0\n```\n")
    with pytest.raises(pages.Failure, match="unknown column 'theta'"):
        pages.run_page(page, gudgeon, directory)


@pytest.mark.parametrize("page", pages.PAGES, ids=IDS)
def test_all_is_run(page):
    """Every fence says what it is, and every deck is named by a command that test_page runs or by a deck that is."""
    text = page.read_text(encoding="utf-8")
    found = pages.fences(text)
    assert text.count("\n```") == 2 * len(found), "a fence is not closed, or stands in a list"
    assert not re.search(r"^(?: {4}|\t)", pages.prose(text), re.M), "indented text is not run: use a fence"
    files = {}
    for fence in found:
        assert fence.kind in KINDS, f"{page.name}:{fence.line}: what is this? {fence.words}"
        if fence.kind != "sh" and fence.words != ["text"]:
            assert len(fence.words) == 2, f"{page.name}:{fence.line}: a file has one name"
            files[fence.words[1]] = fence
    used = "\n".join([line for fence in found if fence.is_run for line in fence.commands] + [file.text for file in files.values()])
    listed = "\n".join(line for fence in found if fence.kind == "sh" and not fence.is_run for line in fence.commands)
    for name, fence in files.items():
        is_used = name in used or fence.kind != "deck" and name.rsplit(".", 1)[0] in listed
        assert is_used, f"{page.name}:{fence.line}: no command takes {name}"


@pytest.mark.parametrize("listed", LISTED, ids=lambda listed: f"{listed[0].stem}:{listed[1].line}")
def test_listed(listed):
    """What needs a cluster, a window or a program that is not here: listed with its reason."""
    page, fence = listed
    assert fence.commands
    pytest.skip(f"{page.relative_to(ROOT)}:{fence.line}: not run here: {'; '.join(fence.commands)}")


@pytest.mark.parametrize("page", pages.PAGES, ids=IDS)
def test_style(page):
    """A sentence has at most 25 words; the last paragraph names the next page."""
    text = pages.prose(page.read_text(encoding="utf-8"))
    assert re.search(r"Next: [^\n]*\]\(", text.strip().split("\n\n")[-1]), "the last paragraph names the next page"
    assert list(pages.long_sentences(text)) == []
