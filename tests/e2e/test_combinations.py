"""Every deck of inputs/ through check, explain and a shortened run, as it is and with --ideal, in the build with run-time checks.

Decks are found by themselves. A run is that of a copy which says what is different: a twentieth of the motion, fewer output
instants and pictures of an animation, statistics of every channel with a period, and more figures: a time history, a spectrum, a section.
Every call ends with exit code 0 and its own words: decks of inputs/ are right, and none has a mechanism that --ideal stops.
"""

import concurrent.futures
import os
import re
import time

import h5py
import pytest
from conftest import ROOT, built, directory_of
from support import Run, call, changed, scratch, text_of, written

FOLDERS = ("inputs", "inputs/hard", "inputs/studies")
DECKS = sorted(path for folder in FOLDERS for path in (ROOT / folder).glob("*.deck"))
PART = 20  # of the motion that is run
INSTANTS = 25  # of output
FRAMES = 8  # of an animation
PERIODS = 4  # of the statistics
PICTURES = (b"\x89PNG", b"GIF89a", b"<!DOCTYPE html>")  # how figures, animations and their pages begin
CRASH = re.compile(r"Backtrace|runtime error|Program received signal|SIG[A-Z]{3}|internal mistake", re.IGNORECASE)
ENDED = re.compile(r"from 0 to (\S+) s; output")


def analyses(text):
    """The analyses that a deck has."""
    return sorted(set(re.findall(r"(?m)^\s*\[analysis\.(\w+)\]", text)))


def first_body(text):
    """Name of the first body."""
    rows = text.split("[bodies]", 1)[1].splitlines()[1:]
    rows = [row for row in rows if row.strip() and not row.lstrip().startswith("#")]
    return rows[1].split()[0]


def shortened(deck, analysis, end):
    """A deck's text with files at their places, its motion cut, statistics and more figures asked for."""
    text = re.sub(r'(?m)^(\s*include\s+)"([^"]+)"', lambda found: f'{found.group(1)}"{deck.parent / found.group(2)}"', deck.read_text())
    text = re.sub(r'"([^"/\s]+\.txt)"', lambda found: f'"{deck.parent / found.group(1)}"', text)
    every = f"{end / PART / INSTANTS:.17g} s"
    own = re.findall(r"(?m)^\s*figures\s*=\s*([^#\n]*)", text_of(deck))
    body = first_body(text_of(deck))
    figures = re.sub(r"\(t=([\d.]+)", lambda found: f"(t={float(found.group(1)) / PART:.17g}", own[-1].strip() if own else "")
    figures = f"{figures} {body}.velocity"
    figures = re.sub(r"\banimation\b(?!\()", f"animation(n={FRAMES})", figures)
    if analysis == "dynamic":
        figures += f" spectrum({body}.velocity.x) section({body}.velocity.x,{body}.velocity.y)"
    settings = {"output": {"every": every, "from": "0 s", "last": "0 s", "figures": figures, "motion": "vtkhdf"}}
    if analysis != "static":
        settings[f"analysis.{analysis}"] = {"end": f"{end / PART:.17g} s"}
    if analysis == "dynamic":
        settings["statistics"] = {"after": every, "period": f"{end / PART / PERIODS:.17g} s", "channels": "*",
                                  "spectra": f"{body}.velocity"}
    for section, keys in settings.items():
        if not re.search(rf"(?m)^\s*\[{re.escape(section)}\]", text):
            text += f"\n[{section}]\n"
        text = changed(text, section, **keys)
    return text


def sound(program, *arguments):
    """A call that must end well: what it said, and how long it took."""
    begin = time.perf_counter()
    done = call(program, *arguments, expect=0)
    assert not CRASH.search(done.stderr), done.stderr
    assert "error" not in done.stderr, done.stderr
    done.seconds = time.perf_counter() - begin
    return done


def try_deck(program, deck):
    """One deck through all verbs and options: what each said."""
    said = {}
    text = text_of(deck)
    for options in ((), ("--ideal",)):
        for analysis in analyses(text):
            chosen = (*options, "--analysis", analysis)
            said["check", chosen] = sound(program, "check", deck, *chosen)
            said["explain", chosen] = sound(program, "explain", deck, *chosen)
            end = ENDED.search(said["explain", chosen].stdout)
            short = shortened(deck, analysis, float(end.group(1)) if end else 0.0)
            directory = scratch()
            out = directory / "out"
            done = sound(program, "run", written(directory, short), "--out", out, *chosen)
            done.run = Run(out, done)
            said["run", chosen] = done
    return said


@pytest.fixture(scope="module")
def everything(request):
    """The chosen decks, as many at a time as there are processors: a future of each."""
    program = built(directory_of("debug") / "gudgeon")
    chosen = [item.callspec.params["deck"] for item in request.session.items if getattr(item, "function", None) is test_deck]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count() or 1) as pool:
        yield {deck: pool.submit(try_deck, program, deck) for deck in chosen}


def test_decks_are_found():
    """New decks join by themselves; none of the folders is empty."""
    for folder in FOLDERS:
        assert list((ROOT / folder).glob("*.deck")), folder


@pytest.mark.slow
@pytest.mark.parametrize("deck", DECKS, ids=lambda deck: str(deck.relative_to(ROOT / "inputs")))
def test_deck(deck, everything, record_property):
    """Every verb ends well; check and explain say what they are for; the run is complete, with its figures and statistics."""
    said = everything[deck].result()
    text = text_of(deck)
    for (verb, options), done in said.items():
        record_property(" ".join((verb, *options)), round(done.seconds, 2))
        where = (verb, *options)
        if verb == "check":
            assert "no errors" in done.stdout, where
        elif verb == "explain":
            for word in ("model", "not used", "method", "defaults used"):
                assert re.search(rf"^{word}\b", done.stdout, re.M), where
        else:
            summary = done.run.summary
            assert summary["status"] == "complete", where
            assert "static" in options or len(summary["figures"]) >= (3 if "dynamic" in options else 1), where
            for name in summary["figures"]:
                assert (done.run.directory / name).read_bytes().startswith(PICTURES), (*where, name)
            assert ("dynamic" in options) == bool(summary.get("statistics")), where
            with h5py.File(done.run.directory / "motion.vtkhdf") as file:
                assert file.attrs["status"] == b"complete" and len(file["VTKHDF/Steps/Values"]) > 0, where
    loose = [done for (verb, options), done in said.items() if verb == "explain" and "--ideal" not in options]
    assert bool(re.search(r"(?m)^\s*\[clearance\.", text)) <= all("joints with clearance" in done.stdout or "ideal" in done.stdout for done in loose)
