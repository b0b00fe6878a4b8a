"""Work in proportion to the size of the deck: four times the rows may take hardly more than four times the processor time."""

import os
import subprocess

import h5py
import pytest
from support import Run, call, cost, scratch, written

RATIO = 8.0  # allowed between n and 4 n: 4 of what is linear, 16 of what is quadratic
ROUNDS = 3   # a machine that others use: the least of so many counts


def scene(parameters="", bodies="", points="", tables="", end="10 ms", output=""):
    """A pendulum and whatever stands beside it."""
    return f"""deck = 1
[scene]
title = "growth"
[parameters]
{parameters}
[bodies]
name mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg]
rod 1 1 0 0 0
{bodies}
[points]
name body xi[m] eta[m]
wall ground 0 0
top rod 0 0
{points}
[joint.revolute]
name i j
pin wall top
{tables}
[analysis.dynamic]
end = {end}
[output]
every = 5 ms
{output or "channels = rod.position"}
"""


def lines(n, line):
    """n lines, their numbers put in."""
    return "".join(line.format(k=k, before=k - 1) + "\n" for k in range(1, n + 1))


def words(n, word):
    """n words in a line."""
    return " ".join(word.format(k=k) for k in range(1, n + 1))


def balls(n):
    """n free bodies."""
    return lines(n, "b{k} 1 1 {k} 0 0")


# name: verb, n, deck of n
GROWING = {
    "parameters, each from the one before": ("check", 8000, lambda n: scene("q0 = 1 m\n" + lines(n, "q{k} = {{q{before} + 1 m}}"))),
    "parameters and rows that use them": ("check", 4000, lambda n: scene(
        lines(n, "q{k} = {k} kg"), bodies=lines(n, "b{k} {{q{k}}} 1 {k} 0 0"))),
    "functions and loads that call them": ("check", 3000, lambda n: scene(tables="[function.harmonic]\nname amplitude angular_frequency\n"
        + lines(n, "h{k} 20N 3rad/s") + "[force.point]\nname point fx\n" + lines(n, "f{k} top {{h{k}(t)}}"))),
    "periods of the statistics": ("check", 500000, lambda n: scene(
        tables=f"[statistics]\nafter = 0 s\nperiod = {1/n:.17g} s\nchannels = rod.position.x", end="1 s")),
    "turns of the statistics": ("check", 100000, lambda n: scene(
        bodies="crank 1 1 0 0 0", points="axle crank 0 0", end="1 s",
        tables=f"bearing wall axle\n[driver.speed]\nname joint speed[rad/s]\nmotor bearing {{2*pi*{n}s^-1}}\n"
               "[statistics]\nafter = 0 s\nperiod = 1 turns of motor\nchannels = rod.position.x")),
    "channels that are written": ("check", 4000, lambda n: scene(bodies=balls(n), output="channels = " + words(n, "b{k}.position.x"))),
    "channels of the statistics": ("check", 4000, lambda n: scene(
        bodies=balls(n), tables="[statistics]\nafter = 0 s\nchannels = " + words(n, "b{k}.position.x"))),
    "statistics that are worked out": ("run", 1000, lambda n: scene(
        bodies=balls(n), tables="[statistics]\nafter = 0 s\nchannels = " + words(n, "b{k}.position.x"))),
    "values of a sweep": ("check", 8000, lambda n: scene("c = 1 mm", tables="[sweep]\nc = " + words(n, "{k}mm"))),
    "a range of a sweep": ("check", 20000, lambda n: scene("c = 1 mm", tables=f"[sweep]\nc = 1 .. 2 mm in {n}")),
    "parameters of a sweep": ("check", 5000, lambda n: scene(
        lines(n, "c{k} = 1 mm"), tables="[sweep]\ncombine = paired\n" + lines(n, "c{k} = 1 2 mm"))),
    "samples of a function": ("run", 20000, lambda n: scene(
        tables="[function.samples]\nname at value\nf \"" + words(n + 2, "{k}") + "\" \"" + words(n + 2, "{k}") + "\"")),
    "conditions that end a run": ("run", 1500, lambda n: scene(tables="[guards]\nstop = " + " or ".join(f"rod.angle > {k} rad" for k in range(9, n + 9)))),
    "points": ("run", 5000, lambda n: scene(points=lines(n, "p{k} rod {k} 0"))),
    "bodies": ("run", 1500, lambda n: scene(bodies=balls(n))),
    "forces": ("explain", 3000, lambda n: scene(points=lines(n, "p{k} rod {k} 0"),
        tables="[force.point]\nname point fx\n" + lines(n, "f{k} p{k} {{1N*sin(1rad/s*t)}}"))),
    "loose joints": ("explain", 1500, lambda n: scene(
        bodies=balls(n), points=lines(n, "p{k} b{k} 0 0\ng{k} ground {k} 0"),
        tables="[material]\nname young[GPa] poisson\nsteel 207 0.3\n[contact.hertz]\nname\nhard\n[clearance.revolute]\n"
               "name bearing journal bearing_radius[mm] clearance[mm] material law\n" + lines(n, "c{k} g{k} p{k} 10 0.5 steel hard"))),
}


