"""What the scripts that draw several runs in one figure share: decks with changes, runs side by side, tables and gnuplot."""

import concurrent.futures
import dataclasses
import functools
import json
import pathlib
import re
import shutil
import subprocess
import sys

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent
WORKERS = 2  # processes at a time

RED, BLUE, GREEN, ORANGE, PURPLE, CYAN, PINK, GREY = (
    "#c0392b", "#1f6fb4", "#2e8b57", "#e08e0b", "#8e44ad", "#17a2b8", "#e377c2", "#7f7f7f")
COLOURS = (BLUE, RED, GREEN, ORANGE, PURPLE, CYAN, PINK, GREY)

HEAD = """\
# Edit this script and run it here again:  gnuplot {name}.gp
reset
set encoding utf8
set terminal pngcairo noenhanced size {size} font "DejaVu Sans,{font}"
set output '{name}.png'
set grid linetype 1 linewidth 0.7 linecolor rgb '#dcdcdc'
set border linewidth 1.2 linecolor rgb '#404040'
set tics nomirror textcolor rgb '#000000'
"""


def start(default, title):
    """Program, an empty directory and the directory of figures in it, from the command line."""
    if len(sys.argv) not in (2, 3):
        sys.exit(title.strip())
    directory = pathlib.Path(sys.argv[2]) if len(sys.argv) == 3 else ROOT / "outputs" / default
    shutil.rmtree(directory, ignore_errors=True)
    figures = directory / "figures"
    figures.mkdir(parents=True)
    return str(pathlib.Path(sys.argv[1]).resolve()), directory, figures


def deck_text(deck, changes, renamed):
    """A deck without figures of its own, some tables renamed, and with the changes {section: {key: value}}; what is not there is added."""
    text = deck.read_text()
    for old, new in renamed.items():
        text = text.replace(f"[{old}]", f"[{new}]")
    changes = {**changes, "output": {"figures": None, **changes.get("output", {})}}
    for section, settings in changes.items():
        if f"[{section}]" not in text:
            text += f"\n[{section}]\n"
        found = re.search(rf"(?ms)^\[{re.escape(section)}\][^\n]*\n(.*?)(?=^\[|\Z)", text)
        body = found.group(1)
        for key, value in settings.items():
            body = re.sub(rf"(?m)^{key} *=.*\n?", "", body)
            if value is not None:
                body = f"{key} = {value}\n" + body
        text = text[:found.start(1)] + body + text[found.end(1):]
    return text


class Run:
    """What one run left behind."""

    def __init__(self, directory):
        self.file = directory / "run.h5"
        self.summary = json.loads((directory / "summary.json").read_text())

    @functools.cache
    def read(self, path):
        """A dataset of run.h5."""
        with h5py.File(self.file, "r") as file:
            return file[path][()]

    def item(self, path, name):
        """The part of a dataset (n, items, ...) that belongs to one item by name."""
        names = [found.decode() for found in self.read(path.split("/")[0] + "/names")]
        return self.read(path)[:, names.index(name)]

    @property
    def time(self):
        """Instants of all rows, those at contacts too [s]."""
        return self.read("time")

    @property
    def is_spaced(self):
        """Which rows are output instants, equally spaced: for means."""
        return self.read("row_kind") == 0

    @property
    def contacts(self):
        """Rows of /events that are contacts, by their onsets."""
        events = self.read("events")
        events = events[events["kind"] == b"contact"]
        return events[np.argsort(events["time"], kind="stable")]


@dataclasses.dataclass
class Case:
    """A run to be made: parameters of the deck, changes of its settings, other words of the command line, tables that become others."""

    deck: pathlib.Path
    parameters: dict = dataclasses.field(default_factory=dict)
    changes: dict = dataclasses.field(default_factory=dict)
    options: tuple = ()
    renamed: dict = dataclasses.field(default_factory=dict)


def run_all(program, directory, cases):
    """One run for each named case, a few at a time; those that the program cannot do are told and left out."""

    def one(name):
        case = cases[name]
        deck = directory / f"{name}.deck"
        deck.write_text(deck_text(case.deck, case.changes, case.renamed))
        settings = [word for key, value in case.parameters.items() for word in ("--set", f"{key}={value}")]
        command = [program, "run", str(deck), "--out", str(directory / name), "--quiet", *settings, *case.options]
        done = subprocess.run(command, text=True, capture_output=True)
        if done.returncode == 0:
            return Run(directory / name)
        print(f"{name}: ended with code {done.returncode}\n{done.stderr}", file=sys.stderr)
        return None

    with concurrent.futures.ThreadPoolExecutor(WORKERS) as pool:
        found = dict(zip(cases, pool.map(one, cases)))
    return {name: run for name, run in found.items() if run}


def table(figures, name, columns, titles):
    """A table for gnuplot."""
    np.savetxt(figures / f"{name}.dat", np.column_stack(columns), fmt="%.8g", header=" ".join(titles))


def draw(figures, name, text, size="1200,800", font=15):
    """Write a script and run it."""
    (figures / f"{name}.gp").write_text(HEAD.format(name=name, size=size, font=font) + text + "unset output\n")
    subprocess.run(["gnuplot", f"{name}.gp"], cwd=figures, check=True)


@dataclasses.dataclass
class Curve:
    """One curve of a panel; without x and y a line of gnuplot."""

    x: object = None
    y: object = None
    title: str = ""
    colour: str = BLUE
    style: str = "lines linewidth 1.2"
    line: str = ""


@dataclasses.dataclass
class Panel:
    """Curves on one pair of axes, with further lines of gnuplot."""

    curves: list
    xlabel: str
    ylabel: str
    title: str = ""
    settings: str = ""


def panels_text(figures, name, panels):
    """The gnuplot lines of panels, their tables written."""
    text = ""
    for number, panel in enumerate(panels):
        plots = []
        for k, curve in enumerate(panel.curves):
            title = f"title '{curve.title}'" if curve.title else "notitle"
            if curve.line:
                plots.append(f"{curve.line} {title}")
                continue
            data = f"{name}.{chr(ord('a') + number)}{k + 1}"
            table(figures, data, (curve.x, curve.y), (panel.xlabel.replace(" ", "_"), panel.ylabel.replace(" ", "_")))
            plots.append(f"'{data}.dat' using 1:2 with {curve.style} linecolor rgb '{curve.colour}' {title}")
        text += f"set label 1 '{panel.title}' at graph 0, 1.05 left\nset xlabel '{panel.xlabel}'\nset ylabel '{panel.ylabel}'\n"
        keyed = any(curve.title for curve in panel.curves)
        text += f"set {'key' if keyed else 'nokey'}\n{panel.settings}plot " + ", \\\n   ".join(plots) + "\n"
    return text


def draw_panels(figures, name, panels, columns=2, title="", common="", height=340, width=540):
    """Panels side by side in one picture."""
    rows = -(-len(panels)//columns)
    text = f"set multiplot layout {rows},{columns}" + (f" title '{title}' font ',14'" if title else "") + "\n"
    text += "set key at graph 1, 1.02 right bottom horizontal samplen 2 width -3\nset tmargin 2\n" + common + panels_text(figures, name, panels) + "unset multiplot\n"
    draw(figures, name, text, f"{width*columns},{height*rows + (40 if title else 0)}", 11)


def draw_all(jobs):
    """Call drawing functions without arguments, a few at a time; their errors are raised."""
    with concurrent.futures.ThreadPoolExecutor(WORKERS) as pool:
        list(pool.map(lambda job: job(), jobs))
