"""Pages of the animations of all decks in one headless Chromium: small enough, no error, what a user does shows something."""

import os
import sys

import pytest
from support import ROOT, scratch

sys.path.insert(0, str(ROOT / "tests" / "browser"))
from open_pages import BLIND, INSET, SEEN_BLIND, check_inset, check_page, make_pages, seen_in  # noqa: E402
from visit import browser_here, visit, watched  # noqa: E402

END = r"^end( *)= .*"
# runs that are ended early: the page is of the same kind
SHORTER = {"big_end": "0.05 turns of motor", "billiards": "60 ms", "bouncing_ball": "1 s", "double_pendulum": "1 s", "ferris_wheel": "2 s",
           "four_bar": "0.5 s", "four_bar_spatial": "0.2 s", "friction": "0.2 s", "gate": "2 s", "hanging_chain": "2 s", "hatch": "2 s",
           "journal_bearing": "50 ms", "pinball": "100 ms", "slider_crank_6_6_ball": "5 ms", "slider_crank_6_6_bushing": "5 ms",
           "slider_crank_6_6_lubricated": "5 ms", "slider_crank_6_6_planar": "5 ms", "slider_crank_dry": "4 ms",
           "slider_crank_lubricated": "4 ms", "slider_crank_translational": "4 ms", "slider_crank_two_joints": "4 ms", "valve_train": "20 ms"}


@pytest.fixture(name="pages")
def pages_of_all_decks(gudgeon):
    """Pages of all decks of inputs/, without pictures by gnuplot; skipped where there is no browser."""
    if browser_here() is None:
        pytest.skip("no Chromium on this machine: apt-get install chromium")
    directory = scratch()
    names = sorted(path.stem for path in (ROOT / "inputs").glob("*.deck") if not path.stem.startswith("tolerance_"))  # those stand still
    changes = {name: [(END, rf"end\1= {end}")] for name, end in SHORTER.items()}
    return make_pages(gudgeon, directory, names, changes, {**os.environ, "PATH": str(directory)})


def test_pages_of_all_decks(pages):
    """In the plane and in space: no error, nothing asked for, steps, traces, views and names; without WebGL a sentence and the plots."""
    found = seen_in(pages)
    for name, path in pages.items():
        check_page(name, path, found[name])
    blind = watched(pages["slider_crank_dry"].read_text(encoding="utf-8"), SEEN_BLIND).replace("<style>", BLIND + "<style>", 1)
    dry = pages["slider_crank_dry"]
    found = visit({"blind": blind, "inset": watched(dry.read_text(encoding="utf-8"), INSET)})
    check_inset(dry.parent.parent.parent, found["inset"])
    seen = found["blind"]
    assert seen["errors"] == [] and "WebGL" in seen["text"] and seen["plots"] > 1 and seen["buttons"] and seen["time"] != "t = 0 s", seen
