"""The fuzzer guided by coverage: that it would find what it looks for, with programs that misbehave on purpose."""

import argparse
import os
import stat

import guided
import pytest
from conftest import built, directory_of

END = 'echo "end $n 3 0 10 100"'


def options_for(tmp_path, script):
    """Options of a short search with a shell script in the place of the readers."""
    for place in ("sanitize/tests", "tests"):
        path = tmp_path / place / "many_decks"
        path.parent.mkdir(parents=True)
        path.write_text(f'#!/bin/sh\nn=0\nwhile read reader line; do n=$((n + 1)); echo "begin $n"; {script}; done\n')
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
    os.symlink(built(directory_of("release") / "gudgeon"), tmp_path / "gudgeon")
    return argparse.Namespace(build=tmp_path, seconds=0.5, seed="1", jobs=1, corpus=tmp_path / "corpus", keep=tmp_path / "found",
                              scratch=str(tmp_path), is_loud=False)


@pytest.mark.parametrize("script, what", [
    ("echo 'ERROR: AddressSanitizer: heap-buffer-overflow' >&2; exit 99", "heap-buffer-overflow"),
    ('echo "end $n 70 0 10 100"', "code 70"),
    ('echo "end $n 0 0 10 3000000"', "takes"),
    ('if [ $reader = leaks ]; then echo "end $n 1 0 0 0"; else ' + END + "; fi", "lost memory"),
])
def test_findings_are_found(tmp_path, script, what):
    """A report of a sanitizer, a code that is not documented, a slow deck and lost memory are findings, each kept with its deck."""
    options = options_for(tmp_path, script)
    sorts, counts, _ = guided.fuzz(options)
    assert counts["decks"] > 0
    assert any(what in sort[0] for sort in sorts), sorts
    assert (options.keep / "001.deck").exists() and what in "".join(path.read_text() for path in options.keep.glob("*.txt"))


def test_no_finding_and_news_are_kept(tmp_path):
    """Decks that end well are no findings; those with news are kept, and read again the next time."""
    options = options_for(tmp_path, 'echo "end $n 0 1 10 100"')
    sorts, counts, _ = guided.fuzz(options)
    kept = list(options.corpus.rglob("*.deck"))
    assert not sorts and kept and counts["new"] >= len(kept)
    _, again, _ = guided.fuzz(options)
    assert again["decks"] >= counts["new"]


def test_the_words_are_the_programs(gudgeon):
    """The dictionary knows tables and sections with their keys, units and choices."""
    kinds = {kind.name: kind for kind in guided.kinds_of(gudgeon)}
    assert kinds["contact.hertz"].is_table and not kinds["analysis.dynamic"].is_table
    keys = {key.name: key for key in kinds["analysis.dynamic"].keys}
    assert "dop853" in keys["method"].choices and keys["end"].unit == "s" and keys["end"].is_required
