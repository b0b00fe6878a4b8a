"""The Python package gudgeon: runs, sweeps, templates, tables, errors, how it finds the program and how it is installed."""

import csv
import importlib.util
import os
import re
import shutil
import subprocess
import sys
import zipfile

import numpy as np
import pytest
from support import DECK, ROOT, Run, call, plain_deck, scratch, written

SHORT = [("analysis.dynamic", "end", "2 ms")]
NEEDED = {"a table": "pandas", "a dataset": "xarray"}


@pytest.fixture
def package(root, gudgeon, monkeypatch, tmp_path):
    """The package of the sources, which takes this build's program, in an empty directory."""
    monkeypatch.syspath_prepend(str(root / "scripts/python"))
    monkeypatch.setenv("GUDGEON", str(gudgeon))
    monkeypatch.chdir(tmp_path)
    import gudgeon as package

    return package


def python(code, **environment):
    """What a new Python says, which is without the variables of this one."""
    surroundings = {name: value for name, value in os.environ.items() if name not in ("GUDGEON", "PYTHONPATH")}
    return subprocess.run([sys.executable, "-B", "-c", code], env={**surroundings, **environment}, capture_output=True, text=True,
                          timeout=120, check=True).stdout.strip()


def test_run_gives_what_the_program_leaves(package, gudgeon):
    """The same numbers as a call of the program, in the place that it takes."""
    written(".", plain_deck(SHORT), "crank.deck")
    run = package.run("crank.deck", set={"c": "0.2 mm"}, tolerance=1e-9, write="channels")
    call(gudgeon, "run", "crank.deck", "--set", "c=0.2 mm", "--tolerance", "1e-9", "--write", "channels", "--out", "other", "--quiet")
    other = Run("other")
    assert str(run.directory) == os.path.abspath("outputs/crank") and run.status == "complete" and run.warnings == []
    assert run.summary["parameters"]["c"] == "0.2 mm" and run.summary["tolerance"] == 1e-9
    np.testing.assert_array_equal(run["slider.velocity.x"], other.item("bodies/velocity", "slider")[:, 0])
    joint = other.summary["loose_joints"][0]
    assert run.peak("gudgeon.normal_force")[0] == pytest.approx(joint["peak_force"], rel=1e-6)
    again = package.read("outputs/crank/run.h5")
    assert again.summary == run.summary and len(again["time"]) < len(again.arrays(rows="all")["time"])


def test_run_that_has_not_ended_is_read(package):
    """Without summary.json run.h5 says what is known."""
    run = package.run(written(".", plain_deck(SHORT)), out="out", write="channels")
    os.remove("out/summary.json")
    again = package.read("out")
    assert again.status == run.status and again.summary["steps"] == run.summary["steps"] and again.figures == []
    with pytest.raises(FileNotFoundError, match="no run of gudgeon"):
        package.read("outputs")


def test_figures_in_a_notebook(package):
    """A picture as the program drew it, and a page with the warnings."""
    if not shutil.which("gnuplot"):
        pytest.skip("gnuplot is not there")
    text = plain_deck(SHORT).replace("[output]\n", "[output]\nfigures = slider.velocity\n")
    run = package.run(written(".", text), out="out")
    assert [path.name for path in run.figures] == ["slider.velocity.png"]
    assert run._repr_png_() == run.figures[0].read_bytes()
    run.summary["warnings"].append("a < b")
    assert "data:image/png;base64," in run._repr_html_() and "a &lt; b" in run._repr_html_()


def test_errors_carry_what_the_program_says(package, gudgeon):
    """Exit code and message of a deck that is wrong, of an option, and of a run that fails with its results."""
    path = written(".", plain_deck(SHORT).replace("gravity  =", "gravitation ="))
    with pytest.raises(package.GudgeonError) as told:
        package.run(path)
    said = call(gudgeon, "run", path, "--quiet", expect=3).stderr.strip()
    assert told.value.code == 3 and told.value.run is None
    assert "unknown key 'gravitation'" in str(told.value) and said == f"error: {told.value.message}"
    with pytest.raises(package.GudgeonError, match="unknown option") as told:
        package.run(path, tolerence=1e-9)
    assert told.value.code == 2
    strict = written(".", plain_deck([*SHORT, ("analysis.dynamic", "energy_limit", "1e-15")]))
    with pytest.raises(package.GudgeonError, match="energy error") as told:
        package.run(strict, out="strict", write="channels")
    assert told.value.code == 6 and told.value.run.status == "failed"
    assert told.value.run["time"][-1] == pytest.approx(2e-3)


