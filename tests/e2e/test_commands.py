"""The command line: verbs, options, exit codes, and what goes where."""

import json
import os
import re
import subprocess

import pytest
from support import DECK, Run, call, finished, plain_deck, scratch, written

USAGE, DECK_MISTAKE, INTEGRATION, FILE = 2, 3, 5, 9


@pytest.fixture
def short():
    """A deck that runs in no time: 1 ms, no figures."""
    return written(scratch(), plain_deck([("analysis.dynamic", "end", "1 ms")]))


def test_run_leaves_everything(gudgeon):
    """Without --out the results are in outputs/NAME of the current directory."""
    directory = scratch()
    deck = written(directory, DECK.read_text(), "slider_crank_dry.deck")
    done = call(gudgeon, "run", deck.name, cwd=directory)
    out = directory / "outputs" / "slider_crank_dry"
    names = {str(p.relative_to(out)) for p in out.rglob("*") if p.is_file()}
    assert {"run.h5", "events.dat", "summary.txt", "summary.json", "deck.echo", "gudgeon.dat", "slider.dat"} <= names
    figures = [p for p in out.glob("figures/*.png")]
    assert len(figures) >= 5, "the deck asks for five figures"
    for figure in figures:
        assert figure.read_bytes().startswith(b"\x89PNG") and figure.stat().st_size > 3000
        assert figure.with_suffix(".gp").exists()
    assert (out / "summary.txt").read_text().strip() in done.stdout.replace("\r", "")
    assert Run(out).read("deck") == deck.read_text()


def test_json_is_all_there_is_on_stdout(gudgeon, short):
    """--json prints summary.json and nothing else on standard output."""
    out = scratch() / "out"
    done = call(gudgeon, "run", short, "--out", out, "--json")
    assert json.loads(done.stdout) == json.loads((out / "summary.json").read_text())


def test_quiet(gudgeon, short):
    """--quiet: nothing is printed but errors; warnings are in the summary."""
    out = scratch() / "out"
    short.write_text(short.read_text().replace("0.3       7850", "0.3       1e8"))  # so that waves are slow: a warning
    done = call(gudgeon, "run", short, "--out", out, "--quiet")
    assert done.stdout == "" and done.stderr == ""
    assert ["quasi-static" in words for words in Run(out).summary["warnings"]] == [True]
    assert "quasi-static" in (out / "summary.txt").read_text()
    done = call(gudgeon, "run", short, "--out", out, "--json")
    assert done.stderr.startswith("warning: ") and "quasi-static" in done.stderr
    done = call(gudgeon, "run", short, "--out", out, "--quiet", "--set", "cc=1mm", expect=DECK_MISTAKE)
    assert "cc" in done.stderr


def test_summary_tells_cost_and_error(gudgeon):
    """A number without its error is no result: both are in the summary."""
    summary = finished(gudgeon, "--tolerance", "1e-8").summary
    for key in ("steps", "rejected_steps", "rhs_evaluations", "cpu_seconds", "contacts"):
        assert summary[key] > 0, key
    assert summary["factorisations"] == 0  # each body has one coordinate, and no row is left
    for key in ("energy_residual_max", "violation_max", "violation_rate_max"):
        assert 0 <= summary[key] < 1e-3, key
    assert summary["tolerance"] == 1e-8 and summary["method"] == "auto (dop853)"
    text = (finished(gudgeon, "--tolerance", "1e-8").directory / "summary.txt").read_text()
    assert str(summary["steps"]) in text and str(summary["rhs_evaluations"]) in text


def test_check(gudgeon, short):
    """check: a good deck is good, and nothing is written."""
    directory = scratch()
    call(gudgeon, "check", short, cwd=directory)
    assert list(directory.iterdir()) == []


def test_check_finds_a_mistake(gudgeon):
    """A misspelt column: exit 3, the place, and the nearest word."""
    deck = written(scratch(), DECK.read_text().replace("clearance   length", "clearence   length"))
    done = call(gudgeon, "check", deck, expect=DECK_MISTAKE)
    assert "clearence" in done.stderr and "^^^^" in done.stderr and "did you mean 'clearance'" in done.stderr
    line = next(k for k, text in enumerate(deck.read_text().splitlines(), 1) if "clearence" in text)
    assert re.search(rf"scene\.deck:{line}:\d+", done.stderr)
    assert done.stdout == ""


