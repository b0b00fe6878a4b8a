"""A small part of `make fuzz`: mutants of the decks in both builds, and that a crash would be found."""

import argparse
import os
import pathlib
import re
import shutil
import subprocess

import pytest
from conftest import built, directory_of
from fuzz import Programs, fuzz
from mutants import Mutator

DECKS = 300
LIMIT = 20.0  # seconds for a call on a busy machine
INPUTS = pathlib.Path(__file__).resolve().parent.parent.parent / "inputs"


def chosen(n, first, debug, run):
    """Options of fuzz.py."""
    scratch = "/dev/shm" if os.access("/dev/shm", os.W_OK) else None
    return argparse.Namespace(n=n, first=first, seed=3, jobs=os.cpu_count() or 1, debug=debug, explain=0.25, run=run, limit=LIMIT,
                              keep=None, is_loud=False, scratch=scratch)


@pytest.mark.parametrize("debug", [False, True], ids=["release", "debug"])
def test_mutants_end_well(debug, record_property):
    """Every call on a broken deck has a defined end; most of them are refused, some are good."""
    programs = Programs(directory_of("debug" if debug else "release"), False)
    built(programs.gudgeon)
    built(programs.many)
    classes, counts = fuzz(programs, chosen(DECKS, DECKS * debug, debug, 0.05))
    record_property("counts", dict(counts))
    assert not classes, "\n".join(f"{key}: {calls[0]} {calls[0].name} {calls[0].number}\n{calls[0].text}" for key, calls in classes.items())
    assert counts["check 3"] > DECKS // 4 and counts["check 0"] > DECKS // 20
    assert sum(counts[name] for name in counts if name.startswith("run")) > 0


def test_mutants_follow_from_the_seed():
    """The same seed and number give the same mutant, whatever was made before; others differ."""
    first, second = Mutator(1), Mutator(1)
    second.mutant(7)
    assert first.mutant(5) == second.mutant(5) != first.mutant(6)
    assert Mutator(2).mutant(5) != first.mutant(5)


@pytest.mark.parametrize("script, what", [
    ('read line; echo "begin 1"; kill -SEGV $$', "exit -11"),
    ('read line; echo "begin 1"; echo "end 1 70"; cat > /dev/null', "exit 70"),
    ('read line; echo "begin 1"; sleep 60', "no end"),
])
def test_a_crash_is_found(script, what, tmp_path):
    """A program that falls over, calls itself wrong, or does not end is a finding, for each call on its own."""
    programs = Programs(tmp_path, False)
    programs.many = tmp_path / "many"
    programs.many.write_text(f"#!/bin/sh\n{script}\n")
    programs.many.chmod(0o755)
    options = chosen(2, 0, False, 0.0)
    options.explain, options.limit = 0.0, 0.5
    classes, counts = fuzz(programs, options)
    assert {key[0] for key in classes} >= {what} and sum(counts.values()) >= 2


@pytest.mark.parametrize("option", ["", "--ideal"])
def test_the_echo_of_every_deck_is_a_good_deck(tmp_path, option):
    """Every deck of inputs/, as it was understood, is read again."""
    shutil.copytree(INPUTS, tmp_path / "inputs")
    decks = sorted((tmp_path / "inputs").rglob("*.deck"))
    lines = "".join(f"echo {option} {deck.relative_to(tmp_path)}\n" for deck in decks)
    done = subprocess.run([built(Programs(directory_of("release"), False).many)], input=lines, cwd=tmp_path, capture_output=True, text=True, timeout=10 * LIMIT)
    codes = re.findall(r"^end \d+ (-?\d+)", done.stdout, re.M)
    assert len(codes) == len(decks) > 50
    assert [deck.name for deck, code in zip(decks, codes) if code != "0"] == [], done.stdout
