"""The documents say what the program does."""

import os
import pathlib
import re
import subprocess

import pytest
from pages import prose

OUTSIDE = re.compile(r"https?://|mailto:")


def test_reference_is_current(gudgeon, root):
    """The pages of docs/reference that `make docs` writes are those of this program."""
    done = subprocess.run(
        ["scripts/make_docs", str(pathlib.Path(gudgeon).parent), "--check"], cwd=root, capture_output=True, text=True, check=False
    )
    assert done.returncode == 0, done.stderr


def test_reference_has_the_equations(root):
    """The page of every kind with a file of its own brings the header of that file."""
    pages = [
        page
        for page in (root / "docs/reference/tables").glob("*.*.md")
        if re.match(r"(joint|driver|initial|force|function|clearance|contact|friction)\.", page.name)
    ]
    assert len(pages) >= 70
    for page in pages:
        text = page.read_text(encoding="utf-8")
        assert "Source: " in text.split("```")[1], page.name


def decks_of_reference():
    """(page, number, deck) of every deck of the pages of tables."""
    pages = sorted((pathlib.Path(__file__).resolve().parent.parent.parent / "docs/reference/tables").glob("*.md"))
    for page in pages:
        for k, deck in enumerate(re.findall(r"A deck that runs\n\n```text\n(.*?)```", page.read_text(encoding="utf-8"), re.S)):
            yield page.stem, k, deck


def test_decks_of_the_reference(gudgeon, root, tmp_path):
    """Every page of a table shows a deck, for the plane and for space, which has the table and runs; none is kept unseen."""
    shown = {}
    (tmp_path / "wear.deck").write_text((root / "docs/reference/decks/wear.deck").read_text(encoding="utf-8"), encoding="utf-8")
    subprocess.run([str(gudgeon), "run", "wear.deck", "--quiet"], cwd=tmp_path, check=True, timeout=120)  # worn.run goes on from it
    for page, k, deck in decks_of_reference():
        shown.setdefault(page, []).append(deck)
        verb = next((verb for verb in ("sweep", "precision") if page in (verb, "ensemble" if verb == "sweep" else "")), "run")
        path = tmp_path / f"{page}_{k}.deck"
        path.write_text(deck, encoding="utf-8")
        done = subprocess.run(
            [str(gudgeon), verb, path.name, "--quiet"], cwd=tmp_path, capture_output=True, text=True, check=False, timeout=120
        )
        assert done.returncode == 0, f"{path.name}: {done.stderr}"
        assert f"[{page}]" in deck or page.startswith(("integrator.", "energy")), page
        assert deck.count("\n") < 70, f"{path.name} is long"
    heads = {deck.partition("\n")[0] for decks in shown.values() for deck in decks}
    for path in (root / "docs/reference/decks").glob("*.deck"):
        assert path.read_text(encoding="utf-8").partition("\n")[0] in heads, f"{path.name} is not shown"
    for page in (root / "docs/reference/tables").glob("*.md"):
        text = page.read_text(encoding="utf-8")
        wanted = 2 if "\n## In space\n" in text else 1
        assert page.stem == "index" or len(shown.get(page.stem, [])) == wanted, f"{page.name} shows no deck"


def pages_of(root):
    """The documents, and what each says."""
    pages = [root / "README.md", root / "CONTRIBUTING.md", *sorted((root / "docs").rglob("*.md"))]
    return [(page, page.read_text(encoding="utf-8")) for page in pages]


def anchors_of(text):
    """Anchors of the headings of a page, as forges and the site make them."""
    found = {}
    for heading in re.findall(r"^#{1,6} (.*)$", prose(text), re.M):
        words = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").strip().lower()
        name = re.sub(r"[^\w\- ]", "", words).replace(" ", "-")
        found[name] = found.get(name, -1) + 1
    return {f"{name}-{k}" if k else name for name, n in found.items() for k in range(n + 1)}


def broken_links(root):
    """Links to a file that is not there, or to a heading that its page does not have."""
    for page, text in pages_of(root):
        for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`\n]*`", "", prose(text))):
            path, _, anchor = target.partition("#")
            there = pathlib.Path(os.path.normpath(page.parent / path)) if path else page
            if OUTSIDE.match(target):
                continue
            if not there.exists():
                yield f"{page.relative_to(root)}: no file {target}"
            elif anchor and anchor not in anchors_of(there.read_text(encoding="utf-8")):
                yield f"{page.relative_to(root)}: no heading {target}"


def test_links(root):
    """Every file and every heading that a document links to is there."""
    assert list(broken_links(root)) == []


@pytest.mark.parametrize("link", ["[a](nothing.md)", "[a](deck.md#nothing)", "[a](#nothing)"])
def test_a_broken_link_is_found(tmp_path, link):
    """What the check of links finds."""
    (tmp_path / "docs").mkdir()
    for name, text in (
        ("README.md", ""),
        ("CONTRIBUTING.md", ""),
        ("docs/deck.md", "# The deck\n\n[b](#the-deck)\n"),
        ("docs/page.md", f"# Page\n\n{link}\n"),
    ):
        (tmp_path / name).write_text(text, encoding="utf-8")
    assert len(list(broken_links(tmp_path))) == 1