def test_explain(gudgeon):
    """explain names what is kept and dropped, the degrees of freedom, the contact stiffness."""
    text = call(gudgeon, "explain", DECK).stdout
    for word in ("gudgeon", "joint.revolute", "driver.speed", "degrees of freedom", "gravity", "hertz", "6.6102e10"):
        assert word in text, word


def test_explain_names_ideal_joints_that_rub(gudgeon):
    """explain names an ideal joint that rubs with its law, and radius and preload as --set gives them; without friction it does not."""
    hatch = DECK.parent / "hatch.deck"
    text = call(gudgeon, "explain", hatch, "--set", "fit=450N", "--set", "radius=12mm", "--set", "friction=stribeck").stdout
    rubs = text.split("ideal joints with friction\n")[1].split("\n\n")[0].splitlines()
    assert [line.strip().split(":")[0] for line in rubs[::2]] == ["hinge"]
    assert "friction stribeck (friction.stribeck): coefficient 0.3, static_coefficient 0.4" in rubs[0]
    assert rubs[1].strip() == "radius 0.012 m, preload 450 N"
    smooth = written(scratch(), hatch.read_text().replace("hinge.friction_moment", ""))
    assert "ideal joints with friction" not in call(gudgeon, "explain", smooth, "--set", "friction=none").stdout
    assert "ideal joints with friction" not in call(gudgeon, "explain", DECK).stdout


@pytest.mark.parametrize("name", ["", " ", ".deck", "..", "../mine", "/tmp/mine", "a/../../mine", "a/", "a/.."])
def test_new_needs_a_name_in_this_folder(gudgeon, name):
    """An empty name and paths that lead out of the folder are refused, and nothing is written."""
    directory = scratch()
    (directory / "inner" / "a").mkdir(parents=True)
    done = call(gudgeon, "new", name, cwd=directory / "inner", expect=USAGE)
    assert f"'{name}' is not a valid deck name" in done.stderr
    assert not list(directory.rglob("*.deck"))


def test_new_writes_a_template_that_checks(gudgeon):
    """new NAME writes a deck that check accepts and run runs; it does not overwrite."""
    directory = scratch()
    call(gudgeon, "new", "mine", cwd=directory)
    decks = list(directory.rglob("*.deck"))
    assert [deck.name for deck in decks] == ["mine.deck"]
    text = decks[0].read_text()
    assert text.count("#") > 5, "a commented template"
    call(gudgeon, "check", decks[0], cwd=directory)
    call(gudgeon, "run", decks[0], "--out", directory / "out", "--quiet", cwd=directory)
    call(gudgeon, "new", "mine", cwd=directory, expect=(USAGE, DECK_MISTAKE, FILE))
    assert decks[0].read_text() == text


def test_list(gudgeon):
    """list names the kinds."""
    text = call(gudgeon, "list").stdout
    for word in ("revolute", "translational", "lankarani_nikravesh", "hertz", "ambrosio", "verner"):
        assert word in text, word
    lines = [line for line in text.splitlines() if line.split()[0] == "joint.revolute"]
    assert [line[31:].split(":")[0] for line in lines] == ["in the plane", "in space"]


@pytest.mark.parametrize(("word", "hint"), [
    ("figures", "did you mean key figures of [output]? gudgeon help output"), ("contour", "did you mean key figures of [output]? gudgeon help output"),
    ("animation", "did you mean key figures of [output]?"), ("bearing_radius", "did you mean column bearing_radius of [clearance.revolute]?")])
def test_help_on_a_key(gudgeon, word, hint):
    """help of a key, a column or a figure names the table that has it."""
    assert hint in call(gudgeon, "help", word, expect=USAGE).stderr


def test_list_of_a_group(gudgeon):
    """list GROUP and list KIND name a part; a word that is neither is a mistake with the nearest one."""
    lines = call(gudgeon, "list", "friction", "joint.rigid").stdout.splitlines()
    assert len(lines) > 3 and all(line.startswith(("friction.", "joint.rigid ")) for line in lines)
    done = call(gudgeon, "list", "frictoin", expect=USAGE)
    assert "unknown type 'frictoin'" in done.stderr and "did you mean 'friction'" in done.stderr and done.stdout == ""
    assert "unknown type 'foo'" in call(gudgeon, "list", "foo", expect=USAGE).stderr


