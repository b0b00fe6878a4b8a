"""Films beside everything else: places and tilts, every method, repeats bit for bit, sweeps, statistics, chosen tolerances."""

import csv
import math

import h5py
import numpy as np
import pytest
from conftest import ROOT
from film_decks import BEARING, film_run
from support import Run, assert_close, call, changed, scratch, written

TILT, AWAY = math.radians(37), (3000, -2000)  # [rad], [mm]


def moved(tilt=TILT, away=AWAY):
    """The journal bearing elsewhere, its load and its weight turned."""
    text = BEARING.read_text()
    x, y = away
    for name, rest in (("shaft     1          2.5e-4            ", "0       0"), ("journal   0.13       2.5e-4            ", "0       0"),
                       ("housing   ground    ", "0        0")):
        assert name + rest in text
        text = text.replace(name + rest, f"{name}{x}   {y}")
    text = text.replace("0 -9.81 m/s^2", f"{9.81 * math.sin(tilt):.17g} {-9.81 * math.cos(tilt):.17g} m/s^2")
    return text.replace("name     point    fy\nweight   centre   {-load}",
                        f"name     point    fx   fy\nweight   centre   {{load*sin({tilt:.17g})}}   {{-load*cos({tilt:.17g})}}")


def run_of(gudgeon, text, *options, expect=0):
    """A run of a deck's text, numbers only."""
    out = scratch() / "out"
    return Run(out, call(gudgeon, "run", written(scratch(), text), "--out", out, "--write", "channels", *options, expect=expect))


@pytest.mark.parametrize("film", ["finite", "short_gumbel", "pinkus_sternlicht", "grid"])
def test_moved_and_tilted(gudgeon, film):
    """Bearing, load and weight turned by 37 degrees, 3.6 m away: the same orbit, turned."""
    options = ("--set", f"film={film}", "--set", f"duration={'15ms' if film == 'grid' else '50ms'}", "--tolerance", "1e-9")
    here = run_of(gudgeon, BEARING.read_text(), *options).item("clearances/eccentricity", "bearing")
    there = run_of(gudgeon, moved(), *options).item("clearances/eccentricity", "bearing")
    turn = np.array([[math.cos(TILT), math.sin(TILT)], [-math.sin(TILT), math.cos(TILT)]])
    assert_close(there, here @ turn, absolute=1e-5 * 0.2e-3, what=film)


@pytest.mark.parametrize("method", ["verner", "adams", "ida", "rk4"])
@pytest.mark.parametrize("film", ["finite", "short_exact"])
def test_every_method(gudgeon, film, method):
    """Twenty milliseconds by each method as by bdf at 1e-13."""
    settings = {"film": film, "duration": "20ms"}
    right = film_run(gudgeon, BEARING, **settings).item("clearances/eccentricity_ratio", "bearing")
    if method == "rk4":
        text = changed(BEARING.read_text(), "analysis.dynamic", method="rk4", step="0.2 us", tolerance=None)
        run = run_of(gudgeon, text, "--set", f"film={film}", "--set", "duration=20ms")
    else:
        run = film_run(gudgeon, BEARING, "--method", method, "--tolerance", "1e-9", **settings)
    assert_close(run.item("clearances/eccentricity_ratio", "bearing"), right, absolute=5e-6, what=f"{film}, {method}")


@pytest.mark.parametrize("method", ["radau", "bdf", "ida"])
@pytest.mark.parametrize("tolerance", ["1e-2", "1e-3", "1e-5"])
@pytest.mark.parametrize("deck, joint, settings", [("slider_crank_lubricated", "gudgeon", {"turns": 2}),
                                                   ("big_end", "big_end", {"cycles": 1})])
def test_loose_tolerances(gudgeon, deck, joint, settings, tolerance, method):
    """Methods whose steps no stiffness holds short keep the journal in its bearing, however loose the tolerance, where explicit ones
    of a tight tolerance have it."""
    deck = ROOT / "inputs" / f"{deck}.deck"
    right = film_run(gudgeon, deck, "--method", "verner", "--tolerance", "1e-6", **settings)
    run = film_run(gudgeon, deck, "--method", method, "--tolerance", tolerance, **settings)
    assert run.summary["status"] == "complete"
    ratio, expected = (one.item("clearances/eccentricity_ratio", joint) for one in (run, right))
    assert_close(ratio.max(), expected.max(), absolute=0.02, what="greatest eccentricity over clearance")
    assert np.sqrt(np.mean((ratio - expected) ** 2)) < 0.02


def test_grid_repeats_itself(gudgeon):
    """The pressures that a grid begins with are those of the solution before, and leave no trace: two runs are equal bit for bit."""
    runs = [run_of(gudgeon, BEARING.read_text(), "--set", "film=grid", "--set", "duration=4ms", "--tolerance", "1e-8") for _ in range(2)]
    for path in ("bodies/position", "clearances/film_force", "clearances/film_pressure", "energy/dissipated_film"):
        assert np.array_equal(*(run.read(path) for run in runs)), path


SWEPT = """
[statistics]
after    = 0.9 s
channels = bearing.eccentricity_ratio bearing.film_thickness

[sweep]
film      = short_exact finite
viscosity = 100 400 cP
c         = 0.1 0.2 mm
"""


