"""The scripts that draw several runs in one figure: one figure from short runs, against Hertz's closed form."""

import importlib.util
import sys
from importlib.machinery import SourceFileLoader

import numpy as np
import pytest
from support import ROOT


@pytest.fixture(name="scripts", scope="module")
def import_scripts():
    """figure_tools and law_figures as modules."""
    sys.path.insert(0, str(ROOT / "scripts"))
    found = []
    for name, file in (("figure_tools", "figure_tools.py"), ("law_figures", "law_figures")):
        loader = SourceFileLoader(name, str(ROOT / "scripts" / file))
        module = importlib.util.module_from_spec(importlib.util.spec_from_loader(name, loader))
        sys.modules[name] = module
        loader.exec_module(module)
        found.append(module)
    yield found
    sys.path.remove(str(ROOT / "scripts"))


def test_one_figure(gudgeon, tmp_path, scripts):
    """Figure 3.3 from one impact: the PNG, its script and its tables, of which the third is F = K delta^1.5."""
    tools, laws = scripts
    figures = tmp_path / "figures"
    figures.mkdir()
    runs = tools.run_all(gudgeon, tmp_path, {"impact_hertz": laws.impact_case("hertz")})
    tools.draw_panels(figures, "figure_3_3", laws.impact_panels(runs, "hertz"), columns=3, width=400, height=330)
    assert (figures / "figure_3_3.png").stat().st_size > 10000
    depth, force = np.loadtxt(figures / "figure_3_3.c1.dat").T  # um, kN
    stiffness = 6.61019840e10
    assert np.abs(1e3*force - stiffness*(1e-6*depth)**1.5).max() < 1.0
    peak = stiffness**0.4*(1.25*0.14*4.385783**2)**0.6  # of a free mass in closed form
    assert abs(1e3*force.max()/peak - 1.0) < 1e-4
    assert laws.delivered(runs["impact_hertz"]) == pytest.approx(1.0, abs=1e-8)


def test_changes_of_a_deck(tmp_path, scripts):
    """Tables are renamed; keys are replaced, added and taken out in their section, sections added."""
    deck = tmp_path / "small.deck"
    deck.write_text("deck = 1\n[output]\nfigures = a b\nevery = 1 s\n[stage]\ntitle = x\n")
    text = scripts[0].deck_text(deck, {"output": {"every": "2 s", "last": "1 s"}, "ensemble": {"runs": "1"}}, {"stage": "scene"})
    assert text == "deck = 1\n[output]\nlast = 1 s\nevery = 2 s\n[scene]\ntitle = x\n\n[ensemble]\nruns = 1\n"


def test_failed_run_is_told(gudgeon, tmp_path, scripts, capsys):
    """A run that the program refuses is left out, with its message."""
    tools, laws = scripts
    assert tools.run_all(gudgeon, tmp_path, {"bad": tools.Case(laws.IMPACT, {"law": "none_such"})}) == {}
    assert "bad: ended with code" in capsys.readouterr().err


def test_curves_of_the_timers_differ():
    """Of two dozen curves none has the marker and the colour of another, and none the dashes of another of its colour."""
    spec = importlib.util.spec_from_file_location("pictures", ROOT / "tests" / "bench" / "pictures.py")
    pictures = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(pictures)
    looks = [pictures.look(n) for n in range(1, 25)]
    assert len({look[:2] for look in looks}) == len({look[1:] for look in looks}) == len(looks)
    assert all(4 <= look[0] <= 13 for look in looks), "pentagons look like circles"
