"""docs/developer/new-kind.md, applied: its worked examples are added to a copy of the sources, by the lines that it names, built, and used."""

import json
import os
import pathlib
import re
import shutil
import subprocess

import numpy as np
import pytest

ROOT = pathlib.Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "tests" / "new_kind"
PAGE = (ROOT / "docs/developer/new-kind.md").read_text(encoding="utf-8")

CONTACT, JOINTS = "src/mechanics/contact/contact_registry.f90", "src/mechanics/joints/joint_registry.f90"
CLEARANCE, METHODS = "src/mechanics/clearance/clearance_registry.f90", "src/integrators/methods/integrator_registry.f90"
MAIN, WORDS, OPTIONS = "src/app/main.f90", "src/app/command_line/command_words.f90", "src/app/command_line/options.f90"

# per type: its file and where that goes; then (file, line before, new line), `+1`: the count in the line is one more
KINDS = {
    "law": [
        ("law_power.f90", "src/mechanics/contact"),
        (CONTACT, "   use law_plane_face, only: law_plane_face_t", "   use law_power, only: law_power_t"),
        (CONTACT, "      n_law_kinds = ", "+1"),
        (CONTACT, "allocate (law_persson_t :: law)", "      case ({n}); allocate (law_power_t :: law)"),
    ],
    "joint": [
        ("joint_chain.f90", "src/mechanics/joints"),
        (JOINTS, "   use initial_speed, only: initial_speed_t", "   use joint_chain, only: joint_chain_t"),
        (JOINTS, "      n_joint_kinds = ", "+1"),
        (JOINTS, "allocate (spatial_constant_velocity_t :: set)", "      case ({n}); allocate (joint_chain_t :: set)"),
    ],
    "geometry": [
        ("clearance_rollers.f90", "src/mechanics/clearance"),
        (CLEARANCE, "   use clearance_revolute, only: clearance_revolute_t", "   use clearance_rollers, only: clearance_rollers_t"),
        (CLEARANCE, "      n_clearance_kinds = ", "+1"),
        (CLEARANCE, "allocate (clearance_limits_t :: set)", "      case ({n}); allocate (clearance_rollers_t :: set)"),
    ],
    "method": [
        ("heun.f90", "src/integrators/methods"),
        (METHODS, "   use dop853, only: dop853_t", "   use heun, only: heun_t"),
        (METHODS, "      n_integrator_kinds = ", "+1"),
        (METHODS, "allocate (radau_t :: method)", "      case ({n}); allocate (heun_t :: method)"),
    ],
    "verb": [
        ("verb_masses.f90", "src/app"),
        (MAIN, "   use verb_merge, only: merge_sweep", "   use verb_masses, only: list_masses"),
        (MAIN, "         call merge_sweep(options, error)", '      case ("masses")\n         call list_masses(options, error)'),
        (WORDS, '      command_t("merge",', '      command_t("masses", "DECK", "list the masses of all bodies", "--set --total"), &'),
    ],
    "option": [
        (WORDS, '      option_t("--statistics",', '      option_t("--total", "", "write the total mass only"), &'),
        (OPTIONS, "      logical :: is_csv = .false.", "      logical :: is_total = .false.                  !! `--total`"),
        (OPTIONS, '      case ("--csv"); options%is_csv', '      case ("--total"); options%is_total = .true.'),
    ],
}


def apply(tree, edits):
    """Add files and lines; the number of a new case is the count that was raised before it."""
    count = 0
    for edit in edits:
        if len(edit) == 2:
            shutil.copy(EXAMPLES / edit[0], tree / edit[1])
            continue
        path, before, new = edit
        lines = (tree / path).read_text(encoding="utf-8").split("\n")
        at = [k for k, line in enumerate(lines) if before in line]
        assert len(at) == 1, (path, before)
        if new == "+1":
            count = int(re.search(r"= (\d+)", lines[at[0]])[1]) + 1
            lines[at[0]] = re.sub(r"= \d+", f"= {count}", lines[at[0]])
        else:
            end = at[0]
            while lines[end].rstrip().endswith("// &"):  # the line before goes on
                end += 1
            lines.insert(end + 1, new.format(n=count))
        (tree / path).write_text("\n".join(lines), encoding="utf-8")


@pytest.fixture(scope="module")
def program(tmp_path_factory):
    """The program with all examples, built from the objects that are there."""
    if not os.environ.get("GUDGEON_NEW_KIND"):
        pytest.skip("`make new-kind-test` builds the examples")
    tree = tmp_path_factory.mktemp("new_kind") / "tree"
    build = pathlib.Path(os.environ.get("GUDGEON_BUILD", ROOT / "build"))
    tree.mkdir()
    for name in ("Makefile", "VERSION", "src", "scripts", "tests", "inputs"):
        if (ROOT / name).is_dir():
            shutil.copytree(ROOT / name, tree / name, ignore=shutil.ignore_patterns("__pycache__"))
        elif (ROOT / name).exists():
            shutil.copy2(ROOT / name, tree / name)
    shutil.copytree(build, tree / "build", ignore=shutil.ignore_patterns("debug", "venv*", "bench", "films", "tests", "gudgeon"))
    for edits in KINDS.values():
        apply(tree, edits)
    command = ["make", "MODE=release", "OPTIMISE=-O0 -fno-pie -march=x86-64-v3", "BUILD=build", f"-j{os.cpu_count()}", "binary"]
    subprocess.run([*command, "--dry-run"], cwd=tree, capture_output=True)  # notes the flags; what is compiled already stays so
    os.utime(tree / "build" / "flags", (0, 0))
    done = subprocess.run(command, cwd=tree, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-3000:] + done.stdout[-1000:]
    return tree / "build" / "gudgeon"


