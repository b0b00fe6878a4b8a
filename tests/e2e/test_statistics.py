"""Statistics of a motion against the same numbers worked out from the series and the events of run.h5."""

import functools
import re

import h5py
import numpy as np
from scipy.integrate import solve_ivp
from support import DECK, ROOT, Run, assert_close, call, changed, plain_deck, scratch, written

TURN = 0.012  # seconds, at 5000 rpm
AFTER, END = 2 * TURN, 6 * TURN
CHANNELS = ("motor.moment", "slider.velocity.x")


@functools.lru_cache(maxsize=None)
def studied(program):
    """Six turns of the dry slider-crank, the first two a transient."""
    directory = scratch()
    text = plain_deck([("analysis.dynamic", "end", "6 turns of motor"), ("output", "every", "20 us")])
    text += (
        "\n[statistics]\nafter = 2 turns of motor\nperiod = 1 turns of motor\n"
        f"channels = {' '.join(CHANNELS)}\nspectra = motor.moment\nbins = 7\n"
    )
    call(program, "run", written(directory, text), "--out", directory / "out", "--quiet")
    return Run(directory / "out")


def numbers_of(run):
    """The statistics by name, from run.h5; summary.json says the same."""
    numbers = dict(zip(run.read("statistics/names"), run.read("statistics/values")))
    told = {name: np.nan if value is None else value for name, value in run.summary["statistics"].items()}
    assert told.keys() == numbers.keys()
    assert np.array_equal([told[name] for name in numbers], list(numbers.values()), equal_nan=True)
    return numbers


def windowed(run, channel, rows=False):
    """The series of a channel from the end of the transient on: the output instants, or all rows."""
    read = run.rows if rows else run.read
    place = list(run.read("bodies/names")).index("slider")
    series = read("drivers/moment")[:, 0] if channel == CHANNELS[0] else read("bodies/velocity")[:, place, 0]
    inside = read("time") >= AFTER - 1e-12
    return read("time")[inside], series[inside]


def test_numbers_of_channels(gudgeon):
    run = studied(gudgeon)
    numbers = numbers_of(run)
    for channel in CHANNELS:
        t, x = windowed(run, channel)
        span = t[-1] - t[0]
        mean = np.sum((x[1:] + x[:-1]) / 2 * np.diff(t)) / span
        rms = np.sqrt(np.sum((x[1:] ** 2 + x[:-1] ** 2) / 2 * np.diff(t)) / span)
        assert_close(numbers[f"{channel}.mean"], mean, 1e-9 * rms, what=channel)
        assert_close(numbers[f"{channel}.rms"], rms, relative=1e-12, what=channel)
        x = windowed(run, channel, rows=True)[1]
        rise = 2e-3 * np.abs(x).max()  # what extremes between rows may add
        assert x.min() - rise <= numbers[f"{channel}.min"] <= x.min()
        assert x.max() <= numbers[f"{channel}.max"] <= x.max() + rise
        assert numbers[f"{channel}.peak"] == max(abs(numbers[f"{channel}.min"]), abs(numbers[f"{channel}.max"]))


def test_contacts_are_counted_from_the_events(gudgeon):
    run = studied(gudgeon)
    numbers = numbers_of(run)
    contacts = run.contacts
    end = np.where(np.isfinite(contacts["duration"]), contacts["time"] + contacts["duration"], END)
    closed = np.clip(np.minimum(end, END) - np.maximum(contacts["time"], AFTER), 0, None).sum()
    assert_close(numbers["gudgeon.contact_fraction"], closed / (END - AFTER), 1e-12)
    inside = contacts[(contacts["time"] >= AFTER) & (contacts["time"] < END)]
    assert 2 < len(inside) < len(contacts)
    assert numbers["gudgeon.impacts"] == len(inside)
    assert_close(numbers["gudgeon.impacts_per_period"], len(inside) / 4, relative=1e-12)
    assert_close(numbers["gudgeon.impacts_per_second"], len(inside) / (END - AFTER), relative=1e-12)
    for name in ("impact_speed", "peak_force"):
        assert numbers[f"gudgeon.{name}.max"] == inside[name].max()
        assert_close(numbers[f"gudgeon.{name}.mean"], inside[name].mean(), relative=1e-12)
        row = list(run.read("statistics/histogram_names")).index(f"gudgeon.{name}")
        counts, edges = np.histogram(inside[name], bins=7, range=(0, inside[name].max()))
        assert np.array_equal(run.read("statistics/histogram_counts")[row], counts)
        assert_close(run.read("statistics/histogram_edges")[row], edges, relative=1e-14)


def test_the_contact_fraction_is_that_of_the_series(gudgeon):
    """On a fine grid the share of instants with contact comes near; the events are exact."""
    run = studied(gudgeon)
    state = run.read("clearances/contacts/state")[:, 0][run.time >= AFTER]
    assert_close(numbers_of(run)["gudgeon.contact_fraction"], np.mean(state == 1), 0.02)