def test_values_behind_an_equals_sign(gudgeon, short):
    """--option=value is --option value, for every option that has one; an option without a value takes none."""
    first, second = scratch() / "out", scratch() / "out"
    call(gudgeon, "run", short, "--out", first, "--set", "c=0.2mm", "--tolerance", "1e-6", "--method", "adams", "--analysis", "dynamic",
         "--write", "channels", "--quiet")
    call(gudgeon, "run", short, f"--out={second}", "--set=c=0.2mm", "--tolerance=1e-6", "--method=adams", "--analysis=dynamic",
         "--write=channels", "--quiet")
    assert (Run(first).contacts["time"] == Run(second).contacts["time"]).all() and len(Run(first).contacts) > 0
    assert Run(second).summary["method"] == "adams" and Run(second).summary["tolerance"] == 1e-6
    assert "takes no value" in call(gudgeon, "check", short, "--ideal=yes", expect=USAGE).stderr
    assert "'--metod'" in call(gudgeon, "check", short, "--metod=rk4", expect=USAGE).stderr


def test_deck_in_force(gudgeon, short):
    """After --set the deck in run.h5 is the one that ran: run again, it gives the same; the file's value stands in a comment."""
    included = written(scratch(), f'deck = 1\ninclude "{short}"\n')
    for deck in (short, included):
        out, again = scratch() / "out", scratch() / "out"
        call(gudgeon, "run", deck, "--out", out, "--set", "c=0.2 mm", "--set", "law=hertz", "--quiet")
        group = Run(out).read("deck") if deck is short else Run(out).read(f"deck_includes{short}")
        assert re.search(r"(?m)^c +=\s*0.2 mm +# --set; in the file: 0.5 mm", group)
        call(gudgeon, "run", written(scratch(), group), "--out", again, "--quiet")
        assert (Run(out).contacts["time"] == Run(again).contacts["time"]).all() and len(Run(out).contacts) > 0


def test_help(gudgeon):
    """help names the verbs and options; help joint revolute tells of the joint."""
    text = call(gudgeon, "help").stdout
    for word in ("run", "check", "explain", "new", "list", "help", "--out", "--set", "--ideal", "--tolerance",
                 "--quiet", "--json", "--version"):
        assert word in text, word
    text = call(gudgeon, "help", "joint", "revolute").stdout
    assert "revolute" in text and "points coincide" in text and "reaction force" in text
    assert "--set" in call(gudgeon, "--help").stdout


def test_help_of_a_verb(gudgeon):
    """A verb with --help tells of its own options, whatever else stands there; help VERB the same, before a section of its name."""
    text = call(gudgeon, "compare", "--help").stdout
    assert "gudgeon compare A B" in text and "--relative X" in text and "--walltime" not in text
    assert call(gudgeon, "compare", "nowhere", "-h", "--nonsense").stdout == call(gudgeon, "help", "compare").stdout == text
    text = call(gudgeon, "help", "sweep").stdout
    assert text.startswith(call(gudgeon, "sweep", "--help").stdout.rstrip()) and "combine" in text


def test_help_by_the_last_part_of_a_name(gudgeon):
    """help revolute tells of every kind of that name, help energy of the ledger."""
    text = call(gudgeon, "help", "revolute").stdout
    assert "joint.revolute:" in text and "clearance.revolute:" in text and "joint.rigid:" not in text
    text = call(gudgeon, "help", "energy").stdout
    for word in ("kinetic", "drive_work", "dissipated_contact", "residual"):
        assert re.search(rf"^  {word} ", text, re.MULTILINE), word
    assert call(gudgeon, "help", "joint.revolute").stdout == call(gudgeon, "help", "joint", "revolute").stdout