def test_sweep(gudgeon):
    """Film, viscosity and clearance swept: thicker oil and less clearance carry at less eccentricity; each run is that of `run`."""
    deck = written(scratch(), changed(BEARING.read_text(), "output", figures=None, channels="bearing.*") + SWEPT)
    out = scratch() / "out"
    call(gudgeon, "sweep", deck, "--set", "duration=1s", "--out", out)
    with (out / "cases.csv").open() as file:
        rows = [row for row in csv.reader(file) if row and not row[0].startswith("#")]
    head, cases = rows[0], rows[1:]
    assert len(cases) == 8
    column = next(k for k, name in enumerate(head) if "bearing.eccentricity_ratio.mean" in name)
    values = [float(row[column]) for row in cases]
    for film in (0, 4):
        thin_small, thin_wide, thick_small, thick_wide = values[film : film + 4]
        assert thick_small < thin_small < thin_wide and thick_small < thick_wide < thin_wide
    alone = run_of(gudgeon, deck.read_text(), "--set", "duration=1s", "--set", "film=finite", "--set", "viscosity=400cP", "--set", "c=0.2mm")
    with h5py.File(alone.directory / "run.h5") as file:
        names = [name.decode() for name in file["statistics/names"][()]]
        number = file["statistics/values"][names.index("bearing.eccentricity_ratio.mean")]
    assert values[-1] == pytest.approx(number, rel=1e-12)


def test_chosen_tolerance(gudgeon):
    """`--accuracy` on a film: the tolerance it takes gives what it claims."""
    text = changed(BEARING.read_text(), "output", channels="bearing.eccentricity_ratio", figures=None)
    run = run_of(gudgeon, text, "--set", "film=finite", "--set", "duration=0.1s", "--accuracy", "1e-5")
    right = run_of(gudgeon, text, "--set", "film=finite", "--set", "duration=0.1s", "--tolerance", "1e-13")
    found, exact = (r.item("clearances/eccentricity_ratio", "bearing").ravel() for r in (run, right))
    assert_close(found, exact, absolute=1e-5 * np.abs(exact).max())


def test_a_wild_trial_step_is_tried_again(gudgeon_debug):
    """Stages of a step far too long for a stiff film grow beyond all bounds: with run-time checks, too, the step is made shorter."""
    directory = scratch()
    call(gudgeon_debug, "run", ROOT / "inputs" / "slider_crank_lubricated.deck", "--method", "dop853", "--tolerance", "1e-6",
         "--out", directory / "out", "--write", "numbers", "--quiet")
    assert Run(directory / "out").summary["status"] == "complete"


TOGGLE = """deck = 1
[scene]
gravity = 0 -9.81 m/s^2
[bodies]
name   mass[kg]   inertia[kg.m^2]   x[mm]               y[mm]                       angle[deg]
upper  1          4e-3              {50mm*sin(20deg)}   {300mm - 50mm*cos(20deg)}   -70
lower  1          4e-3              {50mm*sin(20deg)}   {300mm - 150mm*cos(20deg)}  -110
ram    5          2e-2              0                   {300mm - 200mm*cos(20deg)}  0
[points]
name   body     xi[mm]   eta[mm]
top    ground   0        300
base   ground   0        0
side   ground   250      200
u1     upper    -50      0
u2     upper    50       0
l1     lower    -50      0
l2     lower    50       0
r      ram      0        0
[joint.revolute]
name   i     j
head   top   u1
foot   l2    r
[joint.translational]
name   i      j   axis
ways   base   r   y
[clearance.revolute]
name   bearing   journal   bearing_radius[mm]   clearance   length[mm]   film     lubricant   level        film_torque
knee   u2        l1        15                   0.05mm      20           finite   oil         lubricated   on
[film.finite]
name
finite
[lubricant]
name   grade        temperature
oil    iso_vg_100   50degC
[driver.distance]
name   i      j    distance
jack   side   u2   {255 mm - 8mm*sin(2*pi*2Hz*t)}
[force.spring]
name   i      j   law                                    damping[N.s/m]   free_length[mm]
work   base   r   {50 N/mm*x + 2e5 N/m^2 * x*abs(x)}     20               120
[analysis.dynamic]
end       = 1 s
method    = radau
tolerance = 1e-7
[output]
every    = 0.5 ms
"""


def test_rows_between_steps_stay_within_the_film(gudgeon):
    """A knee pressed for a second on a film of a thousandth of its clearance: rows between the steps are within the clearance as the steps
    are, and the jack feels what it feels of an ideal knee, to a hundredth, where curves through states told of kilonewtons and more."""
    ideal = run_of(gudgeon, TOGGLE, "--ideal")
    for tolerance in ("3e-7", "1e-7", "1e-8"):
        loose = run_of(gudgeon, TOGGLE, "--tolerance", tolerance)
        assert np.linalg.norm(loose.item("clearances/eccentricity", "knee"), axis=-1).max() < 0.05e-3
        late = loose.read("time") > 0.25
        assert np.abs(loose.item("drivers/force", "jack")[late]).max() < 1.01 * np.abs(ideal.item("drivers/force", "jack")).max()
