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
    for kind in re.findall(r"^## ((?:joint|driver|initial|force|function|clearance|contact|friction)\.\w+)$", text, re.M):
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


def test_functions_of_the_deck_page(gudgeon, root, tmp_path):
    """The example of functions in docs/deck.md is right once it has the bodies and points that it names."""
    example = re.search(r"```\n(\[function\.polynomial\].*?)```", (root / "docs/deck.md").read_text(), re.S).group(1)
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
