"""What the end-to-end tests share: running the program, changing decks, reading what a run leaves behind."""

import atexit
import functools
import itertools
import json
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
DECK = ROOT / "inputs" / "slider_crank_dry.deck"
SLOWNESS = 12 if os.environ.get("GUDGEON_SANITIZED") == "yes" else 1  # of the program, built without optimisation and with checks
LIMIT = 600 if SLOWNESS > 1 else 120  # seconds for one command

_scratch = pathlib.Path(tempfile.mkdtemp(prefix="gudgeon_e2e_"))
atexit.register(shutil.rmtree, _scratch, ignore_errors=True)
_numbers = itertools.count(1)


def scratch():
    """A fresh directory that goes away with the tests."""
    directory = _scratch / f"{next(_numbers):03d}"
    directory.mkdir()
    return directory


def call(program, *arguments, expect=0, cwd=None, limit=LIMIT):
    """Run the program; its exit code must be `expect`, a number or several; None takes any that the program documents."""
    command = [str(program), *map(str, arguments)]
    done = subprocess.run(
        command, capture_output=True, text=True, errors="replace", cwd=cwd, timeout=limit, stdin=subprocess.DEVNULL
    )
    wanted = (expect,) if isinstance(expect, int) else expect
    assert wanted is None or done.returncode in wanted, (
        f"exit code {done.returncode}, not {expect}: {' '.join(command)}\n{done.stdout[-3000:]}\n{done.stderr[-3000:]}"
    )
    return done


# A process that has hardly anything loaded: what the one that starts another has in memory counts as that one's too.
STARTER = """
import os, sys
away = [(os.POSIX_SPAWN_OPEN, n, os.devnull, os.O_WRONLY, 0) for n in (1, 2)]
_, status, used = os.wait4(os.posix_spawn(sys.argv[1], sys.argv[1:], os.environ, file_actions=away), 0)
print(status, used.ru_utime + used.ru_stime, used.ru_maxrss)
"""


def cost(command, env=None):
    """Processor time [s] and greatest memory [MB] of a process and those that it starts; it must succeed."""
    told = subprocess.run([sys.executable, "-I", "-S", "-c", STARTER, *map(str, command)], capture_output=True, text=True, check=True, env=env)
    status, seconds, kilobytes = told.stdout.split()
    assert status == "0", f"{' '.join(map(str, command))} ended with status {status}"
    return float(seconds), float(kilobytes) / 1024


def answer_signals():
    """For a child that is about to become the program: signals end it, also where whoever began the tests ignores them (nohup, a job in the background)."""
    for number in (signal.SIGHUP, signal.SIGINT, signal.SIGTERM, signal.SIGUSR1):
        signal.signal(number, signal.SIG_DFL)


def changed(text, section, **settings):
    """A deck's text with settings of one section given other values, added, or (None) taken out."""
    lines = text.splitlines()
    start = next(i for i, line in enumerate(lines) if re.match(rf"\s*\[{re.escape(section)}\]", line))
    for key, value in settings.items():
        end = next((i for i in range(start + 1, len(lines)) if lines[i].lstrip().startswith("[")), len(lines))
        at = next((i for i in range(start + 1, end) if re.match(rf"\s*{re.escape(key)}\s*=", lines[i])), None)
        new = [] if value is None else [f"{key} = {value}"]
        if at is None:
            lines[start + 1 : start + 1] = new
        else:
            lines[at : at + 1] = new
    return "\n".join(lines) + "\n"


def text_of(path):
    """A deck's text with everything that it includes."""
    lines = []
    for line in path.read_text().splitlines():
        included = re.match(r'\s*include\s+"([^"]+)"', line)
        lines.append(text_of(path.parent / included.group(1)) if included else line)
    return "\n".join(lines)


def plain_deck(changes=(), text=None):
    """The dry slider-crank without figures, and with changes (section, key, value)."""
    text = changed(text or DECK.read_text(), "output", figures=None)
    for section, key, value in changes:
        text = changed(text, section, **{key: value})
    return text


def written(directory, text, name="scene.deck"):
    """A deck's text as a file."""
    path = pathlib.Path(directory) / name
    path.write_text(text)
    return path


def made(*arguments):
    """What scripts/make_chain writes."""
    done = subprocess.run(
        [sys.executable, "-B", ROOT / "scripts" / "make_chain", *map(str, arguments)], capture_output=True, text=True, check=True
    )
    return done.stdout


def plain(value):
    """A value of an HDF5 file with its texts as str."""
    if isinstance(value, bytes):
        return value.decode()
    if isinstance(value, np.ndarray) and value.dtype.kind in "SO":
        return np.array([plain(v) for v in value.ravel()], dtype=str).reshape(value.shape)
    return value


def is_history(dataset):
    """Whether the first dimension of a dataset is /time."""
    return dataset.ndim > 0 and len(dataset.dims[0]) > 0 and dataset.dims[0][0].name == "/time"


def at_instants(file, path):
    """A dataset of run.h5; of a time history, the rows that are output instants. The time grows last: what a killed run left beyond it is
    no row."""
    dataset = file[path]
    if path != "time" and not is_history(dataset):
        return dataset[()]
    n = len(file["time"])
    return dataset[:n][file["row_kind"][:n] == 0]