def test_deck_with_open_values(package):
    """`$name` in the text, parameters of the deck, includes beside the file; messages name the deck, not the pipe."""
    folder = scratch()
    written(folder, plain_deck(SHORT), "crank.deck")
    deck = package.Deck('deck = 1\ninclude "crank.deck"\n[analysis.dynamic]\nend = ${end}\n# 5 $ for $what\n', folder, "half", end="1 ms", what=True)
    assert deck.parts() == (deck.text.replace("${end}", "1 ms").replace("$what", "on"), {})
    run = package.run(deck.having(c="0.1 mm"), write="channels")
    assert run.summary["time_end"] == pytest.approx(1e-3) and run.summary["parameters"]["c"] == "0.1 mm"
    assert str(run.directory) == os.path.abspath("outputs/half")
    assert package.run(package.Deck.read(folder / "crank.deck"), set={"c": "0.3 mm"}, write="numbers").summary["parameters"]["c"] == "0.3 mm"
    with pytest.raises(KeyError, match="end"):
        package.run(package.Deck("end = $end"))
    with pytest.raises(package.GudgeonError, match="half.deck:1"):
        package.run(package.Deck("nothing", name="half"))


def test_progress_is_passed_on(package, monkeypatch, tmp_path):
    """Lines of progress go to the function, and are no part of the message."""
    program = tmp_path / "program"
    program.write_text("#!/bin/sh\necho 'progress  50%, 2 s left' >&2\necho 'error: no more' >&2\nexit 5\n")
    program.chmod(0o755)
    monkeypatch.setenv("GUDGEON", str(program))
    lines = []
    with pytest.raises(package.GudgeonError) as told:
        package.run("any.deck", progress=lines.append)
    assert lines == ["progress  50%, 2 s left"] and (told.value.code, told.value.message) == (5, "no more")


def test_an_interrupted_call_ends_the_program(package, monkeypatch, tmp_path):
    """Whatever interrupts Python also ends the program, by a signal at which it saves its motion."""
    program = tmp_path / "program"
    program.write_text("#!/bin/sh\ntrap 'echo saved >saved; kill $!; exit 7' TERM\necho 'progress   1%' >&2\nsleep 60 &\nwait\n")
    program.chmod(0o755)
    monkeypatch.setenv("GUDGEON", str(program))

    def interrupt(line):
        raise ArithmeticError(line)

    with pytest.raises(ArithmeticError):
        package.run("any.deck", progress=interrupt)
    assert (tmp_path / "saved").exists()


def test_tables(package):
    """Extremes, events and contacts as pandas has them, against the arrays and the summary."""
    pytest.importorskip("pandas")
    run = package.run(written(".", plain_deck(SHORT)), out="out", write="channels")
    assert len(run.contacts) == run.summary["contacts"] > 0 and run.events.attrs["units"]["impact_speed"] == "m/s"
    assert set(run.contacts["item"]) == {"gudgeon"} and list(run.joints["joint"]) == ["gudgeon"]
    for entry in run.summary["extremes"]:
        row = run.extremes.loc[entry["channel"]]
        assert (row["unit"], row["greatest"], row["least_time"]) == (entry["unit"], entry["greatest"], entry["least_time"])
    frame = run.arrays().to_pandas()
    assert frame.attrs["units"]["slider.velocity.x"] == "m/s" and (frame["slider.velocity.x"].to_numpy() == run["slider.velocity.x"]).all()


def test_dataset(package):
    """Channels as xarray has them."""
    pytest.importorskip("xarray")
    run = package.run(written(".", plain_deck(SHORT)), out="out", write="channels")
    channel = run.channels["slider.velocity.x"]
    assert channel.attrs["units"] == "m/s" and channel.dims == ("time",) and (channel.values == run["slider.velocity.x"]).all()


