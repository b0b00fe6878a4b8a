"""What stands around the program: gnuplot, pipes, limits, closed descriptors. Every case has a defined end."""

import json
import os
import pathlib
import re
import resource
import shutil
import signal
import subprocess
import time

import pytest
from support import DECK, Run, answer_signals, call, changed, cost, made, plain_deck, scratch, written

SHORT = (("analysis.dynamic", "end", "0.2 ms"),)


@pytest.fixture
def place():
    """A directory with a deck of a short run without figures and one with two."""
    directory = scratch()
    written(directory, plain_deck(SHORT))
    written(directory, changed(plain_deck(SHORT), "output", figures="slider.velocity gudgeon.orbit"), "figures.deck")
    return directory


def execute(program, *arguments, limit=60, **how):
    """Run the program in odd surroundings; it must end by itself, and not by a signal."""
    how = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, **how}
    done = subprocess.run([str(program), *map(str, arguments)], timeout=limit, **how)
    assert done.returncode >= 0, done
    return done


def gnuplot(place, script):
    """An environment in which gnuplot is this shell script."""
    folder = place / "bin"
    folder.mkdir()
    written(folder, "#!/bin/sh\n" + script, "gnuplot").chmod(0o755)
    return {**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}


def alive(word):
    """Numbers of processes with a word in their command line."""
    found = []
    for number in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{number}/cmdline", "rb") as file:
                line = file.read().decode(errors="replace")
            with open(f"/proc/{number}/stat", encoding="utf-8") as file:
                state = file.read().rsplit(")", 1)[1].split()[0]
        except OSError:
            continue
        if word in line and state != "Z" and int(number) != os.getpid():
            found.append(int(number))
    return found


def gone(word):
    """Whether no such process is left, after a moment at most."""
    for _ in range(60):
        if not alive(word):
            return True
        time.sleep(0.05)
    return False


# ---- gnuplot


@pytest.mark.parametrize("trap", ["", "trap '' TERM INT HUP\n"])
def test_gnuplot_that_hangs(gudgeon, place, trap):
    """It is ended with all that it started, also if it takes no notice of TERM; the run says so and is complete."""
    length = "100" + str(os.getpid()) + str(len(trap))
    env = gnuplot(place, f"{trap}sleep {length} &\nwhile :; do sleep {length}; done\n")
    begin = time.monotonic()
    done = execute(gudgeon, "run", place / "figures.deck", "--out", place / "out",
                   env={**env, "GUDGEON_GNUPLOT_SECONDS": "1"})
    assert done.returncode == 0 and time.monotonic() - begin < 20
    summary = Run(place / "out").summary
    assert summary["status"] == "complete" and summary["figures"] == []
    assert sum("gnuplot exceeded 1 s and was killed" in warning for warning in summary["warnings"]) == 2
    assert b"GUDGEON_GNUPLOT_SECONDS" in done.stdout
    assert gone(f"sleep {length}".replace(" ", "\0"))


def test_no_more_figures_once_gnuplot_hangs(gudgeon, place):
    """Nine figures take as long as the first four."""
    env = gnuplot(place, "exec sleep 1000\n")
    names = " ".join(f"{item}.{what}" for item in ("slider", "crank", "rod") for what in ("position", "velocity", "acceleration"))
    text = changed(changed(plain_deck(SHORT), "output", channels="*"), "output", figures=names)
    begin = time.monotonic()
    execute(gudgeon, "run", written(place, text), "--out", place / "out", env={**env, "GUDGEON_GNUPLOT_SECONDS": "2"})
    assert time.monotonic() - begin < 8
    warnings = Run(place / "out").summary["warnings"]
    assert any("5 further figures" in warning for warning in warnings), warnings


def test_one_gnuplot_draws_several_pictures(gudgeon, place):
    """It is started once for both; where it brings about only the first, the second is drawn by one of its own."""
    real = shutil.which("gnuplot")
    for script, starts in ((f'echo "$@" >> {place}/calls\nexec {real} "$@"\n', 1),
                           (f'echo "$@" >> {place}/calls\nexec {real} "$1" "$2"\n', 2)):
        shutil.rmtree(place / "bin", ignore_errors=True)
        (place / "calls").unlink(missing_ok=True)
        env = gnuplot(place, script)
        execute(gudgeon, "run", place / "figures.deck", "--out", place / "out", env=env)
        summary = Run(place / "out").summary
        assert summary["figures"] == ["figures/slider.velocity.png", "figures/gudgeon.orbit.png"] and summary["warnings"] == []
        calls = (place / "calls").read_text().splitlines()
        assert len(calls) == starts and calls[0].split()[1:] == ["./slider.velocity.gp", "./gudgeon.orbit.gp"]
        assert not list((place / "out").rglob("*.log"))


