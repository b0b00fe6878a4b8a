"""Other people's files: a directory is the program's only if its marker says so; only files of the program are ever removed."""

import os
import re
import signal
import shutil
import subprocess
import time

import pytest
from support import Run, answer_signals, call, plain_deck, scratch, written

SHORT = (("analysis.dynamic", "end", "0.2 ms"),)
LONG = (("analysis.dynamic", "end", "5 s"), ("output", "every", "5 us"))
MARKER = ".gudgeon"


@pytest.fixture
def place():
    """A directory with a deck of a short run."""
    directory = scratch()
    written(directory, plain_deck(SHORT))
    return directory


def run(program, place, out="out", expect=0, verb="run"):
    """One short run."""
    return call(program, verb, place / "scene.deck", "--out", place / out, "--quiet", expect=expect)


def snapshot(directory):
    """Every path below a directory, with the content of files."""
    return {
        str(path.relative_to(directory)): path.read_bytes() if path.is_file() else None
        for path in directory.rglob("*")
    }


def started(program, place, out):
    """A long run in the background that has made its run.h5, as its marker says."""
    written(place, plain_deck(LONG), "long.deck")
    process = subprocess.Popen(
        [str(program), "run", str(place / "long.deck"), "--out", str(place / out), "--quiet"],
        stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, preexec_fn=answer_signals,
    )
    limit = time.monotonic() + 30.0
    marker = place / out / MARKER
    while not (marker.exists() and re.search(r"^= .* run\.h5$", marker.read_text(), re.MULTILINE)):
        assert process.poll() is None, process.communicate()[1]
        assert time.monotonic() < limit
        time.sleep(0.02)
    return process


@pytest.mark.parametrize("name", ["summary.txt", "run.h5", "deck.echo", "summary.json", "notes.txt", ".hidden"])
def test_a_directory_without_a_marker_is_refused(gudgeon, place, name):
    """However much a file in it is called like one of ours."""
    (place / "proj").mkdir()
    (place / "proj" / name).write_text("thesis")
    (place / "proj" / "data").mkdir()
    (place / "proj" / "data" / "x.csv").write_text("1,2")
    before = snapshot(place)
    for _ in range(3):
        assert "stays unchanged" in run(gudgeon, place, "proj", expect=9).stderr
        assert snapshot(place) == before


def test_a_lock_beside_is_not_touched(gudgeon, place):
    """poetry.lock belongs to poetry; a link there, too."""
    (place / "poetry.lock").write_text("[[package]]")
    (place / "target").write_text("precious")
    (place / "out.lock").symlink_to(place / "target")
    for name in ("poetry", "out"):
        for _ in range(3):
            run(gudgeon, place, name)
    assert (place / "poetry.lock").read_text() == "[[package]]"
    assert (place / "target").read_text() == "precious" and (place / "out.lock").is_symlink()


@pytest.mark.parametrize("kind", ["link", "dangling", "hard", "text", "directory", "pipe"])
def test_a_foreign_marker_is_not_touched(gudgeon, place, kind):
    """A marker that is a link, someone else's file, or no file at all."""
    (place / "target").write_text("precious")
    (place / "out").mkdir()
    marker = place / "out" / MARKER
    if kind == "link":
        marker.symlink_to(place / "target")
    elif kind == "dangling":
        marker.symlink_to(place / "nothing")
    elif kind == "hard":
        os.link(place / "target", marker)
    elif kind == "text":
        marker.write_text("settings = 1\n")
    elif kind == "directory":
        marker.mkdir()
    else:
        os.mkfifo(marker)
    done = call(gudgeon, "run", place / "scene.deck", "--out", place / "out", "--quiet", expect=9, limit=20)
    assert MARKER in done.stderr
    assert (place / "target").read_text() == "precious" and not (place / "nothing").exists()
    assert os.listdir(place / "out") == [MARKER]
    assert kind != "text" or marker.read_text() == "settings = 1\n"


def test_an_empty_directory_may_be_used(gudgeon, place):
    (place / "out").mkdir(mode=0o750)
    run(gudgeon, place)
    assert (place / "out").stat().st_mode & 0o777 == 0o750
    assert Run(place / "out").summary["status"] == "complete"


