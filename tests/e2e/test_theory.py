"""The pages of docs/theory: every type and method is there, equations are numbered, symbols are used, sentences are short."""
import math
import re

import pytest
from pages import long_sentences

SOURCES = ["mechanics/contact", "mechanics/joints", "mechanics/forces", "mechanics/clearance", "mechanics/lubrication",
           "mechanics/constraints", "input/functions", "integrators/methods"]
TABLES = {"lubricant"}  # tables of these folders that are no types
HYSTERESIS = {  # h of a coefficient of restitution, from the sources that the page names
    "hunt_crossley": lambda c: 1.5*(1 - c), "herbert_mcwhannell": lambda c: 6*(1 - c)/((2*c - 1)**2 + 3),
    "lee_wang": lambda c: 0.75*(1 - c),
    "lankarani_nikravesh": lambda c: 0.75*(1 - c*c), "gonthier": lambda c: (1 - c*c)/c, "flores": lambda c: 1.6*(1 - c)/c,
    "zhiying_qishao": lambda c: 0.75*(1 - c*c)*math.exp(2*(1 - c)), "hu_guo": lambda c: 1.5*(1 - c)/c}
ENVIRONMENTS = {"cases", "bmatrix"}


@pytest.fixture(name="pages")
def pages_of(root):
    """The text of each page, by name."""
    return {path.name: path.read_text(encoding="utf-8") for path in sorted((root / "docs/theory").glob("*.md"))}


def types_and_methods(root):
    """Names that the sources register: laws, joints, films, forces, functions, stabilisation methods, solvers, integrators."""
    names = set()
    for folder in SOURCES:
        for path in (root / "src" / folder).glob("*.f90"):
            names |= set(re.findall(r'info%name = "([\w.]+)"', path.read_text()))
    return names - TABLES


def is_named(name, text):
    """Whether a page names it, as code or in a heading."""
    return f"`{name}`" in text or re.search(rf"^#+ [^\n]*(?<![\w.]){re.escape(name)}(?![\w.])", text, re.M)


def test_every_type_is_there(root, pages):
    """Every law, joint, film, force, function, solver and method that the sources register has its place in a page."""
    names = types_and_methods(root)
    assert {"contact.hertz", "friction.dahl", "film.grid", "joint.screw", "radau", "projection", "schur"} <= names
    missing = [name for name in sorted(names) if not any(is_named(name, text) for text in pages.values())]
    assert not missing


def test_numbers_of_equations(pages):
    """Each displayed formula has one number, consecutive on its page."""
    for page, text in pages.items():
        formulas = re.findall(r"^\$\$(.*?)\$\$$", text, re.M | re.S)
        numbers = [re.findall(r"\\tag\{(\d+)\}", formula) for formula in formulas]
        assert numbers == [[str(k)] for k in range(1, len(formulas) + 1)], page
        assert text.count("$$") == 2*len(formulas), page


def test_formulas_can_be_shown(pages):
    """Formulas have no macros of their own, pairs of braces, and environments that forges and converters know."""
    for page, text in pages.items():
        for formula in re.findall(r"\$\$(.*?)\$\$|\$([^$\n]+)\$", text, re.S):
            formula = formula[0] or formula[1]
            assert set(re.findall(r"\\begin\{(\w+)\}", formula)) <= ENVIRONMENTS, f"{page}: {formula}"
            assert not re.search(r"\\(?:newcommand|def|[,;!:%{}_#])", formula), f"{page}: {formula}"
            assert "<" not in formula and ">" not in formula, f"{page}: {formula}"
            assert "|" not in formula, f"{page}: {formula}"
            assert formula.count("{") == formula.count("}"), f"{page}: {formula}"
            left, right = (len(re.findall(rf"\\{side}(?![a-z])", formula)) for side in ("left", "right"))
            assert left == right, f"{page}: {formula}"


def test_symbols_are_used(pages):
    """What a table of symbols explains occurs in a formula of its page; an index k stands for i and j too."""
    for page, text in pages.items():
        table = re.search(r"^\| symbol \| meaning \| unit \|\n\|---\|---\|---\|\n((?:\|.*\n)+)", text, re.M)
        if page == "index.md":
            assert not table
            continue
        symbols = re.findall(r"^\| \$([^$]+)\$ \|", table[1], re.M)
        assert len(symbols) == len(set(symbols)) == table[1].count("\n"), page
        rest = " ".join(re.findall(r"\$+[^$]+\$+", text.replace(table[0], "")))
        for symbol in symbols:
            before = r"(?<![A-Za-z\\])" if symbol[0].isalpha() else ""
            behind = r"(?![A-Za-z])" if symbol[-1].isalpha() and not symbol.endswith("_k") else ""
            pattern = before + re.sub(r"_k$", "_[ijk]", re.escape(symbol)) + behind
            assert re.search(pattern, rest), f"{page}: {symbol}"


def restitution_of(h):
    """What two free bodies show: the motion m v dv = -F ddelta, so the integral of v/(1 + h v) from -e to 1 is zero; by halving."""
    low, high = 0.0, 1.0
    while high - low > 1e-9:
        e = 0.5*(low + high)
        left = 1 + e - (math.log(1 + h) - math.log(1 - h*e))/h if h*e < 1 else -math.inf
        low, high = (e, high) if left > 0 else (low, e)
    return low


def test_restitutions_of_the_table(pages):
    """The restitutions that the page of contact laws and the errata give are those of free impacts."""
    for law, hysteresis in HYSTERESIS.items():
        numbers = re.search(rf"^\| `contact\.{law}` \|.*\| ([\d., ]+) \|", pages["contact_laws.md"], re.M)[1]
        for c, number in zip((0.9, 0.7, 0.5, 0.3), map(float, numbers.split(", ")), strict=True):
            assert abs(number - restitution_of(hysteresis(c))) < 6e-4, f"{law} {c}"
    numbers = ", ".join(f"{restitution_of(HYSTERESIS['lankarani_nikravesh'](c)):.3f}" for c in (0.9, 0.8, 0.5))
    assert numbers in pages["errata.md"]


def test_reader_job_and_next(pages):
    """Each page starts with its reader and its job, and its last line leads to the next one: all pages once around."""
    order, page = [], "index.md"
    while page not in order:
        order.append(page)
        lines = pages[page].strip().splitlines()
        assert lines[2].startswith("For readers "), page
        assert lines[3].startswith("Job: "), page
        page = re.fullmatch(r"Next: \[[^]]+\]\((\w+\.md)\)", lines[-1])[1]
    assert page == "index.md"
    assert sorted(order) == sorted(pages)


def test_sentences_are_short(pages):
    """No sentence has more than 25 words, headings and tables apart."""
    assert {page: list(long_sentences(text)) for page, text in pages.items()} == {page: [] for page in pages}