def test_sweep_and_precision(package):
    """Three clearances against single runs; a sweep with failures warns; the runs of a comparison of two methods."""
    pytest.importorskip("pandas")
    statistics = "\n[statistics]\nchannels = motor.moment\n"
    deck = package.Deck(plain_deck(SHORT) + statistics)
    values = ["0.1 mm", "0.2 mm", "0.5 mm"]
    frame = package.sweep(deck, over={"c": values}, jobs=1)
    assert list(frame["c"]) == [1e-4, 2e-4, 5e-4] and frame.attrs["units"]["motor.moment.rms"] == "N.m" and not any(frame["message"])
    for value, found in zip(values, frame["motor.moment.rms"]):
        assert package.run(deck.having(c=value), out="one", write="numbers").summary["statistics"]["motor.moment.rms"] == found
    assert list(package.sweep(deck, over={"c": values}, cases=True)["motor.moment.rms mean"]) == list(frame["motor.moment.rms"])
    strict = package.Deck(plain_deck([*SHORT, ("analysis.dynamic", "energy_limit", "1e-15")]), name="strict")
    with pytest.warns(RuntimeWarning, match="2 of 2 runs failed"):
        assert list(package.sweep(strict, over={"c": values[:2]}, jobs=1)["exit_code"]) == [6, 6]
    with pytest.raises(package.GudgeonError, match=r"\[sweep\]"):
        package.sweep(deck)
    short = package.Deck(plain_deck([("analysis.dynamic", "end", "0.2 ms")]), name="short")
    frame = package.precision(short, methods=["verner", "dop853"], budget="2s")
    assert set(frame["setting"]) == {"verner", "dop853"} and frame.attrs["units"]["cpu"] == "s"
    assert frame.attrs["summary"]["choice"].startswith("method = ") and os.path.exists("outputs/short_precision/precision.csv")


def test_life(package):
    """A bush that wears by two micrometres: the last row is the end that the summary has."""
    pytest.importorskip("pandas")
    frame = package.life(ROOT / "inputs" / "worn_bush.deck", set={"depth": "12 um"}, out="life")
    last = frame[frame["surface"] == "bearing"].iloc[-1]
    end = frame.attrs["summary"]["wear"]["bearing"]
    assert last["cycles"] == end["cycles"] and last["volume"] == end["bearing"]["volume"]["value"] and frame.attrs["units"]["volume"] == "m^3"


@pytest.mark.parametrize("use", NEEDED)
def test_what_is_missing_is_named(package, monkeypatch, use):
    """Without pandas or xarray, an ImportError says what to install."""
    monkeypatch.setitem(sys.modules, NEEDED[use], None)
    run = package.run(written(".", plain_deck(SHORT)), out="out", write="channels")
    with pytest.raises(ImportError, match=f"{use} needs {NEEDED[use]}.*pip install {NEEDED[use]}"):
        run.events if use == "a table" else run.channels


def test_program_is_found(root, gudgeon, tmp_path):
    """The one named, that beside an installed package, that on PATH; where there is none, an error says so."""
    call(root / "scripts/install", gudgeon, "/opt/mine", tmp_path)
    share = tmp_path / "opt/mine/share/gudgeon"
    say = "import gudgeon; print(gudgeon.program())"
    assert python(say, PYTHONPATH=str(root / "scripts/python"), GUDGEON="/some/program") == "/some/program"
    assert python(say, PYTHONPATH=str(share / "python")) == str(tmp_path / "opt/mine/bin/gudgeon")
    assert python("import gudgeon_reader; print(gudgeon_reader.FORMAT)", PYTHONPATH=str(share)) == "2"
    assert python("import gudgeon_reader; print(gudgeon_reader.FORMAT)", PYTHONPATH=str(root / "scripts")) == "2"
    shutil.copytree(share / "python", tmp_path / "alone/a/b/python")
    alone = f"import sysconfig; sysconfig.get_path = lambda name: '/nowhere'; {say}"
    path = {"PYTHONPATH": str(tmp_path / "alone/a/b/python")}
    assert python(alone, PATH=str(tmp_path / "opt/mine/bin"), **path) == str(tmp_path / "opt/mine/bin/gudgeon")
    code = f"try:\n    import sysconfig; sysconfig.get_path = lambda name: '/nowhere'\n    {say}\nexcept FileNotFoundError as error: print(error)"
    assert "GUDGEON" in python(code, PATH="/nowhere", **path)


def test_pip_installs_it(root, gudgeon, tmp_path):
    """Where pip and setuptools are there: the package alone, without network."""
    for module in ("pip", "setuptools", "wheel"):
        if importlib.util.find_spec(module) is None:
            pytest.skip(f"{module} is not there")
    shutil.copytree(root / "scripts/python", tmp_path / "source", ignore=shutil.ignore_patterns("__pycache__"))
    call(sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-build-isolation", "--no-index", "--target", tmp_path / "there",
         tmp_path / "source")
    assert (tmp_path / "there/gudgeon/py.typed").exists()
    say = f"import gudgeon; print(gudgeon.run({str(DECK)!r}, out={str(tmp_path / 'out')!r}, write='numbers').status)"
    assert python(say, PYTHONPATH=str(tmp_path / "there"), GUDGEON=str(gudgeon)) == "complete"