@pytest.mark.slow
def test_site(gudgeon, root, tmp_path):
    """The site is made without a warning, has every page, asks nothing of a network, and its equations are MathML."""
    sphinx = pathlib.Path(gudgeon).parent / "site-venv/bin/sphinx-build"
    if not sphinx.exists():
        pytest.skip("no Sphinx in the build directory: make docs")
    subprocess.run(
        [
            sphinx,
            "-q",
            "-W",
            "--keep-going",
            "-c",
            root / "scripts/site",
            "-d",
            tmp_path / "trees",
            root / "docs",
            tmp_path / "site",
        ],
        check=True,
        capture_output=True,
        text=True,
    )
    for page, text in pages_of(root)[2:]:
        html = (tmp_path / "site" / page.relative_to(root / "docs")).with_suffix("").as_posix() + ".html"
        html = pathlib.Path(html).read_text(encoding="utf-8")
        assert not re.search(
            r"<(?:script|img|iframe)[^>]*src=\"(?:https?:)?//|<link[^>]*stylesheet[^>]*href=\"(?:https?:)?//", html
        ), page.name
        assert html.count("<math") >= len(re.findall(r"^\$\$$", text, re.M)) // 2, page.name
    assert "joint.revolute" in (tmp_path / "site/searchindex.js").read_text(encoding="utf-8")
    for notebook in (root / "docs/tutorials").glob("*.ipynb"):
        html = (tmp_path / "site/tutorials" / f"{notebook.stem}.html").read_text(encoding="utf-8")
        assert "import" in html and html.count("<img") == 1 and "<math" in html, notebook.name


def test_words_of_the_field(root):
    """Pages, messages and names have no private words."""
    done = subprocess.run([root / "scripts/check_words"], cwd=root, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


def test_paths(root):
    """Every path of sources, scripts, tests, decks and documents that a document names is there; capitals stand for any name."""
    for page, text in pages_of(root):
        for path in re.findall(r"(?<![\w/.-])(?:src|scripts|tests|inputs|docs)/[\w./*-]+", text):
            if not re.search(r"[A-Z]{3}", path):
                pattern = path.split("...")[0].rstrip("./*")
                assert any(root.glob(f"{pattern}*")), f"{page.name}: {path}"


def test_source_tree(root):
    """docs/developer/architecture.md names every folder of src/; its picture and the paths of its tables are those of the sources.
    """
    text = (root / "docs/developer/architecture.md").read_text(encoding="utf-8")
    subprocess.run([root / "scripts/architecture_figure", "--check"], check=True)
    folders = [folder for top in (root / "src").iterdir() for folder in (top, *top.iterdir()) if folder.is_dir()]
    for folder in folders:
        assert re.search(rf"^\| [^|]*\b{folder.name}\b", text, re.M), f"no line for {folder.relative_to(root)}"
    tops = "|".join(top.name for top in (root / "src").iterdir())
    for path in re.findall(rf"(?<![\w/])(?:{tops})/\w[\w/]*", text):
        assert any((root / "src").glob(path)) or any((root / "src").glob(f"{path}.*")), path
    for name in re.findall(r"`(\w+_registry)`|(\w+_registry) \|", text):
        assert any((root / "src").glob(f"*/*/{name[0] or name[1]}.f90")), name


def test_example_of_the_deck_page(gudgeon, root, tmp_path):
    """The example of docs/reference/deck.md is a deck without mistakes."""
    example = re.search(r"```deck pushed.deck\n(# [^`]*?deck = 1.*?)```", (root / "docs/reference/deck.md").read_text(), re.S).group(1)
    (tmp_path / "example.deck").write_text(example)
    done = subprocess.run([str(gudgeon), "check", "example.deck"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_functions_of_the_deck_page(gudgeon, root, tmp_path):
    """The example of functions in docs/reference/deck.md is right once it has the bodies and points that it names."""
    example = re.search(r"```deck\n(\[function\.polynomial\].*?)```", (root / "docs/reference/deck.md").read_text(), re.S).group(1)
    (tmp_path / "pull.txt").write_text("t[s] pull[N]\n0 0\n1 2\n2 1\n3 0\n")
    around = """deck = 1
[bodies]
name   mass[kg]  inertia[kg.m^2]  x[m]  y[m]
block  1         1                0     0
[points]
name   body    xi[m]  eta[m]
floor  ground  0      0
hook   ground  0      1
foot   block   0      0
eye    block   0      0.1
[joint.translational]
name   i      j     axis
guide  floor  foot  y
"""
    (tmp_path / "example.deck").write_text(around + example + "[analysis.dynamic]\nend = 2 s\n")
    done = subprocess.run([str(gudgeon), "check", "example.deck"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr


def test_every_table_is_linked_from_the_reference(root):
    """A page of a table is two clicks from the first page."""
    text = (root / "docs/reference/index.md").read_text(encoding="utf-8")
    linked = set(re.findall(r"\]\(tables/([\w.]+)\.md\)", text))
    assert linked - {"index"} == {page.stem for page in (root / "docs/reference/tables").glob("*.md")} - {"index"}


def test_rows_of_tables_belong_to_a_table(root):
    """A blank line within a table would make the rows after it text with bars."""
    for page in (root / "docs").rglob("*.md"):
        before = ["", ""]
        for number, line in enumerate(prose(page.read_text(encoding="utf-8")).splitlines(), 1):
            if line.startswith("|") and not before[1].startswith("|"):
                head = number
            if line.startswith("|") and number == head + 1:
                assert set(line) <= set("|-: "), f"{page.relative_to(root)}: row {line[:60]} has no table"
            before = [before[1], line]