def cpu_of(gudgeon, verb, text, expect=0, said=""):
    """Processor time of a command with a deck [s]."""
    directory = scratch()
    command = [str(gudgeon), verb, str(written(directory, text))]
    if verb == "run":
        command += ["--out", str(directory / "out"), "--quiet"]
    used = cpu_of_command(command, directory, (expect,))
    assert said in (directory / "said").read_text()
    return used


def cpu_of_command(command, directory, expect):
    """Processor time of a command [s]."""
    with open(directory / "said", "w", encoding="utf-8") as said:
        child = subprocess.Popen(command, stdout=said, stderr=said)
        _, status, used = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    assert child.returncode in expect, (directory / "said").read_text()[-2000:]
    return used.ru_utime + used.ru_stime


@pytest.mark.parametrize("name", GROWING)
def test_time_grows_with_the_size(gudgeon, name):
    """The start of the program, which is the same for both, is taken off."""
    verb, n, deck = GROWING[name]
    measured = []
    for _ in range(ROUNDS):
        empty, one, four = (cpu_of(gudgeon, verb, deck(size)) for size in (2, n, 4*n))
        measured.append((four - empty)/max(one - empty, 1e-2))
        if measured[-1] <= RATIO:
            break
    assert min(measured) <= RATIO, f"{name}: {measured} times from {n} to {4*n}"


# a command of n that ends with a mistake: verb, n, deck, what is said
REFUSED = {
    "channels of a figure": (10000, lambda n: scene(output="figures = " + "rod.angle+"*n + "rod.angle"), "names too many channels"),
    "a word within a figure": (60000, lambda n: scene(output=f"figures = strip(n={'1'*n})"), "n=11"),
    "columns that stand twice": (10000, lambda n: scene().replace("name mass[kg]", "name " + "angle "*n + "mass[kg]"), "is given twice"),
}


@pytest.mark.parametrize("name", REFUSED)
def test_mistakes_are_found_in_time(gudgeon, name):
    """The same of decks with a mistake."""
    n, deck, said = REFUSED[name]
    measured = []
    for _ in range(ROUNDS):
        empty, one, four = (cpu_of(gudgeon, "check", deck(size), 3, said) for size in (20, n, 4*n))
        measured.append((four - empty)/max(one - empty, 1e-2))
        if measured[-1] <= RATIO:
            break
    assert min(measured) <= RATIO, f"{name}: {measured} times from {n} to {4*n}"


def table(n, rows=4):
    """Columns of numbers with names and units."""
    head = ",".join(["time [s]"] + [f"b{k}.position.x [m]" for k in range(1, n + 1)])
    return "\n".join([head] + [",".join(f"{row*5e-3 + 0.1*k:g}" for k in range(n + 1)) for row in range(rows)]) + "\n"