def into_full_disk(program, *arguments):
    """Run the program with a standard output that takes nothing."""
    with open("/dev/full", "w") as full:
        return subprocess.run([str(program), *map(str, arguments)], stdout=full, stderr=subprocess.PIPE, text=True,
                              stdin=subprocess.DEVNULL, timeout=60)


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full")
def test_summary_into_a_full_disk(gudgeon, short):
    """A summary that cannot be printed: exit 9, and the run itself is whole."""
    out = scratch() / "out"
    done = into_full_disk(gudgeon, "run", short, "--out", out, "--json")
    assert done.returncode == FILE and "standard output" in done.stderr
    assert Run(out).summary["status"] == "complete"


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="no /dev/full")
@pytest.mark.parametrize("arguments", [("list",), ("help",), ("help", "--manual"), ("explain", DECK), ("check", DECK),
                                       ("--version",)])
def test_words_into_a_full_disk(gudgeon, arguments):
    """What cannot be printed is an error of the file."""
    done = into_full_disk(gudgeon, *arguments)
    assert done.returncode == FILE and "standard output" in done.stderr


def test_help_of_something_unknown(gudgeon):
    """help about something that is not there fails and says what there is."""
    assert "revolute" in call(gudgeon, "help", "joint", "revolut", expect=USAGE).stderr


def test_version_names_the_libraries(gudgeon):
    """--version: the program's own and those of the libraries it runs on."""
    text = call(gudgeon, "--version").stdout
    assert re.search(r"gudgeon \d+\.\d+", text)
    for word in ("HDF5", "SUNDIALS", "LAPACK"):
        assert re.search(rf"{word}.*\d+\.\d+", text, re.IGNORECASE), word


@pytest.mark.parametrize("arguments", [
    ("runn", DECK), ("run",), ("run", DECK, "--no-such-option"), ("run", DECK, "--out"), ("run", DECK, DECK),
    ("run", DECK, "--tolerance", "small"), ("run", DECK, "--tolerance", "0.5"), ("run", DECK, "--tolerance", "0"),
    ("run", DECK, "--set"), ("check",), ("explain",), ("--run", DECK),
])
def test_wrong_command_lines(gudgeon, arguments):
    """Exit 2, a message on standard error, nothing on standard output, nothing written."""
    directory = scratch()
    done = call(gudgeon, *arguments, cwd=directory, expect=USAGE)
    assert done.stderr.strip() and done.stdout == ""
    assert list(directory.iterdir()) == []


def test_nearest_verb_and_option(gudgeon):
    """A misspelt verb, option or method gets the nearest one; two methods are none."""
    assert "run" in call(gudgeon, "rum", DECK, expect=USAGE).stderr
    assert "--tolerance" in call(gudgeon, "run", DECK, "--tolerence", "1e-6", expect=USAGE).stderr
    assert "did you mean 'verner'" in call(gudgeon, "run", DECK, "--method", "vernr", expect=USAGE).stderr
    assert "unknown method" in call(gudgeon, "run", DECK, "--method", "verner dop853", expect=USAGE).stderr


@pytest.mark.parametrize("verb", ["run", "check", "explain"])
def test_missing_deck(gudgeon, verb):
    """A deck that is not there: its name is in the message."""
    done = call(gudgeon, verb, "no_such.deck", cwd=scratch(), expect=(DECK_MISTAKE, FILE))
    assert "no_such.deck" in done.stderr


def test_set(gudgeon, short):
    """--set changes a parameter of the deck, with or without a space; an unknown one is refused."""
    first = []
    for options in ((), ("--set", "c=0.2mm"), ("--set", "c=0.2 mm"), ("--set", "c=0.2 mm", "--set", "speed=2500rpm")):
        out = scratch() / "out"
        call(gudgeon, "run", short, "--out", out, "--quiet", *options)
        first.append(Run(out).contacts["time"][0])
    assert first[1] == first[2] != first[0]
    assert abs(first[3] / first[1] - 2.0) < 1e-6, "at half the speed the journal falls through the gap in twice the time"
    done = call(gudgeon, "run", short, "--out", scratch() / "out", "--set", "cc=1mm", expect=(USAGE, DECK_MISTAKE))
    assert "cc" in done.stderr
    for wrong in ("c=1kg", "c=", "c", "=1mm"):
        call(gudgeon, "run", short, "--out", scratch() / "out", "--set", wrong, expect=(USAGE, DECK_MISTAKE))