def test_a_link_to_a_directory(gudgeon, place):
    """The directory behind the link is used and rotated; the link stays."""
    (place / "disk").mkdir()
    (place / "disk" / "real").mkdir()
    (place / "out").symlink_to(place / "disk" / "real")
    for _ in range(3):
        run(gudgeon, place)
    assert (place / "out").is_symlink()
    assert sorted(os.listdir(place / "disk")) == ["real", "real.1"]
    (place / "lost").symlink_to(place / "nowhere")
    assert "symbolic link" in run(gudgeon, place, "lost", expect=9).stderr
    assert not (place / "nowhere").exists()


def test_an_older_run_that_is_a_link_is_refused(gudgeon, place):
    """out.1 -> other place: neither followed nor removed."""
    run(gudgeon, place)
    run(gudgeon, place, "other")
    (place / "out.1").symlink_to(place / "other")
    before = snapshot(place)
    assert "out.1" in run(gudgeon, place, expect=9).stderr
    assert snapshot(place) == before


def test_foreign_files_move_along_and_are_never_removed(gudgeon, place):
    """Notes in a run's directory: kept with the run, under the next free number when its turn to be removed comes."""
    run(gudgeon, place)
    (place / "out" / "notes.txt").write_text("mine")
    (place / "out" / "more").mkdir()
    (place / "out" / "more" / "a.csv").write_text("1")
    (place / "elsewhere").mkdir()
    (place / "elsewhere" / "slider.dat").write_text("theirs")
    run(gudgeon, place)
    assert (place / "out.1" / "notes.txt").read_text() == "mine"
    done = call(gudgeon, "run", place / "scene.deck", "--out", place / "out")
    assert "was kept as" in done.stdout and "notes.txt" in done.stdout or "more" in done.stdout
    assert (place / "out.2" / "notes.txt").read_text() == "mine" and (place / "out.2" / "more" / "a.csv").read_text() == "1"
    assert Run(place / "out.2").summary["status"] == "complete", "the run is kept with them"
    for _ in range(3):
        run(gudgeon, place)
    assert (place / "out.2" / "notes.txt").read_text() == "mine"
    assert sorted(p.name for p in place.iterdir() if p.is_dir()) == ["elsewhere", "out", "out.1", "out.2"]


def test_links_in_a_directory_are_not_followed(gudgeon, place):
    """A link in place of a file or folder of a run: what it leads to stays as it is."""
    run(gudgeon, place)
    (place / "store").mkdir()
    (place / "store" / "slider.dat").write_text("precious")
    (place / "out" / "slider.dat").unlink()
    (place / "out" / "slider.dat").symlink_to(place / "store" / "slider.dat")
    for _ in range(4):
        run(gudgeon, place)
    assert (place / "store" / "slider.dat").read_text() == "precious"


def test_a_copy_is_not_removed(gudgeon, place):
    """A copy of a run is its maker's, though the marker was copied with it."""
    run(gudgeon, place)
    shutil.copytree(place / "out", place / "out.1")
    run(gudgeon, place)
    assert (place / "out.2" / "run.h5").exists() and (place / "out.1" / "run.h5").exists()


def test_a_run_in_use_is_refused(gudgeon, place):
    """As the directory itself, and as the older run that would have to make room."""
    run(gudgeon, place)
    process = started(gudgeon, place, "out.1")
    try:
        size = (place / "out.1" / "run.h5").stat().st_size
        before = (place / "out" / "run.h5").read_bytes()
        for out in ("out", "out.1"):
            done = run(gudgeon, place, out, expect=9)
            assert "is writing to" in done.stderr and str(process.pid) in done.stderr
        assert process.poll() is None
        assert (place / "out.1" / "run.h5").stat().st_size >= size and (place / "out" / "run.h5").read_bytes() == before
        assert not (place / "out.1.1").exists() and not (place / "out.2").exists()
    finally:
        process.kill()
        process.wait()
    run(gudgeon, place)


def test_a_run_within_a_directory_is_in_use(gudgeon, place):
    """A directory with a run going on in a part of it is not moved."""
    run(gudgeon, place)
    process = started(gudgeon, place, "out/part")
    try:
        assert "out/part" in run(gudgeon, place, expect=9).stderr
        assert process.poll() is None and not (place / "out.1").exists()
    finally:
        process.kill()
        process.wait()


