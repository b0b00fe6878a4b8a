"""Every deck of space, turned and shifted as a whole: the same motion, contacts and energies, seen from elsewhere.

What is turned is the deck as the program understands it (deck.echo): all units SI, every default written out.
"""

import re

import numpy as np
import pytest
from scipy.spatial.transform import Rotation
from support import ROOT, Run, call, changed, scratch, written

TURN = Rotation.from_rotvec([0.7, -1.1, 0.4]).as_matrix()
SHIFT = np.array([0.3, -0.2, 0.5])
DECKS = sorted(path for folder in ("inputs", "inputs/hard") for path in (ROOT / folder).glob("*.deck")
               if re.search(r"(?m)^space\s*=\s*spatial", path.read_text()))
# part of the motion, so that what is compared is not yet chance; digits that are left of the positions there [m]
PARTS = {"pinball": (0.05, 1e-7), "double_pendulum": (0.02, 1e-7), "four_bar_spatial": (0.02, 1e-7), "crosshead": (0.02, 1e-6)}
METHODS = {"double_pendulum": "verner"}  # ten impacts, each of which multiplies differences by a hundred; else that of the deck
SIDES = {"axis_i": ("i", "bearing", "guide", "plane"), "width_axis": ("guide",), "axis_j": ("j", "journal", "slider", "ball"),
         "x_i": ("i",), "x_j": ("j",), "y_i": ("i",), "y_j": ("j",)}


def cells_of(line):
    """The cells of a row; what stands in quotes or braces is one."""
    return re.findall(r'"[^"]*"|\{[^}]*\}|\S+', line)


def words(vector):
    """Numbers with all their digits."""
    return [repr(float(x)) for x in vector]


def numbers_of(row, names, default=0.0):
    """Numbers of some columns, which may be left out."""
    return np.array([default if row.get(name, "-") == "-" else float(row[name]) for name in names])


def direction(cell):
    """The numbers in quotes."""
    return np.array([float(x) for x in cell.strip('"').split()])


def turned_body(row):
    """A body elsewhere, its orientation by Euler parameters."""
    given = row.pop("sequence", "none")
    angles = numbers_of(row, [f"angle{k}[rad]" for k in (1, 2, 3)])
    e = [row.pop(f"e{k}", "1" if k == 0 else "0") for k in range(4)]
    e = [float(x) if x != "-" else float(k == 0) for k, x in enumerate(e)]
    rot = Rotation.from_quat([*e[1:], e[0]])
    if given not in ("none", "-"):
        rot = Rotation.from_euler(given.upper(), angles)
    if row.get("axis", "-") != "-":
        axis = direction(row["axis"])
        rot = Rotation.from_rotvec(axis/np.linalg.norm(axis)*numbers_of(row, ["angle[rad]"])[0])
    if row.get("xi_axis", "-") != "-":
        x, y = direction(row["xi_axis"]), direction(row["eta_axis"])
        z = np.cross(x, y)
        frame = np.stack([x, np.cross(z, x), z], axis=1)
        rot = Rotation.from_matrix(frame/np.linalg.norm(frame, axis=0))
    for name in [name for name in row if name.startswith(("angle", "axis", "xi_axis", "eta_axis"))]:
        del row[name]
    q = Rotation.from_matrix(TURN @ rot.as_matrix()).as_quat()
    row |= dict(zip(("e0", "e1", "e2", "e3"), words([q[3], *q[:3]])))
    row |= dict(zip(("x[m]", "y[m]", "z[m]"), words(TURN @ numbers_of(row, ("x[m]", "y[m]", "z[m]")) + SHIFT)))
    for names in (("vx[m/s]", "vy[m/s]", "vz[m/s]"), ("wx[rad/s]", "wy[rad/s]", "wz[rad/s]")):
        if any(row.get(name, "-") != "-" for name in names):
            row |= dict(zip(names, words(TURN @ numbers_of(row, names))))
    return row