@pytest.mark.parametrize("script, words", [
    ("exit 0\n", "wrote an incomplete picture"),
    (": > ${2%.gp}.png\n", "wrote an incomplete picture"),
    ("printf '\\211PNG\\r\\n\\032\\nhalf of it' > ${2%.gp}.png\n", "wrote an incomplete picture"),
    ("echo no fonts >&2\nexit 3\n", "failed with exit code 3,"),
    ("kill -SEGV $$\n", "failed with exit code 139,"),
])
def test_gnuplot_that_fails(gudgeon, place, script, words):
    """No picture, half of one, or a failure: not reported as a figure."""
    env = gnuplot(place, script)
    done = execute(gudgeon, "run", place / "figures.deck", "--out", place / "out", env=env)
    assert done.returncode == 0 and words in done.stdout.decode()
    summary = Run(place / "out").summary
    assert summary["figures"] == [] and len([w for w in summary["warnings"] if words in w]) == 2
    assert not list((place / "out").rglob("*.png"))


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP, signal.SIGKILL])
def test_gnuplot_ends_with_the_run(gudgeon, place, number):
    """A run that is killed while gnuplot draws leaves no gnuplot, even one that ignores TERM; its numbers are readable."""
    length = "200" + str(os.getpid()) + str(int(number))
    env = gnuplot(place, f"trap '' TERM INT HUP\nexec sleep {length}\n")
    process = subprocess.Popen([str(gudgeon), "run", str(place / "figures.deck"), "--out", str(place / "out"), "--quiet"], env=env,
                               preexec_fn=answer_signals)
    word = f"sleep\0{length}"
    for _ in range(400):
        if alive(word):
            break
        time.sleep(0.05)
    assert len(alive(word)) == 1
    process.send_signal(number)
    assert process.wait(timeout=20) == -number
    assert gone(word)
    run = Run(place / "out")
    assert run.time[-1] == pytest.approx(2e-4)
    assert run.summary["status"] == "complete" and "ended before its figures were drawn" in " ".join(run.summary["warnings"])
    call(gudgeon, "run", place / "scene.deck", "--out", place / "out", "--quiet")


@pytest.mark.parametrize("number", [signal.SIGTERM, signal.SIGINT, signal.SIGHUP])
@pytest.mark.parametrize("is_ignored", [False, True])
def test_signals_end_a_run_that_does_not_ignore_them(gudgeon, place, number, is_ignored):
    """Whatever a library makes of a signal as it is loaded: it ends a run, or the run was begun without it (nohup) and goes on."""
    deck = written(place, plain_deck((("analysis.dynamic", "end", "60 s"), ("output", "every", "10 us"))), "long.deck")
    process = subprocess.Popen([str(gudgeon), "run", str(deck), "--out", str(place / "out"), "--quiet"],
                               preexec_fn=lambda: signal.signal(number, signal.SIG_IGN if is_ignored else signal.SIG_DFL))
    try:
        for _ in range(400):
            if (place / "out" / "run.h5").exists():
                break
            time.sleep(0.05)
        process.send_signal(number)
        if is_ignored:
            time.sleep(0.3)
            assert process.poll() is None
        else:
            assert process.wait(timeout=20) == 7
            assert Run(place / "out").summary["status"] == "stopped"
    finally:
        process.kill()
        process.wait()


def test_a_wrong_patience_is_said(gudgeon, place):
    done = execute(gudgeon, "run", place / "figures.deck", "--out", place / "out",
                   env={**os.environ, "GUDGEON_GNUPLOT_SECONDS": "soon"})
    assert b"GUDGEON_GNUPLOT_SECONDS is not a number" in done.stdout
    assert len(Run(place / "out").summary["figures"]) == 2


# ---- readers that go away, full and limited files


def closed_pipe():
    """The end of a pipe that nobody reads."""
    reading, writing = os.pipe()
    os.close(reading)
    return writing