def test_wheel_has_the_program(root, gudgeon, tmp_path):
    """scripts/make_wheel: checksums of RECORD, and, where pip is there, an installation that finds its program."""
    call(root / "scripts/make_wheel", gudgeon, tmp_path)
    (wheel,) = tmp_path.glob("gudgeon-*.whl")
    with zipfile.ZipFile(wheel) as archive:
        record = list(csv.reader(archive.read(next(n for n in archive.namelist() if n.endswith("/RECORD"))).decode().splitlines()))
        assert [row[0] for row in record] == archive.namelist()
        tags = archive.read(next(n for n in archive.namelist() if n.endswith("/WHEEL"))).decode()
    assert {f"gudgeon/{path.name}" for path in (root / "scripts/python/gudgeon").iterdir() if path.is_file()} <= {row[0] for row in record}
    assert f"Tag: {wheel.stem.split('-', 2)[2]}\n" in tags
    names = {row[0] for row in record}
    told = subprocess.run(["objdump", "-p", gudgeon], capture_output=True, text=True, check=True).stdout
    if "$ORIGIN/../libexec/gudgeon" in told:  # libraries linked into the program: those under the LGPL lie beside it
        shipped = {name.rpartition("/")[2] for name in names if ".data/data/libexec/gudgeon/" in name}
        loaded = subprocess.run(["ldd", gudgeon], capture_output=True, text=True, check=True).stdout
        needed = {name for name in ("libklu.so", "libbtf.so", "libamd.so", "libcolamd.so", "libquadmath.so") if name in loaded}
        assert {"libklu.so", "libbtf.so", "libamd.so", "libcolamd.so"} <= needed <= {name.rpartition(".")[0] for name in shipped}
        notices = {name.rpartition("/")[2] for name in names if "/licences/" in name}
        linked = gudgeon.with_suffix(".linked").read_text()  # archives that a system has: not all of them do
        archives = {"libhdf5_serial.a": "libhdf5-dev", "libsundials_cvode.a": "libsundials-dev", "libgfortran.a": "libgfortran"}
        assert {"README", "LGPL-2.1"} <= notices and any(re.fullmatch(r"libklu[0-9]+\.copyright", name) for name in notices)
        assert all(any(name.startswith(package) for name in notices) for archive, package in archives.items() if archive in linked)
        assert not re.search(r"fftw|LGPL", told, re.I) and not any("fftw" in name for name in names)
    if importlib.util.find_spec("pip") is None:
        pytest.skip("pip is not there")
    call(sys.executable, "-m", "pip", "install", "--quiet", "--no-deps", "--no-index", "--target", tmp_path / "there", wheel)
    program = tmp_path / "there/bin/gudgeon"
    assert python("import gudgeon; print(gudgeon.program())", PYTHONPATH=str(tmp_path / "there")) == str(program)
    assert call(program, "version").stdout == call(gudgeon, "version").stdout
    loaded = subprocess.run(["ldd", program], capture_output=True, text=True, check=True).stdout
    for name in (tmp_path / "there/libexec/gudgeon").glob("*"):
        assert f"{name.name} => {tmp_path / 'there'}" in loaded, "the program takes the libraries of the wheel"


def test_fit(package):
    """Unknowns of a deck from a file, an unknown in a row; a missing file is an error."""
    pytest.importorskip("pandas")
    frame = package.fit(ROOT / "inputs" / "fit_restitution.deck", ROOT / "inputs" / "fit_restitution.csv", out="fit", write="numbers")
    assert list(frame.index) == ["e", "height", "camera.offset"]
    assert (frame["low"] < [0.8, 0.3, 0.002]).all() and (frame["high"] > [0.8, 0.3, 0.002]).all()
    assert frame.attrs["summary"]["fit_search"]["end"] == "converged"
    deck = package.Deck.read(ROOT / "inputs" / "fit_restitution.deck")
    assert package.fit(deck, ROOT / "inputs" / "fit_restitution.csv", out="again", write="numbers").equals(frame), "through a pipe"
    with pytest.raises(package.GudgeonError, match="cannot read"):
        package.fit(ROOT / "inputs" / "fit_restitution.deck", "nowhere.csv")