def test_many_at_once(gudgeon, place):
    """Eight runs into one directory at the same time: some are refused, what is there is whole, nothing else is left."""
    deck = written(place, plain_deck((("analysis.dynamic", "end", "2 ms"),)), "some.deck")
    for _ in range(3):
        processes = [
            subprocess.Popen([str(gudgeon), "run", str(deck), "--out", str(place / "out"), "--quiet"],
                             stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            for _ in range(8)
        ]
        errors = [process.communicate(timeout=120)[1] for process in processes]
        codes = [process.returncode for process in processes]
        assert set(codes) <= {0, 9} and 0 in codes, errors
        assert all("is writing to" in error for code, error in zip(codes, errors) if code == 9), errors
    found = [path for path in place.iterdir() if path.is_dir()]
    assert {path.name for path in found} <= {"out", "out.1"}
    for path in found:
        run_there = Run(path)
        assert run_there.summary["status"] == "complete" and run_there.time[-1] == pytest.approx(2e-3)
        named = (path / MARKER).read_text().split("files:\n")[1].splitlines()
        assert named[-1] == "ended" and set(os.listdir(path)) - {MARKER} <= set(named)


def test_the_marker_names_what_was_made(gudgeon, place):
    """Every file of a run with figures and of a sweep, so that all of them go when their turn comes."""
    text = plain_deck(SHORT) + "\n[statistics]\nchannels = motor.moment\n"
    text = text.replace("[output]", "[output]\nfigures = slider.velocity histogram(gudgeon.impact_speed)", 1)
    written(place, text)
    run(gudgeon, place)
    named = (place / "out" / MARKER).read_text().split("files:\n")[1].splitlines()
    found = {name + "/" * (content is None) for name, content in snapshot(place / "out").items()}
    assert found - {MARKER} <= set(named) and "figures/slider.velocity.png" in found
    for _ in range(2):
        run(gudgeon, place)
    for c in (0.2, 0.3, 0.4):  # the same sweep would go on in its directory
        written(place, text + f"\n[sweep]\nc = 0.5 {c} mm\n")
        run(gudgeon, place, "swept", verb="sweep")
    assert sorted(p.name for p in place.iterdir()) == ["out", "out.1", "scene.deck", "swept", "swept.1"]


@pytest.mark.parametrize("ended", (True, False))
def test_a_forged_marker_removes_nothing(gudgeon, place, ended):
    """A marker that names a file beside it, which no run made: with what is in it the directory is kept under another number."""
    run(gudgeon, place)
    marker = place / "out" / MARKER
    text = marker.read_text()
    marker.write_text(text.replace("\nended", "\nthesis.txt" + ("\n= 1 4 thesis.txt" if ended else "") + "\nended"*ended))
    (place / "out" / "thesis.txt").write_text("mine")
    for _ in range(3):
        run(gudgeon, place)
    assert (place / "out.2" / "thesis.txt").read_text() == "mine"


def test_a_file_in_the_place_of_another_is_not_removed(gudgeon, place):
    """A summary that someone wrote anew, or that has grown since, is not the one that the run made."""
    for number, change in ((2, lambda path: (path.unlink(), path.write_text("mine"))), (3, lambda path: path.open("a").write("mine"))):
        run(gudgeon, place)
        change(place / "out" / "summary.txt")
        run(gudgeon, place)
        run(gudgeon, place)
        assert (place / f"out.{number}" / "summary.txt").read_text().endswith("mine")


def test_failed_runs_of_a_sweep_go_with_it(gudgeon, place):
    """Directories of failed runs are the sweep's; notes among them are not."""

    def swept(c):  # the same sweep would go on in its directory
        written(place, plain_deck(SHORT) + f"\n[sweep]\nc = {c} 20 mm\n")
        run(gudgeon, place, verb="sweep", expect=8)

    swept(0.5)
    assert (place / "out" / "runs" / "2.log").exists()
    swept(0.4)
    (place / "out" / "runs" / "why.txt").write_text("mine")
    swept(0.3)
    assert not (place / "out.2").exists()
    swept(0.2)
    assert (place / "out.2" / "runs" / "why.txt").read_text() == "mine"


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM, signal.SIGINT])
def test_the_files_of_a_killed_run_go_like_others(gudgeon, place, number):
    """What a killed or stopped run left is named in its marker: it becomes NAME.1 and is removed after that."""
    process = started(gudgeon, place, "out")
    process.send_signal(number)
    stopped = process.wait() == 7
    assert stopped == (number != signal.SIGKILL) == ((place / "out" / "checkpoint.h5").exists())
    assert stopped == ("ended" in (place / "out" / MARKER).read_text().splitlines())
    run(gudgeon, place)
    assert (place / "out.1" / "run.h5").exists()
    run(gudgeon, place)
    run(gudgeon, place)
    assert sorted(p.name for p in place.iterdir() if p.is_dir()) == ["out", "out.1"]


