"""The documents say what the program does."""
import pathlib
import re
import subprocess


def test_manual_is_up_to_date(gudgeon, root):
    """docs/manual.md is what `make docs` writes."""
    done = subprocess.run(["scripts/make_docs", str(pathlib.Path(gudgeon).parent), "--print"],
                          cwd=root, capture_output=True, text=True, check=True)
    assert done.stdout == (root / "docs/manual.md").read_text(), "run `make docs` and commit docs/manual.md"


def test_manual_has_the_equations(root):
    """Every joint kind of the manual brings the header of its file."""
    text = (root / "docs/manual.md").read_text()
    for kind in re.findall(r"^## ((?:joint|driver|clearance|contact|friction)\.\w+)$", text, re.M):
        after = text.split(f"## {kind}\n", 1)[1]
        assert after.lstrip().startswith("```\n") and "Source: " in after.split("```")[1], kind


def test_links_of_the_readme(root):
    """Every file that README.md links to is there."""
    for target in re.findall(r"\]\(([^)#]+)\)", (root / "README.md").read_text()):
        assert (root / target).exists(), target


def test_example_of_the_deck_page(gudgeon, root, tmp_path):
    """The example of docs/deck.md is a deck without mistakes."""
    example = re.search(r"```\n(# [^`]*?deck = 1.*?)```", (root / "docs/deck.md").read_text(), re.S).group(1)
    (tmp_path / "example.deck").write_text(example)
    done = subprocess.run([str(gudgeon), "check", "example.deck"], cwd=tmp_path, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