def test_step_that_does_not_advance(gudgeon):
    """A fixed step too short to arrive: exit 5 at once, not in a year."""
    deck = written(scratch(), plain_deck([("analysis.dynamic", "step", "1e-30 s")]))
    done = call(gudgeon, "run", deck, "--out", scratch() / "out", expect=INTEGRATION, limit=10)
    assert "step" in done.stderr


def test_output_directory_that_cannot_be(gudgeon, short):
    """A file where the directory should be: exit 9 and the path."""
    directory = scratch()
    (directory / "taken").write_text("mine\n")
    done = call(gudgeon, "run", short, "--out", directory / "taken", expect=FILE)
    assert "taken" in done.stderr and (directory / "taken").read_text() == "mine\n"


def test_a_mechanism_that_cannot_be_assembled(gudgeon):
    """A guide out of the rod's reach: exit 4 from check and run alike, with the joint that stays open, nothing written."""
    text = plain_deck().replace("\npin      slider", "\nhigh     ground     0    900\npin      slider")
    deck = written(scratch(), text.replace("guide    main     pin", "guide    high     pin"))
    for verb in ("check", "run"):
        directory = scratch()
        done = call(gudgeon, verb, deck, cwd=directory, expect=4)
        assert re.search(r"main|big_end|guide|gudgeon", done.stderr)
        assert list(directory.iterdir()) == []


def test_explain_says_where_contacts_are_looked_for(gudgeon, tmp_path):
    """Within steps where onsets are located; else at their ends only, as a contact shorter than a step shows."""
    assert "contact detection: 8 points per step" in call(gudgeon, "explain", DECK).stdout
    deck = written(tmp_path, plain_deck((("analysis.dynamic", "contact_onset", "interpolate"),)))
    text = call(gudgeon, "explain", deck).stdout
    assert "at the ends of steps only (contact_onset = interpolate)" in text and "8 points" not in text
    ball = """deck = 1
[bodies]
name  mass[kg]  inertia[kg.m^2]  x[m]  y[m]  vx[m/s]
ball  1         1e-3             -1.25 0.09  1
[points]
name  body    xi[m]  eta[m]
post  ground  0      0
core  ball    0      0
[material]
name   young[GPa]  poisson
steel  207         0.3
[contact.hertz]
name
hertz
[clearance.discs]
name  i     j     radius_i[mm]  radius_j[mm]  material  law
hit   post  core  50            50            steel     hertz
[analysis.dynamic]
start = given
end   = 2.5 s
contact_onset = ONSET
step  = 0.5 s
method = rk4
[output]
every = 1 s
"""
    counts = {}
    for onset in ("located", "uncontrolled"):
        call(gudgeon, "run", written(tmp_path, ball.replace("ONSET", onset)), "--out", tmp_path / onset, "--quiet", "--write", "numbers")
        counts[onset] = json.loads((tmp_path / onset / "summary.json").read_text())["contacts"]
    assert counts == {"located": 1, "uncontrolled": 0}


def test_how_far_bodies_are_moved_is_told(gudgeon, tmp_path):
    """A wheel put 50 mm below its pin is moved by as much as it is assembled, and `check` and the summary say so."""
    text = """deck = 1
[bodies]
name  mass[kg]  inertia[kg.m^2]  x[m]  y[m]
bob   1         1                OFF
[points]
name   body    xi[m]  eta[m]
hook   ground  0      0
eye    bob     0      0
[joint.revolute]
name  i     j
pin   hook  eye
[analysis.dynamic]
end = 1 s
"""
    assert "maximum displacement of a body 0 m" in call(gudgeon, "check", written(tmp_path, text.replace("OFF", "0 0"))).stdout
    assert "maximum displacement of a body 0.05 m" in call(gudgeon, "check", written(tmp_path, text.replace("OFF", "0 -0.05"))).stdout
    for place, told in (("0 0", ""), ("0 -0.05", "start      initial assembly correction: up to 0.05 m")):
        call(gudgeon, "run", written(tmp_path, text.replace("OFF", place)), "--out", tmp_path / "out", "--quiet")
        lines = (tmp_path / "out" / "summary.txt").read_text().splitlines()
        assert [line[:len(told)] for line in lines if line.startswith("start")] == [told] * bool(told)