@pytest.mark.skipif(os.geteuid() == 0 and not os.path.exists("/proc/sys"), reason="needs a place that cannot be written")
def test_a_directory_that_cannot_be_written(gudgeon, place):
    """Exit 9 that names it: a read-only file system, or a directory without rights."""
    closed = "/proc/sys/out" if os.geteuid() == 0 else str(place / "closed" / "out")
    (place / "closed").mkdir(mode=0o555)
    done = call(gudgeon, "run", place / "scene.deck", "--out", closed, "--quiet", expect=9)
    assert closed in done.stderr


SHIM = r"""
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>
static void note(const char *what, const char *path)
{
   FILE *log = getenv("SHIM_LOG") ? fopen(getenv("SHIM_LOG"), "ae") : NULL;
   if (log != NULL) { fprintf(log, "%s %s\n", what, path); fclose(log); }
}
int fsync(int file)
{
   char link[64], path[4096];
   snprintf(link, sizeof link, "/proc/self/fd/%d", file);
   ssize_t n = readlink(link, path, sizeof path - 1);
   path[n > 0 ? n : 0] = '\0';
   note("fsync", path);
   return 0;
}
int rename(const char *from, const char *to)
{
   note("rename", from);
   return ((int (*)(const char *, const char *))dlsym(RTLD_NEXT, "rename"))(from, to);
}
int flock(int file, int how)
{
   if (getenv("SHIM_NO_LOCKS") == NULL) return ((int (*)(int, int))dlsym(RTLD_NEXT, "flock"))(file, how);
   errno = ENOLCK;
   return -1;
}
"""


@pytest.fixture
def shim(place):
    """The environment of a program whose calls of fsync and rename are listed, and which may be without locks."""
    source = written(place, SHIM, "shim.c")
    library = place / "shim.so"
    made = subprocess.run([os.environ.get("CC", "gcc"), "-shared", "-fPIC", "-o", library, source, "-ldl"], capture_output=True)
    if made.returncode != 0:
        pytest.skip("no C compiler that makes a shared library")
    return {**os.environ, "LD_PRELOAD": str(library), "SHIM_LOG": str(place / "calls")}


@pytest.mark.parametrize("verb", ["run", "sweep"])
def test_a_file_is_on_the_disk_before_it_is_renamed(gudgeon, place, shim, verb):
    """And the directory after it; run.h5 before the summaries."""
    written(place, plain_deck(SHORT) + "\n[sweep]\nc = 0.5 0.2 mm\n")
    subprocess.run([str(gudgeon), verb, str(place / "scene.deck"), "--out", str(place / "out"), "--quiet"],
                   env=shim, check=True, timeout=60)
    calls = [line.split(" ", 1) for line in (place / "calls").read_text().splitlines()]
    calls = [(what, path) for what, path in calls if "/runs/" not in path]
    renamed = [k for k, (what, _) in enumerate(calls) if what == "rename"]
    assert len(renamed) >= 2
    for k in renamed:
        assert calls[k - 1] == ("fsync", calls[k][1]) and calls[k + 1] == ("fsync", str(place / "out"))
    paths = [path for _, path in calls]
    if verb == "run":
        assert paths.index(str(place / "out" / "run.h5")) < paths.index(str(place / "out" / "summary.txt.part"))


def test_without_locks_the_marker_counts(gudgeon, place, shim):
    """A file system without locks: a run that lives is respected, one that is dead or done is not, one on another machine is."""
    env = {**shim, "SHIM_NO_LOCKS": "1"}

    def again():
        return subprocess.run([str(gudgeon), "run", str(place / "scene.deck"), "--out", str(place / "out"), "--quiet"],
                              env=env, capture_output=True, text=True, timeout=60)

    process = started(gudgeon, place, "out")
    try:
        refused = again()
        assert refused.returncode == 9 and str(process.pid) in refused.stderr
    finally:
        process.kill()
        process.wait()
    assert again().returncode == 0 and again().returncode == 0
    marker = place / "out" / MARKER
    marker.write_text(marker.read_text().replace("host = ", "host = other").replace("\nended", ""))
    refused = again()
    assert refused.returncode == 9 and "on other" in refused.stderr