def run(program, place, text, *options):
    """The summary of a run."""
    deck = place / "scene.deck"
    deck.write_text(text, encoding="utf-8")
    done = subprocess.run([program, "run", deck, "--out", place / "out", "--json", *options], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_the_lines_fit(tmp_path):
    """Every line of the examples has one place in the sources."""
    for edits in KINDS.values():
        for path in {edit[0 if len(edit) == 3 else 1] for edit in edits}:
            target = tmp_path / path
            if target.exists():
                continue
            if (ROOT / path).is_dir():
                target.mkdir(parents=True, exist_ok=True)
            else:
                target.parent.mkdir(parents=True, exist_ok=True)
                shutil.copy(ROOT / path, target)
    for edits in KINDS.values():
        apply(tmp_path, edits)


def test_the_page_names_every_file_that_is_touched():
    """Each type has its section, which names the example's file and every file with new lines, and says how many lines."""
    for kind, edits in KINDS.items():
        section = re.search(rf"^## [^\n]*\b{kind}\b.*?(?=^## |\Z)", PAGE, re.M | re.S | re.I)
        assert section, kind
        lines = sum(1 for edit in edits if len(edit) == 3)
        for path in {edit[0] for edit in edits}:
            assert path.split("/")[-1] in section[0], (kind, path)
        assert f"{lines} places" in section[0], (kind, lines)


def test_help_lists_what_is_new(program):
    """Tables, methods, verbs and options are found by help, list and the misspelling of their names."""

    def said(*words):
        done = subprocess.run([program, *words], capture_output=True, text=True)
        return done.stdout + done.stderr

    assert "F = K delta^n" in said("help", "contact", "power") and "chain drive" in said("help", "joint", "chain")
    assert "equal rollers" in said("help", "clearance", "rollers")
    assert "masses" in said("help") and "--total" in said("help", "masses") and "masses" in said("mases")


HEAD = "deck = 1\n[scene]\ntitle = \"New kind\"\nspace = planar\ngravity = 0 0 m/s^2\n"


def test_law_and_geometry(program, tmp_path):
    """Two equal rollers meet head on with v: the greatest penetration stores the energy m v^2/4, and they exchange their speeds."""
    mass, speed, stiffness, exponent = 0.2, 1.5, 3.0e7, 1.25
    summary = run(program, tmp_path, HEAD + f"""
[bodies]
name mass[kg] inertia[kg.m^2] x[mm] y[mm] vx[m/s]
left  {mass} 1e-5 0 0 {speed}
right {mass} 1e-5 30 0 0
[points]
name body xi[m] eta[m]
a left 0 0
b right 0 0
[material]
name young[GPa] poisson
steel 207 0.3
[contact.power]
name stiffness exponent
curve {stiffness} {exponent}
[clearance.rollers]
name i j radius[mm] material law
pair a b 10 steel curve
[analysis.dynamic]
start = given
end = 20 ms
tolerance = 1e-10
[output]
every = 1 ms
channels = pair.penetration left.velocity right.velocity
""")
    depth = ((exponent + 1) * mass * speed**2 / 4 / stiffness) ** (1 / (exponent + 1))
    found = {(row["channel"]): row for row in summary["extremes"]}
    assert found["pair.penetration"]["greatest"] == pytest.approx(depth, rel=1e-7)
    assert found["right.velocity.x"]["greatest"] == pytest.approx(speed, rel=1e-8)


def test_joint_and_method(program, tmp_path):
    """A driving moment on the first sprocket: its acceleration has both inertias; the error of Heun's method falls by four with half the step."""
    errors = []
    for step in (2e-3, 1e-3):
        summary = run(program, tmp_path, HEAD + f"""
[parameters]
rate = 3 rad/s
load = 0.3 N.m
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m]
small 1 0.01 0 0
large 1 0.05 1 0
[points]
name body xi[m] eta[m]
o1 ground 0 0
o2 ground 1 0
s small 0 0
l large 0 0
[joint.revolute]
name i j
first o1 s
second o2 l
[joint.chain]
name i j radius_i[mm] radius_j[mm]
chain small large 50 150
[force.torque]
name body moment[N.m]
drive small {{load*cos(rate*t)}}
[analysis.dynamic]
start = given
end = 1 s
method = heun
step = {step} s
[output]
every = 0.1 s
channels = small.angle large.angle
""")
        found = {row["channel"]: row for row in summary["extremes"]}
        inertia = 0.01 + 0.05 / 9
        exact = 0.3 / inertia / 9 * (1 - np.cos(3.0))
        errors.append(abs(found["small.angle"]["greatest"] - exact))
        assert found["large.angle"]["greatest"] == pytest.approx(found["small.angle"]["greatest"] / 3, rel=1e-9)
    assert 3.5 < errors[0] / errors[1] < 4.5


def test_verb_and_option(program):
    """The verb lists masses; the option leaves their sum; other verbs refuse it."""
    deck = ROOT / "inputs" / "slider_crank_dry.deck"
    whole = subprocess.run([program, "masses", deck], capture_output=True, text=True, check=True).stdout.split("\n")
    total = subprocess.run([program, "masses", deck, "--total"], capture_output=True, text=True, check=True).stdout.split("\n")
    assert len(whole) > len(total) and whole[-2] == total[0]
    masses = [float(line.split()[1]) for line in whole[:-2]]
    assert float(total[0].split()[1]) == pytest.approx(sum(masses))
    assert subprocess.run([program, "run", deck, "--total"], capture_output=True, text=True).returncode == 2
