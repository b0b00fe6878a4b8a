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


def pages_of(root):
    """The documents, and what each says."""
    pages = [root / "README.md", root / "CONTRIBUTING.md", *sorted((root / "docs").rglob("*.md"))]
    return [(page, page.read_text(encoding="utf-8")) for page in pages]


def test_links(root):
    """Every file that a document links to is there."""
    for page, text in pages_of(root):
        for target in re.findall(r"\]\(([^)#\s]+)[^)]*\)", text):
            if "://" not in target:
                assert (page.parent / target).exists(), f"{page.name}: {target}"


def test_paths(root):
    """Every path of the sources, scripts, tests, decks and documents that a document names is there; capitals stand for any name."""
    for page, text in pages_of(root):
        for path in re.findall(r"(?<![\w/.-])(?:src|scripts|tests|inputs|docs)/[\w./*-]+", text):
            if not re.search(r"[A-Z]{3}", path):
                pattern = path.split("...")[0].rstrip("./*")
                assert any(root.glob(f"{pattern}*")), f"{page.name}: {path}"


def test_source_tree(root):
    """docs/architecture.md names every folder of src/; its picture and the paths of its tables are those of the sources."""
    text = (root / "docs/architecture.md").read_text(encoding="utf-8")
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
