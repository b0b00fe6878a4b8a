"""Runs of the decks with lubricant films, made once for all tests that ask for the same."""

import functools

from conftest import ROOT
from support import Run, call, scratch

BEARING = ROOT / "inputs" / "journal_bearing.deck"
CRANK = ROOT / "inputs" / "slider_crank_lubricated.deck"
CLEARANCE = 0.2e-3  # of both decks [m]


@functools.lru_cache(maxsize=None)
def film_run(program, deck, *options, **settings):
    """A run without figures and tables; settings are parameters of the deck."""
    out = scratch() / "out"
    words = [word for name, value in settings.items() for word in ("--set", f"{name}={value}")]
    done = call(program, "run", deck, "--out", out, "--write", "channels", *options, *words)
    return Run(out, done)