def turned(echo):
    """The text of deck.echo, the whole scene turned and shifted."""
    body_of, found = {}, []
    for section in re.split(r"(?m)^(?=\[)", echo):
        name = re.match(r"\[([\w.]+)\]", section)
        lines = section.splitlines()
        if not name or len(lines) < 3 or not lines[1].startswith("name "):
            found.append(re.sub(r"(?m)^gravity += (\S+) (\S+) (\S+)", lambda m: "gravity = " + " ".join(words(TURN @ np.array(list(map(float, m.groups()))))), section))
            continue
        header = lines[1].split()
        rows = [dict(zip(header, cells_of(line))) for line in lines[2:] if line.strip()]
        for row in rows:
            if name[1] == "bodies":
                turned_body(row)
            elif name[1] == "points":
                body_of[row["name"]] = row["body"]
                if row["body"] == "ground":
                    row |= dict(zip(("xi[m]", "eta[m]", "zeta[m]"), words(TURN @ numbers_of(row, ("xi[m]", "eta[m]", "zeta[m]")) + SHIFT)))
            else:
                for column, sides in SIDES.items():
                    if row.get(column, "-") == "-":
                        continue
                    side = next(row[s] for s in sides if s in row)
                    if body_of.get(side, side) == "ground":
                        row[column] = '"' + " ".join(words(TURN @ direction(row[column]))) + '"'
        header = list(dict.fromkeys(column for row in rows for column in row))
        table = [" ".join(header), *(" ".join(row.get(column, "-") for column in header) for row in rows)]
        found.append("\n".join([lines[0], *table, ""]))
    return "".join(part if part.endswith("\n") else part + "\n" for part in found)


@pytest.mark.parametrize("path", DECKS, ids=[path.stem for path in DECKS])
def test_turned_deck(gudgeon, path):
    """Motion, contacts and energies of a deck and of the same deck elsewhere."""
    directory = scratch()
    call(gudgeon, "run", path, "--out", directory / "whole", "--quiet", "--write", "numbers")
    echo = (directory / "whole" / "deck.echo").read_text()
    end = Run(directory / "whole").summary["time_end"]
    part, limit = PARTS.get(path.stem, (0.1, 1e-7))
    text = changed(echo, "output", every=f"{part*end/20!r} s", channels="*", figures=None)
    text = changed(text, "analysis.dynamic", end=f"{part*end!r} s", tolerance="1e-10", method=METHODS.get(path.stem))
    text = re.sub(r"(?ms)^\[(statistics|shapes|ensemble)\].*?(?=^\[|\Z)", "", text)
    runs = []
    for name, words_of in (("straight", text), ("turned", turned(text))):
        call(gudgeon, "run", written(directory, words_of, f"{name}.deck"), "--out", directory / name, "--quiet")
        runs.append(Run(directory / name))
    straight, other = runs
    times = [run.time[run.read("row_kind") == 0] for run in runs]
    assert np.array_equal(*times)
    for quantity, shift, size in (("position", SHIFT, 1.0), ("velocity", 0.0, None), ("angular_velocity", 0.0, None)):
        values = [run.read(f"bodies/{quantity}")[run.read("row_kind") == 0] for run in runs]
        scale = size or max(1.0, np.abs(values[0]).max())
        away = np.abs((values[1] - shift) @ TURN - values[0]).max()
        assert away < (1.0 if quantity == "position" else 1e3)*limit*scale, f"{quantity}: {away:.1e}"
    kinetic = [run.read("energy/kinetic")[run.read("row_kind") == 0] for run in runs]
    assert np.abs(kinetic[1] - kinetic[0]).max() < 1e3*limit*max(kinetic[0].max(), 1e-9)
    contacts = [run.contacts for run in runs]
    assert len(contacts[0]) == len(contacts[1]) and (path.stem not in PARTS or len(contacts[0]) > 0)
    for one, two in zip(*contacts):
        assert two["time"] == pytest.approx(one["time"], abs=1e-6*part*end)
        assert two["peak_force"] == pytest.approx(one["peak_force"], rel=1e-3)