def test_tolerances_of_positions(package):
    """Frames of a four-bar: derivatives in closed form, parts of the variance, yields, and worst members that are assembled again."""
    pandas = pytest.importorskip("pandas")
    deck = package.Deck.read(ROOT / "inputs" / "tolerance_four_bar.deck")
    study = package.tolerance(deck, out="four_bar")
    a, b, c, d, theta = 0.02, 0.06, 0.05, 0.07, np.radians(30)
    x, y = a*np.cos(theta), a*np.sin(theta)
    e = np.hypot(d - x, y)
    along = (b*b - c*c + e*e)/(2*e)
    across = np.sqrt(b*b - along*along)
    head = x + ((d - x)*along + y*across)/e, y + (-y*along + (d - x)*across)/e
    coupler, rocker = np.arctan2(head[1] - y, head[0] - x), np.arctan2(head[1], head[0] - d)
    size = c*np.sin(rocker - coupler)
    exact = {"a": -np.cos(theta - coupler)/size, "b": -1/size, "c": np.cos(rocker - coupler)/size, "d": np.cos(coupler)/size,
             "theta": a*np.sin(theta - coupler)/size}
    found = study.contributors.loc["request.rocker"]
    assert set(found.index) == set(exact) and found["linear"].is_monotonic_decreasing and abs(found["linear"].sum() - 1) < 1e-12
    assert all(abs(found.loc[name, "derivative"]/slope - 1) < 1e-10 for name, slope in exact.items())
    assert (found["first_low"] < found["linear"]).all() and (found["linear"] < found["first_high"]).all()
    assert list(study.requests.index) == ["request.rocker"] and study.requests.loc["request.rocker", "unit"] == "rad"
    assert abs(study.requests["nominal"].iloc[0]/rocker - 1) < 1e-12
    assert len(study.times) == 2 and len(study.derivatives) == 10 and study.histogram["members"].sum() == 10000
    assert list(study.yields.index) == ["all", "request.rocker"] and (study.yields["low"] < study.yields["value"]).all()
    lowest, highest = study.times["lowest"].iloc[0], study.times["highest"].iloc[0]
    assert list(study.worst["value"]) == [lowest, highest] and isinstance(study.worst, pandas.DataFrame)
    for _, row in study.worst.iterrows():
        values = {name: nominal + row[name] for name, nominal in {"a": a, "b": b, "c": c, "d": d, "theta": theta}.items()}
        again = package.tolerance(deck, out="again", set={name: f"{float(value)!r} {'rad' if name == 'theta' else 'm'}"
                                                          for name, value in values.items()})
        assert abs(again.requests["nominal"].iloc[0] - row["value"]) < 1e-7, "that of the expansion"
    with pytest.raises(ValueError, match="not kept"):
        study.members
    assert package.Tolerances("four_bar").requests.equals(study.requests)
    with pytest.raises(FileNotFoundError, match="no study of tolerances"):
        package.Tolerances("nowhere")
    with pytest.raises(package.GudgeonError, match="tolerance"):
        package.tolerance(written(".", plain_deck(SHORT)), out="none")


THROW = """deck = 1
[scene]
title   = "Throw"
gravity = 0 -10 m/s^2
[parameters]
h = 1 m
v = 4 m/s
[bodies]
name   mass[kg]   inertia[kg.m^2]   y     vy
ball   1          0.1               {h}   {v}
[tolerance]
name   plus_minus   distribution
h      0.1m         uniform
v      0.5m/s       truncated
[tolerance.limit]
name   channel               lower   upper
high   ball.position.y.max   1.6m    2m
[tolerance.study]
members = 30
points  = 10
[analysis.dynamic]
start = given
end   = 1 s
[output]
every = 0.01 s
"""


def test_tolerances_of_runs(package):
    """Heights of throws, h + v^2/(2 g): members and the worst of them, in closed form."""
    pytest.importorskip("pandas")
    study = package.tolerance(package.Deck(THROW, name="throw"), jobs=1)
    members = study.members
    assert len(members) == 30
    np.testing.assert_allclose(members["ball.position.y.max"], members["h"] + members["v"]**2/20, rtol=1e-9)
    np.testing.assert_allclose(study.contributors.loc["ball.position.y.max"].loc[["v", "h"], "derivative"], [0.4, 1.0], rtol=1e-8)
    for row, at in zip(study.worst.to_dict("records"), (members["ball.position.y.max"].idxmin(), members["ball.position.y.max"].idxmax())):
        assert row["member"] == at + 1 and row["value"] == members["ball.position.y.max"][at]
        np.testing.assert_allclose([1 + row["h"], 4 + row["v"]], members.loc[at, ["h", "v"]].astype(float), rtol=1e-14)
    good = members["ball.position.y.max"].between(1.6, 2).sum()
    assert study.yields.loc["all", "good"] == good and study.yields.loc["all", "value"] == good/30
