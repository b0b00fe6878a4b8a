"""The page of a run: whole, without a network, its numbers those of summary.json, text of the deck nothing but text."""

import base64
import functools
import html.parser
import re

import pytest
from support import DECK, Run, call, changed, scratch, written
from test_motion_file import CRANK

TITLE = r"""</title><script>alert(1)</script> & 'b' <img src=x> \"c\" é"""


class Page(html.parser.HTMLParser):
    """Sections with their tables, pictures, frames, and what should not be there."""

    def __init__(self, text):
        super().__init__()
        self.tables, self.pictures, self.frames, self.tags, self.text, self.section = {}, [], [], [], "", ""
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        """A tag."""
        found = dict(attrs)
        self.tags.append((tag, found))
        if tag == "h2":
            self.section = found["id"]
        elif tag == "tr":
            self.tables.setdefault(self.section, []).append([])
        elif tag in ("td", "th"):
            self.tables[self.section][-1].append("")
        elif tag == "img":
            self.pictures.append(found["src"])
        elif tag == "iframe":
            self.frames.append(found["srcdoc"])

    def handle_endtag(self, tag):
        """The end of a tag."""
        self.tags.append((f"/{tag}", {}))

    def handle_data(self, data):
        """Text."""
        self.text += data
        if self.tags and self.tags[-1][0] in ("td", "th"):
            self.tables[self.section][-1][-1] += data


def report_of(gudgeon, text, *options, expect=0):
    """Run and page of a deck."""
    directory = scratch()
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet", *options, expect=expect)
    path = directory / "out" / "report.html"
    return Run(directory / "out"), path.read_text(encoding="utf-8") if path.exists() else None


@functools.lru_cache(maxsize=None)
def short_run(gudgeon):
    """A part of a turn of the slider-crank, with a picture, an animation and a title that is no HTML."""
    text = changed(DECK.read_text(encoding="utf-8"), "output", figures="slider.velocity animation(n=6,last=1ms)", report="on")
    text = changed(changed(text, "analysis.dynamic", end="3 ms"), "scene", title=f'"{TITLE}"')
    return report_of(gudgeon, text)


@pytest.fixture(name="run")
def run_of_crank(gudgeon):
    """The run and its page."""
    return short_run(gudgeon)


def value_of(cell, heading):
    """A number in the unit of its heading, in SI."""
    unit = heading.partition("[")[2].rstrip("]")
    prefix = {"k": 1e3, "m": 1e-3, "µ": 1e-6, "n": 1e-9, "M": 1e6}
    return float(cell) * (prefix.get(unit[0], 1.0) if len(unit) > 1 and unit[:3] not in ("m/s",) else 1.0)


def test_whole_and_harmless(run):
    """Pictures are those of the directory; nothing is asked of a network; the title is text."""
    folder, text = run
    page = Page(text)
    own = re.sub(r'srcdoc="[^"]*"', "", text)  # what pages of animations ask for: test_animation_page
    assert not re.search(r"https?:|@import|url\(", own)
    assert [tag for tag, found in page.tags if tag in ("script", "link")] == []
    assert all(source.startswith("data:image/png;base64,") for source in page.pictures)
    figures = folder.directory / "figures"
    assert [base64.b64decode(source.split(",")[1]) for source in page.pictures] == [(figures / "slider.velocity.png").read_bytes()]
    assert page.frames == [next(figures.glob("animation*.html")).read_text(encoding="utf-8")]
    assert TITLE.replace("\\", "") in page.text


def test_numbers_are_those_of_the_summary(run):
    """Loose joints, impacts, extremes: as summary.json has them, to the digits that are shown."""
    folder, text = run
    tables = Page(text).tables
    (joint,) = folder.summary["loose_joints"]
    heads, row = tables["loose_joints"]
    assert (row[0], int(row[1])) == ("gudgeon", joint["impacts"])
    keys = "contact_fraction impact_speed impact_speed_onset peak_force peak_force_time peak_penetration peak_penetration_time impulse"
    for cell, head, key in zip(row[2:], heads[2:], keys.split()):
        assert value_of(cell, head) == pytest.approx(joint[key], rel=1e-4), key
    assert len(tables["first_impacts"]) == 1 + joint["impacts"]
    assert [cells[0] for cells in tables["extremes"][1:]] == [entry["channel"] for entry in folder.summary["extremes"]]
    moment = next(entry for entry in folder.summary["extremes"] if entry["channel"] == "motor.moment")
    cells = next(cells for cells in tables["extremes"] if cells[0] == "motor.moment")
    assert float(cells[2]) == pytest.approx(moment["least"], rel=1e-4) and float(cells[4]) == pytest.approx(moment["greatest"], rel=1e-4)


def test_deck_warnings_and_cost(run):
    """The deck's tables row by row, every warning, what the run cost, which program and parameters."""
    folder, text = run
    page = Page(text)
    rows = page.tables["deck"]
    assert ["crank", "0.3", "0.0001", "0.025", "0", "0"] in rows and ["restitution", "0.9"] in rows
    assert next(row for row in rows if row[0] == "report") == ["report", "on"]
    for warning in folder.summary["warnings"]:
        assert warning in page.text
    assert "right-hand sides" in page.text and "energy residual" in page.text
    assert ["parameter c", "0.5 mm"] in page.tables["origin"]


def test_only_where_asked_for(gudgeon):
    """Without `report` there is none; a kinematic run and one that fails have theirs."""
    assert report_of(gudgeon, CRANK)[1] is None
    kinematic = CRANK.replace("[analysis.dynamic]", "[analysis.kinematic]").replace("[output]", "[output]\nreport = on")
    page = Page(report_of(gudgeon, kinematic)[1])
    assert "Newton" in page.text or "newton" in page.text
    failing = changed(CRANK, "analysis.dynamic", limit_cpu="1e-9 s").replace("[output]", "[output]\nreport = on")
    page = Page(report_of(gudgeon, failing, expect=5)[1])
    assert ("p", {"class": "status failed"}) in page.tags