def test_time_of_a_comparison_grows_with_its_columns(gudgeon):
    """A run against columns with the names of its channels: those are looked up, not searched for one by one."""
    used = []
    for n in (2, 1500, 6000):
        directory = scratch()
        deck = written(directory, scene(bodies=balls(n), output="channels = *.position.x"))
        call(gudgeon, "run", deck, "--out", directory / "run", "--quiet")
        written(directory, table(n), "columns.csv")
        used.append(min(cpu_of_command([str(gudgeon), "compare", str(directory / "run" / "run.h5"), str(directory / "columns.csv"), "--out",
                                        str(directory / "compared"), "--quiet"], directory, (1,)) for _ in range(2)))
    empty, one, four = used
    assert (four - empty)/max(one - empty, 1e-2) <= RATIO, used


def test_files_that_include_one_another_are_read_once(gudgeon):
    """Twelve files, each of which includes the next ten times: 10^11 readings, if each were followed."""
    directory = scratch()
    for k in range(12):
        (directory / f"f{k}.inc").write_text(f'include "f{k + 1}.inc"\n'*10 if k < 11 else "[material]\nname young[GPa] poisson\nsteel 207 0.3\n")
    deck = written(directory, scene() + 'include "f0.inc"\n')
    call(gudgeon, "run", deck, "--out", directory / "out", "--quiet", limit=20)
    found = []
    with h5py.File(directory / "out" / "run.h5", "r") as file:
        file["deck_includes"].visititems(lambda name, item: found.append(name) if isinstance(item, h5py.Dataset) else None)
    assert len(found) == 12


def test_links_that_include_themselves_end(gudgeon):
    """A folder that holds a link to itself gives a file ever new paths: the depth is limited, with a message."""
    directory = scratch()
    (directory / "again").symlink_to(directory)
    (directory / "self.inc").write_text('include "again/self.inc"\n')
    done = call(gudgeon, "check", written(directory, scene() + 'include "self.inc"\n'), expect=3)
    assert "nested includes exceed the limit of 16 deep" in done.stderr


def test_too_much_text_is_refused(gudgeon):
    """Five files of 60 MB: each would be taken, all together not."""
    directory = scratch()
    comment = "#" + "x"*99 + "\n"
    for k in range(5):
        (directory / f"f{k}.inc").write_text(comment*600000)
    done = call(gudgeon, "check", written(directory, scene() + "".join(f'include "f{k}.inc"\n' for k in range(5))), expect=3)
    assert "the deck with its includes exceeds 256000000 bytes" in done.stderr


@pytest.mark.parametrize("every, count", (("1e-19 s", "1e19"), ("1e-49 s", "1e49"), ("1 ns", "1000000001"), ("0.1 us", "10000001")))
def test_absurd_output_intervals_are_refused(gudgeon, every, count):
    """No overflow to no instants at all, and no terabytes: the number of instants, at the cell."""
    done = call(gudgeon, "check", written(scratch(), scene(end="1 s").replace("every = 5 ms", f"every = {every}")), expect=3)
    assert f"the run would have {count} output times, the limit is 10000000" in done.stderr
    assert f"every = {every}" in done.stderr and "instants_limit" in done.stderr


def test_many_output_instants_may_be_allowed(gudgeon):
    """The limit is the deck's."""
    text = scene(end="1 s").replace("every = 5 ms", "every = 50 ns")
    call(gudgeon, "check", written(scratch(), text), expect=3)
    call(gudgeon, "check", written(scratch(), text + "instants_limit = 3e7\n"))