def test_stroboscopic_samples_are_the_motion_at_multiples_of_the_period(gudgeon):
    run = studied(gudgeon)
    times = run.read("statistics/strobe_time")
    assert_close(times, TURN * np.arange(2, 7), relative=1e-14)
    names = list(run.read("statistics/strobe_names"))
    for channel in CHANNELS:
        t, x = windowed(run, channel)
        at = [np.argmin(np.abs(t - time)) for time in times]  # the grid happens to hold these instants
        scale = np.abs(x).max()
        assert_close(run.read("statistics/strobe")[:, names.index(channel)], x[at], 1e-9 * scale, what=channel)


def test_statistics_leave_the_motion_alone(gudgeon):
    """The same run without them has the very same series."""
    directory = scratch()
    text = plain_deck([("analysis.dynamic", "end", "6 turns of motor"), ("output", "every", "20 us")])
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    plain, run = Run(directory / "out"), studied(gudgeon)
    for path in ("time", "drivers/moment", "bodies/velocity", "clearances/eccentricity"):
        assert plain.read(path).tobytes() == run.read(path).tobytes(), path


def test_spectrum_is_that_of_numpy(gudgeon):
    run = studied(gudgeon)
    t, x = windowed(run, CHANNELS[0])
    n = len(x)
    window = 0.5 * (1 - np.cos(2 * np.pi * np.arange(n) / n))
    x = x - np.sum(window * x) / np.sum(window)
    amplitude = 2 * np.abs(np.fft.rfft(window * x)) / np.sum(window)
    assert_close(run.read("statistics/frequency"), np.fft.rfftfreq(n, 20e-6), relative=1e-9, absolute=1e-9)
    assert_close(run.read("statistics/spectrum")[:, 0], amplitude, 1e-9 * amplitude.max())


SINES = """deck = 1
[bodies]
name  mass[kg] inertia[kg.m^2] x[m] y[m] angle[deg]
ram   1        1               0    0    0
bob   1        1               1    0    0
[points]
name  body    xi[m] eta[m]
floor ground  0     0
foot  ram     0     0
tip   bob     0     0
[joint.translational]
name  i     j     axis
slide floor foot  x
rail  floor tip   x
[driver.position]
name  i     j     axis position
push  floor foot  x    {2mm*sin(2*pi*50Hz*t) + 0.3mm*cos(2*pi*120Hz*t) + 1mm}
[analysis.dynamic]
end = 1.00 s
[output]
every = 1 ms
figures = spectrum(ram.position.x) section(ram.position.x,ram.velocity.x)
[statistics]
after  = 1 ms
period = 0.02 s
"""


def test_spectrum_of_known_sines(gudgeon):
    """A sum of two sines on the lines of the spectrum: each has its own amplitude there, and a drawn figure."""
    directory = scratch()
    call(gudgeon, "run", written(directory, SINES), "--out", directory / "out", "--quiet")
    run = Run(directory / "out")
    frequency, amplitude = run.read("statistics/frequency"), run.read("statistics/spectrum")[:, 0]
    assert_close(np.diff(frequency), 1.0, 1e-9)
    for f, a in ((50, 2e-3), (120, 0.3e-3)):
        assert_close(amplitude[f], a, relative=1e-6, what=f"{f} Hz")
    far = np.abs(frequency[:, None] - [0, 50, 120]).min(axis=1) > 1.5
    assert amplitude[far].max() < 1e-9
    assert {name.split("/")[1].split(".")[0] for name in run.summary["figures"]} == {"spectrum", "section"}
    _, rows = run.table("figures/section.ram.position.x.ram.velocity.x.dat")
    t = np.array([float(row[0]) for row in rows])
    assert_close(t, 0.02 * np.arange(1, 51), relative=1e-12)
    x = np.array([float(row[1]) for row in rows])
    assert_close(x, 1e-3 + 0.3e-3 * np.cos(2 * np.pi * 120 * t), 1e-9)


def test_section_of_a_pendulum_with_a_known_response(gudgeon):
    """The shaken pendulum on an ideal pin with a damper: its section contracts to one point, at the angle and speed that an
    independent integration of the equation of motion gives."""
    text = (ROOT / "inputs" / "shaken_pendulum.deck").read_text()
    text = changed(text, "analysis.dynamic", end="20 s")
    text = changed(text, "output", every="50 ms", channels="rod.angle", figures="section(rod.angle,rod.angular_velocity)")
    text = text.replace("0.3N*sin", "0N*sin").replace("-0.002 N.m*sin", "0 N.m*sin")
    text += "\n[force.torsion_spring]\nname i j stiffness[N.m/rad] damping[N.m.s/rad]\noil crank rod 0 0.1\n"
    text += "\n[statistics]\nafter = 10 s\nperiod = 0.5 s\n"
    directory = scratch()
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--ideal", "--quiet")
    run = Run(directory / "out")
    section = run.read("statistics/strobe")
    assert len(section) == 21
    assert np.ptp(section[10:], axis=0).max() < 1e-6

    def crank(t):
        f = 20 * np.pi / 180 * np.sin(4 * np.pi * t)
        d = 20 * np.pi / 180 * 4 * np.pi * np.cos(4 * np.pi * t)
        return f, d, -((4 * np.pi) ** 2) * f

    first = 0.1 * 0.1 + 0.5 * 0.2
    inertia = 3e-4 + 0.1 * 0.1**2 + 2e-4 + 0.5 * 0.2**2

    def motion(t, y):
        """Angles from the vertical; the tip of the crank is 50 mm below its pivot."""
        f, d, dd = crank(t)
        ax = 0.05 * (dd * np.cos(f) - d**2 * np.sin(f))
        ay = 0.05 * (dd * np.sin(f) + d**2 * np.cos(f))
        moment = -first * (ax * np.cos(y[0]) + (ay + 9.81) * np.sin(y[0])) - 0.1 * (y[1] - d)
        return [y[1], moment / inertia]

    done = solve_ivp(motion, (0, 40), [0, 0], rtol=1e-11, atol=1e-12, method="DOP853")
    angle, speed = done.y[0, -1] - np.pi / 2, done.y[1, -1]
    assert_close(section[-1], [angle, speed], 2e-6)