@pytest.mark.parametrize("arguments", [("list",), ("help",), ("help", "--manual"), ("explain", DECK), ("version",)])
def test_a_reader_that_has_seen_enough(gudgeon, arguments):
    """`gudgeon list | head -1` ends quietly."""
    pipe = closed_pipe()
    try:
        done = execute(gudgeon, *arguments, stdout=pipe)
    finally:
        os.close(pipe)
    assert (done.returncode, done.stderr) == (0, b"")


@pytest.mark.parametrize("verb, options", [("run", ()), ("run", ("--json",)), ("sweep", ())])
@pytest.mark.parametrize("streams", [("stdout",), ("stderr",), ("stdout", "stderr")])
def test_a_log_reader_that_goes_away(gudgeon, place, verb, options, streams):
    """The run goes on and saves its results; its exit code is its own."""
    deck = place / "scene.deck"
    if verb == "sweep":
        deck = written(place, plain_deck(SHORT) + "\n[sweep]\nc = 0.5 0.2 mm\n")
    pipe = closed_pipe()
    try:
        done = execute(gudgeon, verb, deck, "--out", place / "out", *options, **dict.fromkeys(streams, pipe))
    finally:
        os.close(pipe)
    assert done.returncode == 0
    assert json.loads((place / "out" / "summary.json").read_text())["status"] == "complete"


def test_an_error_that_nobody_reads(gudgeon, place):
    """The exit code still tells."""
    pipe = closed_pipe()
    try:
        assert execute(gudgeon, "run", place / "nothing.deck", stderr=pipe).returncode == 3
    finally:
        os.close(pipe)


def limited(what, amount):
    """For a child: its limit of a resource."""
    return lambda: resource.setrlimit(what, (amount, amount))


@pytest.mark.parametrize("kilobytes", [0, 1, 8, 64, 128, 200, 256, 320, 400, 540, 600, 700, 850, 1000, 1500])
def test_files_that_may_not_grow(gudgeon, place, kilobytes):
    """`ulimit -f`: exit code 9 with a message; run.h5 has the rows that the message tells of, or is not there."""
    text = plain_deck((("analysis.dynamic", "end", "60 ms"), ("output", "every", "5 us")))
    done = execute(gudgeon, "run", written(place, text), "--out", place / "out", "--quiet",
                   preexec_fn=limited(resource.RLIMIT_FSIZE, 1024 * kilobytes))
    assert done.returncode == 9 and b"error: cannot" in done.stderr, done
    told = re.search(rb"run.h5: .*saved and readable: \d+ rows up to t = ([0-9.e-]+) s", done.stderr)
    assert told or kilobytes < 540 or b".dat: File too large" in done.stderr, done
    if (place / "out" / "run.h5").exists():
        assert Run(place / "out").time[-1] >= (float(told[1]) - 5e-6 if told else 5e-3)
    else:
        assert kilobytes < 540, done
    call(gudgeon, "run", place / "scene.deck", "--out", place / "out", "--quiet")


def test_a_sweep_whose_files_may_not_grow(gudgeon, place):
    deck = written(place, plain_deck(SHORT) + "\n[sweep]\nc = 0.5 0.2 mm\n")
    for kilobytes in (0, 2, 8):
        done = execute(gudgeon, "sweep", deck, "--out", place / "out", "--quiet",
                       preexec_fn=limited(resource.RLIMIT_FSIZE, 1024 * kilobytes))
        assert done.returncode in (8, 9) and b"error: " in done.stderr, done
    call(gudgeon, "sweep", deck, "--out", place / "out", "--quiet")


def least_room(gudgeon):
    """Least address space with which the program begins [MB]: the libraries of each system take their own part."""
    return next(megabytes for megabytes in range(100, 1000, 4)
                if not execute(gudgeon, "version", preexec_fn=limited(resource.RLIMIT_AS, megabytes << 20)).returncode)


@pytest.mark.parametrize("verb", ["version", "run"])
def test_little_address_space(gudgeon, place, verb):
    """`ulimit -v`: the run is done or says that there is no memory, but never waits for it. (What is less than the libraries
    take, or what OpenBLAS needs to start a thread, ends before the program begins, with code 127 or by OpenBLAS's signal.)"""
    arguments = ("version",) if verb == "version" else ("run", place / "scene.deck", "--out", place / "out", "--quiet")
    codes = []
    env = {name: value for name, value in os.environ.items() if name != "OPENBLAS_NUM_THREADS"}
    for megabytes in range(60, 700, 40):
        how = {"env": env, "preexec_fn": limited(resource.RLIMIT_AS, megabytes << 20)}
        done = subprocess.run([str(gudgeon), *map(str, arguments)], timeout=60, stdin=subprocess.DEVNULL, capture_output=True, **how)
        codes.append(done.returncode)
        assert done.returncode in (0, 9, 127, -signal.SIGINT), (megabytes, done)
        if done.returncode == 9:
            assert b"memory" in done.stderr, done
    assert 9 in codes and codes[-1] == 0, codes