@pytest.mark.parametrize("period", ("1e-49 s", "1e-9 turns of motor"))
def test_absurd_periods_are_refused(gudgeon, period):
    """Stroboscopic instants have the same limit."""
    text = scene(bodies="crank 1 1 0 0 0", points="axle crank 0 0", end="1 s",
                 tables="bearing wall axle\n[driver.speed]\nname joint speed[rad/s]\nmotor bearing 10\n"
                        f"[statistics]\nafter = 0 s\nperiod = {period}\nchannels = rod.position.x")
    done = call(gudgeon, "check", written(scratch(), text), expect=3)
    assert "the run would have more than 10000000 periods" in done.stderr


SPEED = "[driver.speed]\nname joint speed[rad/s]\nmotor bearing 10"
ANGLE = "[driver.angle]\nname joint angle\nmotor bearing {10rad/s*t+0.1rad*sin(3rad/s*t)}"


@pytest.mark.parametrize("driver, end, period, every, refused", (
    (SPEED, 1.6e13, 1, "", "period = 1 turns of motor"),
    (SPEED, 1.6e13, 1, "every = 5 ms", "every = 5 ms"),
    (ANGLE, 1.6e5, 1e-3, "", "period = 0.001 turns of motor")))
def test_an_absurd_end_is_refused(gudgeon, driver, end, period, every, refused):
    """An end that is far off for its turns: told at the cell that asks for too much, and at once."""
    text = scene(bodies="crank 1 1 0 0 0", points="axle crank 0 0", end=f"{end} turns of motor",
                 tables=f"bearing wall axle\n{driver}\n[statistics]\nafter = 0 s\nperiod = {period} turns of motor\n"
                        "channels = rod.position.x").replace("every = 5 ms", every)
    done = call(gudgeon, "check", written(scratch(), text), expect=3, limit=20)
    assert f"| {refused}\n" in done.stderr and "too many" in done.stderr


def pendulum(end, analysis="dynamic", settings="", every="1 s"):
    """A rod that falls from the horizontal; one with a driver for a kinematic analysis."""
    text = scene(points="side rod 0.5 0", end=end, tables="[force.torque]\nname body moment\nturn rod {1N.m*sin(3rad/s*t)}")
    if analysis == "kinematic":
        text = text.replace("[force.torque]", "[driver.speed]\nname joint speed[rad/s]\nmotor pin 10\n[force.torque]")
    return text.replace("analysis.dynamic", f"analysis.{analysis}").replace(f"end = {end}", f"end = {end}\n{settings}").replace(
        "every = 5 ms", f"every = {every}")


@pytest.mark.parametrize("analysis, every", (("dynamic", "100 s"), ("kinematic", "1 s")))
def test_processor_time_ends_a_run(gudgeon, analysis, every):
    """After its time a run ends with code 5, keeps what it wrote and says why; a run that needs less is not touched."""
    directory = scratch()
    deck = written(directory, pendulum("1e6 s", analysis, "limit_cpu = 0.5 s", every))
    done = call(gudgeon, "run", deck, "--out", directory / "out", "--quiet", expect=5, limit=60)
    assert "the run exceeded its CPU time limit (limit_cpu)" in done.stderr
    run = Run(directory / "out")
    assert run.summary["status"] == "failed" and "limit_cpu" in run.summary["message"]
    assert run.summary["cpu_seconds"] <= 5
    assert len(run.time) > 3 and run.time[-1] < 1e6
    short = written(directory, pendulum("5 s", analysis, "limit_cpu = 1 h"), "short.deck")
    call(gudgeon, "run", short, "--out", directory / "short", "--quiet")


def test_a_long_run_takes_no_more_memory(gudgeon):
    """Ten times the motion with as many output instants: the memory stays, what is kept of a step is not."""
    used = []
    for end in ("2000 s", "20000 s"):
        directory = scratch()
        deck = written(directory, pendulum(end, every=f"{float(end[:-2])/10:g} s"))
        used.append(cost([gudgeon, "run", deck, "--quiet", "--out", directory / "out"])[1])
    assert used[1] - used[0] <= 1, f"MB {used}"