def test_layout_of_the_statistics(gudgeon):
    """Every dataset of the group is described, and has the shape that its names tell."""
    run = studied(gudgeon)
    with h5py.File(run.directory / "run.h5", "r") as file:
        group = file["statistics"]
        m, s = len(group["names"]), len(group["strobe_names"])
        assert group["units"].shape == group["values"].shape == (m,)
        assert len(group["values"].attrs["units"].split()) == m
        assert group["strobe"].shape == (len(group["strobe_time"]), s)
        assert group["strobe"].attrs["units"].split() == ["N.m", "m/s"]
        assert group["spectrum"].shape == (len(group["frequency"]), len(group["spectrum_names"]))
        assert group["histogram_edges"].shape == (len(group["histogram_names"]), 8)
        text = (ROOT / "docs/reference/output.md").read_text()
        for name in group:
            assert group[name].attrs["long_name"], name
            assert f"`/statistics/{re.sub(r'^part_[0-9]+$', 'part_*', name)}`" in text, name


def test_figures_need_their_section(gudgeon):
    directory = scratch()
    for figure, words in (("spectrum(motor.moment)", "needs a section [statistics]"), ("section(motor.moment)", "cannot read")):
        deck = written(directory, changed(DECK.read_text(), "output", figures=figure))
        assert words in call(gudgeon, "check", deck, expect=3).stderr


def test_spectrum_of_what_is_no_number(gudgeon):
    """A root of something negative at some instants: no amplitude is told, a warning says why, and the other spectrum is as ever."""
    directory = scratch()
    text = changed(SINES, "statistics", channels="request.root", spectra="request.root ram.position.x")
    text += '[request]\nname value unit\nroot {sqrt(ram.position.x/1m)} 1\n'
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    run = Run(directory / "out")
    assert [w for w in run.summary["warnings"] if "no spectrum of 'request.root'" in w]
    amplitude = run.read("statistics/spectrum")
    assert np.all(np.isnan(amplitude[:, 0]))
    assert_close(amplitude[50, 1], 2e-3, relative=1e-6, what="50 Hz")
    assert run.summary["statistics"]["request.root.mean"] > 0 and run.summary["statistics"]["request.root.min"] >= 0


def test_mistakes_within_figures_are_marked(gudgeon):
    """The caret is below the wrong argument, not below a word that holds its letters, and says that it is a part of a figure."""
    directory = scratch()
    for figure, part in (("portrait(slider.velocity.x, slider.velocity)", "slider.velocity)"), ("strip(n=8, n=1)", "n=1)"),
                         ("histogram(gudgeon.peak)", "gudgeon.peak)"), ("slider.velocity.x in mm", "mm")):
        deck = written(directory, changed(DECK.read_text(), "output", figures=figure))
        line, marks = call(gudgeon, "check", deck, expect=3).stderr.splitlines()[3:5]
        first = marks.index("^")
        assert line[first:].startswith(part), marks
        assert marks.split("^ ")[1] == "invalid in this figure" and marks.count("^") == len(part.rstrip(")"))
    deck = written(directory, changed(DECK.read_text(), "output", figures="slider.speed"))
    assert "^ not a figure of this deck" in call(gudgeon, "check", deck, expect=3).stderr


def test_a_run_that_ends_before_its_statistics(gudgeon):
    """A joint is not apart all the time of a window that there is not: no number is known, and a warning says why."""
    directory = scratch()
    text = changed(DECK.read_text(), "output", figures=None) + "\n[statistics]\nafter = 2 ms\nchannels = motor.moment\n"
    text += "[guards]\nstop = motor.coordinate > 0.5 rad\n"
    call(gudgeon, "run", written(directory, text), "--out", directory / "out", "--quiet")
    run = Run(directory / "out")
    assert set(run.summary["statistics"].values()) == {None}
    assert [w for w in run.summary["warnings"] if w == "no statistics: the run ended before their start, at 0.002 s"]