def test_memory_that_runs_out_in_the_run(gudgeon, place):
    """Exit code 9 wherever it happens, not the run-time library's 1, which means `compared and found different`."""
    deck = written(place, made("pendulum", 3000, "--end", 0.001, "--every", 0.001))
    codes, said = [], []
    least = least_room(gudgeon)
    for megabytes in range(least, least + 84, 7):
        done = execute(gudgeon, "run", deck, "--out", place / "out", "--quiet", limit=120,
                       preexec_fn=limited(resource.RLIMIT_AS, megabytes << 20))
        codes.append(done.returncode)
        assert done.returncode in (0, 9), (megabytes, done)
        if done.returncode == 9:
            said.append(done.stderr.decode(errors="replace").splitlines()[-1])
    assert codes.count(9) >= 3, codes
    named = [re.search(r"was needed for the (deck|equations of 3000 bodies|start of 3000 bodies|motion|rows)", words) for words in said]
    assert all("memory" in words for words in said) and sum(map(bool, named)) >= 3, said


def test_memory_that_ends_with_the_events(gudgeon, place):
    """A list of events that outgrows the memory ends the run with the number of events, and keeps what was written. The limit is set in
    the midst of the run, a little above what it has then: loading the program takes more for a moment."""
    deck = written(place, plain_deck((("analysis.dynamic", "end", "600 s"), ("output", "every", "1 ms"), ("output", "contact_rows", "off"))))
    process = subprocess.Popen([str(gudgeon), "run", str(deck), "--out", str(place / "out"), "--quiet"],
                               stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE)
    path = place / "out" / "run.h5"
    try:
        while not path.exists() or path.stat().st_size < 200_000:
            assert process.poll() is None, process.stderr.read()
            time.sleep(0.01)
        room = 1024 * int(re.search(r"VmSize:\s+(\d+) kB", pathlib.Path(f"/proc/{process.pid}/status").read_text()).group(1)) + 2**18
        resource.prlimit(process.pid, resource.RLIMIT_AS, (room, room))
        told = process.communicate(timeout=300)[1]
    finally:
        process.kill()
        process.wait()
    assert process.returncode == 9 and b"memory" in told and (b"events" in told or b"motion" in told), told
    assert len(Run(place / "out").time) > 100


def most_memory(gudgeon, place, end):
    """Greatest memory of a run [MB], and its contacts: statistics, all rows and four figures, drawn by a program that takes none."""
    text = plain_deck((("analysis.dynamic", "end", end), ("output", "every", "10 ms"), ("output", "figures",
        "slider.velocity motor.moment gudgeon.orbit portrait(slider.velocity.x,slider.acceleration.x)")))
    deck = written(place, text + "\n[statistics]\nafter = 24 ms\nperiod = 1 turns of motor\nchannels = motor.moment gudgeon.force\n")
    memory = cost([gudgeon, "run", deck, "--quiet", "--out", place / "out"], gnuplot(scratch(), "exit 0\n"))[1]
    return memory, Run(place / "out").summary["contacts"]


def test_memory_grows_by_little_with_the_contacts(gudgeon, place):
    """Ten times the contacts: each takes its event (84 bytes), its place in the order of the events and its part of the indices of run.h5;
    neither text nor rows of figures stay."""
    (few, n_few), (many, n_many) = (most_memory(gudgeon, place, end) for end in ("0.5 s", "5 s"))
    assert n_many > 8 * n_few > 3200
    assert 1048576 * (many - few) <= 400 * (n_many - n_few), f"{few} MB, {many} MB, {n_few} and {n_many} contacts"


# ---- descriptors


