"""Sphinx: the site of the pages of docs/, read as files, without network. Made by scripts/make_docs."""

import importlib.resources
import pathlib
import re
import sys

from docutils import nodes
from latex2mathml.converter import convert
from pygments.lexer import RegexLexer
from pygments.lexers import TextLexer
from pygments.token import Comment, Keyword, String, Text
from sphinx.highlighting import lexers
from sphinx.search.en import SearchEnglish

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from notebook import page_of  # noqa: E402

project = "gudgeon"
source_suffix = {".md": "markdown", ".ipynb": "markdown"}
html_title = "gudgeon"
html_theme = "furo"
html_show_copyright = html_show_sphinx = html_copy_source = False
html_show_search_summary = False
# STIX Two Math, under the SIL Open Font License: not every system has a font whose roots and brackets grow
html_static_path = ["static", str(importlib.resources.files("ziamath") / "fonts/STIXTwoMath-Regular.ttf")]
html_css_files = ["site.css"]
html_math_renderer = "mathml"
pygments_style = "default"
highlight_language = "text"
extensions = ["myst_parser"]
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 4
suppress_warnings = ["myst.header"]
root_doc = "index"


class DeckLexer(RegexLexer):
    """Comments, sections and texts of a deck."""

    tokens = {"root": [(r"#.*", Comment), (r"^\[[\w.]+\]", Keyword), (r'"[^"]*"', String), (r"[^\s#\"\[]+|\s+|.", Text)]}


lexers["deck"], lexers["csv"] = DeckLexer(), TextLexer()

# Options and keys that the search of other sites leaves out as everyday words
SearchEnglish.stopwords = SearchEnglish.stopwords - {"above", "after", "at", "each", "from", "my", "out", "until"}

PARTS = ("tutorials", "how-to", "reference", "theory", "developer")


def pages_below(folder):
    """Pages of a folder: those that its index links to in that order, then the others by name; folders by their index."""
    index = folder / "index.md"
    linked = [(folder / target).resolve() for target in re.findall(r"\]\(([^)#\s]+\.(?:md|ipynb))", index.read_text(encoding="utf-8"))]
    there = [page for page in sorted(folder.glob("*.md")) + sorted(folder.glob("*.ipynb")) + sorted(folder.glob("*/index.md")) if page != index]
    first = [page for page in dict.fromkeys(linked) if page in there]
    return first, [page for page in there if page not in first]


def add_navigation(app, docname, source):
    """The list of pages of a part, at the end of its index: hidden for those that the index links to."""
    top = pathlib.Path(app.srcdir).resolve()
    page = pathlib.Path(app.env.doc2path(docname))
    if page.suffix == ".ipynb":
        source[0] = page_of(source[0])

    def within_site(link):
        """A link to a page beside docs/, which is not part of the site, becomes its name."""
        is_within = top in (page.parent / link[2]).resolve().parents
        return link[0] if is_within else f"{link[1]} (`{pathlib.Path(link[2]).name}`)"

    source[0] = re.sub(r"\[([^\]]*)\]\((\.\./[^)#\s:]+\.md)\)", within_site, source[0])
    if page.name != "index.md":
        return
    named, others = pages_below(page.parent)
    if docname == "index":
        named, others = [top / part / "index.md" for part in PARTS], []
    for pages, option in ((named, ":hidden:\n"), (others, "")):
        if pages:
            names = "\n".join(f"/{other.relative_to(top).with_suffix('')}" for other in pages)
            source[0] += f"\n\n```{{toctree}}\n:maxdepth: 1\n{option}\n{names}\n```\n"


def mathml(formula, display):
    """MathML of a formula; bars of a magnitude are brackets, which keep to what they enclose."""
    for side, bar in (("left", "lvert"), ("right", "rvert")):
        formula = re.sub(rf"(?<!\\{side})\\{bar}", rf"\\{side}\\{bar}", formula)
    return convert(formula, display=display)


def write_inline(translator, node):
    """An equation in a line."""
    translator.body.append(mathml(node.astext(), "inline"))
    raise nodes.SkipNode


def write_block(translator, node):
    """An equation of its own, and its number beside it."""
    number = re.search(r"\\tag\{(\w+)\}", node.astext())
    formula = mathml(node.astext().replace(number[0] if number else "", "").strip(), "block")
    translator.body.append(f'<div class="equation">{formula}' + (f"<span>({number[1]})</span>" if number else "") + "</div>")
    raise nodes.SkipNode


def setup(app):
    """What is added to Sphinx."""
    app.connect("source-read", add_navigation)
    app.add_html_math_renderer("mathml", (write_inline, None), (write_block, None))