class Run:
    """What a run left behind."""

    def __init__(self, directory, done=None):
        self.directory = pathlib.Path(directory)
        self.done = done

    @functools.cached_property
    def summary(self):
        """summary.json."""
        return json.loads((self.directory / "summary.json").read_text())

    def read(self, path):
        """A dataset of run.h5; of a time history, the output instants."""
        with h5py.File(self.directory / "run.h5", "r") as file:
            return plain(at_instants(file, path.strip("/")))

    def rows(self, path):
        """A time history of run.h5 with all its rows, those at contacts too."""
        with h5py.File(self.directory / "run.h5", "r") as file:
            return plain(file[path][()])

    def group(self, path):
        """All datasets of a group, by name; of time histories, the output instants."""
        with h5py.File(self.directory / "run.h5", "r") as file:
            return {name: plain(at_instants(file, f"{path.strip('/')}/{name}")) for name in file[path]}

    def item(self, path, name):
        """The part of a dataset (n, items, ...) that belongs to one item by name."""
        names = [str(n).strip() for n in self.read(path.rsplit("/", 1)[0] + "/names")]
        return self.read(path)[:, names.index(name)]

    @functools.cached_property
    def time(self):
        """The output instants."""
        return self.read("time")

    @functools.cached_property
    def contacts(self):
        """The contact events of run.h5 in order of their onsets: a structured array."""
        events = self.read("events")
        events = events[[plain(kind).strip() == "contact" for kind in events["kind"]]]
        return events[np.argsort(events["time"], kind="stable")]

    def table(self, name):
        """A .dat file: names of the columns without units, and rows of words."""
        lines = (self.directory / name).read_text().splitlines()
        names = [re.sub(r"\[[^\]]*\]$", "", word) for word in lines[0][1:].split()]
        return names, [split_row(line) for line in lines if line.strip() and not line.startswith("#")]


def run_with(program, text, **settings):
    """Run a deck's text with other settings of the analysis: channels only, no figures."""
    directory = scratch()
    call(program, "run", written(directory, changed(text, "analysis.dynamic", **settings)), "--out", directory / "out", "--quiet",
         "--write", "channels")
    return Run(directory / "out")


class WrittenRun:
    """A run of a deck whose writes to one of its files are counted (end_at_write.c), and what a SIGKILL before any of them leaves."""

    def __init__(self, program, deck, place, name):
        self.place = place
        self.name = name
        self.command = [str(program), "run", str(deck), "--quiet", "--out"]
        self.shim = place / "end_at_write.so"
        source = ROOT / "tests" / "e2e" / "end_at_write.c"
        subprocess.run([os.environ.get("CC", "cc"), "-shared", "-fPIC", f'-DNAME="{name}"', "-o", self.shim, source, "-ldl"], check=True)
        self.told = self._run("whole")
        self.writes = self.told.count(f"write to {name}")
        self.whole = place / "whole" / name

    def _run(self, out, expect=0, **how):
        env = {**os.environ, "LD_PRELOAD": str(self.shim), **how}
        done = subprocess.run([*self.command, self.place / out], env=env, capture_output=True, text=True, timeout=LIMIT)
        assert done.returncode == expect, done
        return done.stderr

    def left_by_kills(self, places):
        """(n, file) for writes in order: the file as it is before the n-th write. A second run copies it there: what the system has of
        it is what stays when the process is killed. At the first, the middle and the last one another run is killed indeed, and must
        have left as many bytes."""
        copies = self.place / "copies"
        copies.mkdir()
        self._run("copied", GUDGEON_COPY_AT=",".join(map(str, places)), GUDGEON_COPIES=str(copies))
        assert sorted(int(path.name) for path in copies.iterdir()) == list(places)
        for n in places:
            if n in (places[0], places[len(places) // 2], places[-1]):
                self._run("killed", -signal.SIGKILL, GUDGEON_KILL_AT=str(n))
                left = self.place / "killed" / self.name
                assert left.stat().st_size == (copies / str(n)).stat().st_size
                yield n, left
            yield n, copies / str(n)


def split_row(row):
    """The cells of a row; a quoted text is one cell."""
    return [quoted or word for quoted, word in re.findall(r'"([^"]*)"|(\S+)', row)]


@functools.lru_cache(maxsize=None)
def finished(program, *options, changes=()):
    """A run of the dry slider-crank without figures, made once for all tests that ask for the same."""
    directory = scratch()
    deck = written(directory, plain_deck(changes))
    done = call(program, "run", deck, "--out", directory / "out", *options)
    return Run(directory / "out", done)


def assert_close(actual, expected, absolute=0.0, relative=0.0, what=""):
    """Every |actual - expected| within absolute + relative |expected|; says the worst."""
    actual, expected = np.broadcast_arrays(np.asarray(actual, float), np.asarray(expected, float))
    error = np.abs(actual - expected)
    allowed = absolute + relative * np.abs(expected)
    bad = ~(error <= allowed)
    if bad.any():
        k = np.unravel_index(np.argmax(np.where(np.isfinite(error), error / np.maximum(allowed, 1e-300), np.inf)), error.shape)
        raise AssertionError(
            f"{what}: {bad.sum()} of {error.size} off; at {tuple(int(i) for i in k)} {actual[k]!r}, "
            f"expected {expected[k]!r}: error {error[k]:.3g}, allowed {allowed[k]:.3g}"
        )