@pytest.mark.parametrize("closed", [(0,), (1,), (2,), (0, 1), (0, 2), (1, 2), (0, 1, 2)])
def test_closed_descriptors(gudgeon, place, closed):
    """No file of the run gets the number of one of them, so nothing that is printed lands in a file."""
    reference = place / "reference"
    call(gudgeon, "run", place / "figures.deck", "--out", reference)
    words = " ".join(f"{number}>&-" if number else "<&-" for number in closed)
    command = f"exec {gudgeon} run {place}/figures.deck --out {place}/out {words}"
    done = subprocess.run(["/bin/sh", "-c", command], timeout=60, capture_output=True)
    assert done.returncode == 0
    names = {str(p.relative_to(reference)) for p in reference.rglob("*")}
    assert {str(p.relative_to(place / "out")) for p in (place / "out").rglob("*")} == names
    for name in ("slider.dat", "events.dat", "deck.echo"):
        assert (place / "out" / name).read_bytes() == (reference / name).read_bytes(), name
    marker = (place / "out" / ".gudgeon").read_text()
    assert marker.startswith("gudgeon output") and "status" not in marker and len(marker) < 2000


def test_no_home_no_temporary_directory(gudgeon, place):
    """Neither is needed, by the program or by its figures."""
    env = {"PATH": os.environ["PATH"]}
    execute(gudgeon, "run", place / "figures.deck", "--out", place / "out", env=env)
    assert len(Run(place / "out").summary["figures"]) == 2


# ---- decks that are no files


def test_a_deck_from_a_pipe(gudgeon, place):
    """As standard input and as a process substitution: read to its end, stored as it was, the same numbers."""
    text = plain_deck(SHORT)
    call(gudgeon, "run", place / "scene.deck", "--out", place / "file", "--quiet")
    done = subprocess.run([str(gudgeon), "run", "/dev/stdin", "--quiet"], input=text.encode(), cwd=place, capture_output=True, timeout=60)
    assert done.returncode == 0, done
    out = place / "outputs" / "stdin"
    assert Run(out).read("deck") == text
    assert (out / "slider.dat").read_text().split("\n", 3)[3] == (place / "file" / "slider.dat").read_text().split("\n", 3)[3]
    command = f"{gudgeon} run <(sleep 0.3; head -c 700 scene.deck; sleep 0.3; tail -c +701 scene.deck) --out sub --quiet"
    done = subprocess.run(["bash", "-c", command], cwd=place, capture_output=True, timeout=60)
    assert done.returncode == 0 and Run(place / "sub").read("deck") == text, done


def test_mistakes_in_a_deck_from_a_pipe(gudgeon, place):
    """Shown like those of a file; what it includes is looked for in the current directory."""
    done = subprocess.run([str(gudgeon), "check", "/dev/stdin"], input=b"deck = 1\nbody\n", capture_output=True, timeout=60)
    assert done.returncode == 3 and b"/dev/stdin:2" in done.stderr
    done = subprocess.run([str(gudgeon), "check", "/dev/stdin"], input=b'deck = 1\ninclude "scene.deck"\n', cwd=place,
                          capture_output=True, timeout=60)
    assert done.returncode == 0, done
    done = subprocess.run([str(gudgeon), "run", "/dev/stdin"], input=b"", capture_output=True, timeout=60)
    assert done.returncode == 3 and b"it is empty" in done.stderr


def test_a_sweep_takes_a_pipe(gudgeon, place):
    """Its deck is read once."""
    text = plain_deck(SHORT) + "\n[sweep]\nc = 0.5 0.2 mm\n"
    done = subprocess.run([str(gudgeon), "sweep", "/dev/stdin"], input=text.encode(), cwd=place, capture_output=True, timeout=60)
    assert done.returncode == 0 and (place / "outputs/stdin/sweep.h5").exists(), done


@pytest.mark.parametrize("kind, words", [
    ("pipe", "a pipe or a device"), ("directory", "it is a directory"), ("/dev/zero", "a pipe or a device"),
    ("/dev/null", "a pipe or a device"), ("missing", "no such file"),
])
def test_includes_that_are_no_files(gudgeon, place, kind, words):
    """Nothing is waited for; also for a table of samples."""
    if kind == "pipe":
        os.mkfifo(place / "pipe")
    elif kind == "directory":
        (place / "directory").mkdir()
    deck = written(place, f'deck = 1\ninclude "{kind}"\n')
    done = call(gudgeon, "check", deck, expect=3, limit=20)
    assert words in done.stderr and ":2:9" in done.stderr, done.stderr


@pytest.mark.parametrize("path, words", [
    ("/dev/zero", "it is too large"), ("/dev/null", "it is empty"), ("/tmp", "it is a directory"), ("/proc/self/mem", "rror"),
])
def test_decks_that_are_none(gudgeon, path, words):
    assert words in call(gudgeon, "check", path, expect=3, limit=60).stderr
