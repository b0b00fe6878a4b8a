"""Pages of sweeps and ensembles: their numbers are those of the tables, their histories those of sweep.h5, and a browser shows them."""

import functools
import json
import re
import sys

import h5py
import numpy as np
import pytest
import study_pages
from page_data import numbers, object_of
from study_pages import csv_of, numbers_of
from support import ROOT, call, changed, scratch
from test_report import Page

sys.path.insert(0, str(ROOT / "tests" / "browser"))
from visit import browser_here, visit, watched  # noqa: E402

LIMIT = 5_000_000  # bytes of a page
N_PART = 200       # parts of the window of a history


@functools.lru_cache(maxsize=None)
def made_once(program):
    """All pages of a program."""
    return study_pages.make_studies(program, scratch())


@pytest.fixture(name="pages")
def pages_of_studies(gudgeon):
    """All pages, made once."""
    return made_once(gudgeon)


def test_numbers_of_the_page_are_those_of_the_tables(pages):
    """Results of the runs to the bit as in sweep.csv, means and deviations as in cases.csv, exit codes and parameters too."""
    assert set(study_pages.NAMES) >= {"clearance_study", "friction_study", "law_study", "wear_joints_study"}
    for name, path in pages.items():
        data, runs, cases = object_of(path), csv_of(path.parent / "sweep.csv"), csv_of(path.parent / "cases.csv")
        assert path.stat().st_size < LIMIT and 10 < len(data["results"]), name
        for result in data["results"]:
            np.testing.assert_array_equal(numbers(result["v"], "<f8"), numbers_of(runs[result["n"]]), err_msg=f"{name} {result['n']}")
            if data["ensemble"]:
                spreads = numbers(result["s"], "<f8").reshape(-1, 4)
                for k, word in enumerate(("mean", "deviation", "min", "max")):
                    np.testing.assert_array_equal(spreads[:, k], numbers_of(cases[f"{result['n']} {word}"]), err_msg=f"{name} {result['n']}")
        np.testing.assert_array_equal(numbers(data["exit"], "<i4"), np.array(runs["exit_code"], int))
        for parameter in data["parameters"]:
            at = numbers(parameter["at"], "<i4")
            if parameter["words"] is False:
                np.testing.assert_array_equal(numbers(parameter["x"], "<f8")[at], numbers_of(cases[parameter["n"]]))
            else:
                assert [parameter["texts"][k] for k in at] == cases[parameter["n"]]
        has_samples = "bifurcation" in (path.parent / "deck.echo").read_text(encoding="utf-8")
        assert bool(data["poincare"]["list"]) == has_samples, name


def test_histories_of_the_page_are_those_of_the_file(pages):
    """Values at the ends of equal parts, and extremes within them, of every run and channel that was kept, found anew from sweep.h5."""
    path = pages["grid"]
    kept = object_of(path)["histories"]
    assert [h["n"] for h in kept][:2] == ["motor.moment", "gudgeon.normal_force"] or len(kept) == 4, [h["n"] for h in kept]
    columns = {"motor.moment": ("drivers/moment", 0), "gudgeon.normal_force": ("clearances/contacts/normal_force", 0),
               "slider.velocity.x": ("bodies/velocity", (0, 0)), "slider.velocity.y": ("bodies/velocity", (0, 1))}
    with h5py.File(path.parent / "sweep.h5") as file:
        for history in kept:
            for run, has in history["runs"].items():
                group = file[f"channels/{int(run) + 1}"]
                place, column = columns[history["n"]]
                t, x = group["time"][:], group[place][:]
                x = x[:, column] if isinstance(column, int) else x[:, column[0], column[1]]
                factor = {"kN": 1e-3, "mm/s": 1e3, "mN·m": 1e3}.get(history["u"], 1.0)
                edges = np.linspace(t[0], t[-1], N_PART + 1)
                size = np.abs(x).max() * factor
                assert has["w"] == [t[0], t[-1]]
                np.testing.assert_allclose(numbers(has["v"])[1:-1], factor * np.interp(edges, t, x)[1:-1], atol=1e-5 * size)
                part = np.minimum(((t - t[0]) / (edges[1] - edges[0])).astype(int), N_PART - 1)
                inside, low, high = np.interp(edges, t, x), numbers(has["lo"]), numbers(has["hi"])
                for k in range(0, N_PART, 7):
                    values = np.concatenate([x[part == k], inside[k:k + 2]])
                    assert abs(low[k] - factor * values.min()) <= 1e-5 * size and abs(high[k] - factor * values.max()) <= 1e-5 * size, (history["n"], run, k)


def check_rows(name, shown, table, results, n_before, suffix=""):
    """Cells of a table of the page: the numbers of a table of the sweep in the unit of the heading, with five digits."""
    by_name = {f"{n} [{u}]" if u else n: (n, f) for n, u, f in results}
    checked = 0
    for column in range(n_before, len(shown[0])):
        head = shown[0][column].rstrip(" ▲▼")
        if head not in by_name and not head.endswith(" mean"):
            continue
        n, factor = by_name[head.removesuffix(" mean")]
        wanted = factor * numbers_of(table[n + suffix])
        cells = numbers_of([row[column] for row in shown[1:]])
        np.testing.assert_allclose(cells, wanted[: len(cells)], rtol=6e-5, err_msg=f"{name} {head}")
        checked += 1
    assert checked > 0, name


def check_seen(name, path, seen):
    """What a user finds on a page."""
    runs = csv_of(path.parent / "sweep.csv")
    assert seen["errors"] == [] and seen["asked"] == 0 and seen["wide"] <= 0, (name, seen["errors"], seen["wide"])
    check_rows(name, seen["whole"], runs, seen["results"], 2)
    if "cases" in seen:
        check_rows(name, seen["cases"], csv_of(path.parent / "cases.csv"), seen["results"], 2, " mean")
    assert seen["points"] == (seen["table"][1:] and len(runs["case"])), (name, seen["points"])
    assert all(n > 0 and not is_bad for _, _, n, is_bad in seen["all"]), (name, [entry for entry in seen["all"] if entry[2] == 0 or entry[3]])
    up, down = (numbers_of([row[-1] for row in seen[key][1:]]) for key in ("up", "down"))
    assert (np.diff(up) >= 0).all() and (np.diff(down) <= 0).all() and up[0] < up[-1], (name, up, down)
    assert seen["picked"] > 0 and seen["off"] < 3 and seen["again"] < 4, (name, seen["picked"], seen["off"], seen["again"])
    assert "done" in seen["side"] and "done" in seen["row"], (name, seen["picked"], seen["row"])
    assert seen["name"] in seen["side"] and seen["tip"].startswith("case") and "=" in seen["tip"], (name, seen["tip"], seen["side"])
    assert seen["cost"] < 33, f"{name}: {seen['cost']:.0f} ms of the processor for a picture"


@pytest.mark.slow
def test_pages_in_a_browser(pages):
    """Every plot over every parameter, table, order, point and history; text of the deck is nothing but text; what a picture costs."""
    if browser_here() is None:
        pytest.skip("no Chromium on this machine: apt-get install chromium")
    names = ("grid", "clearance_study", "law_study", "wear_joints_study")
    found = visit({name: watched(pages[name].read_text(encoding="utf-8"), study_pages.DO) for name in names})
    for name in names:
        check_seen(name, pages[name], found[name])
    seen = found["grid"]
    assert seen["first"] == ["r0", "p0", "p1"] or seen["first"][1:] == ["p0", "p1"]
    assert seen["plots"] == 4, "force, moment and two components of the velocity"
    history = next(h for h in seen["histories"] if h["5"]["n"] == "motor.moment")["5"]
    time = np.linspace(*history["w"], N_PART + 1)
    value = np.interp(history["w"][0] + (history["w"][1] - history["w"][0]) / 3, time, history["v"])
    said = [float(text.split(" ")[-1]) for text in seen["values"]]
    assert any(abs(u - value) <= 1e-3 * abs(value) for u in said), (value, said)


def test_a_page_is_written_when_it_is_asked_for(gudgeon):
    """Without report = on there is none, and the summary names it where it is; a failed run is in its table with its message."""
    directory = scratch()
    text = study_pages.GRID.format(ROOT / "inputs" / "slider_crank_dry.deck").replace("c = 0.5 0.2 mm", "restitution = 0.9 2")
    (directory / "none.deck").write_text(text.replace("report = on", "report = off"), encoding="utf-8")
    (directory / "some.deck").write_text(text, encoding="utf-8")
    quiet = call(gudgeon, "sweep", directory / "none.deck", "--out", directory / "none", expect=(0, 6, 7, 8, 9))
    told = call(gudgeon, "sweep", directory / "some.deck", "--out", directory / "some", expect=(0, 6, 7, 8, 9))
    assert "report.html" not in quiet.stdout and not (directory / "none" / "report.html").exists()
    assert "report.html" in told.stdout
    page = (directory / "some" / "report.html").read_text(encoding="utf-8")
    assert "failed" in page.split("<nav>")[0] and "</script><b>" not in page
    data = object_of(directory / "some" / "report.html")
    codes = numbers(data["exit"], "<i4")
    assert (codes == 0).sum() == 3 and (codes > 0).sum() == 3
    assert all(data["said"][str(k)] for k in np.flatnonzero(codes))


def test_page_of_a_study_of_tolerances(gudgeon):
    """Its tables have the numbers of summary.json; runs of members are shown as those of a sweep, sampled values with six digits."""
    directory = scratch()
    text = (ROOT / "inputs" / "tolerance_slider_crank.deck").read_text(encoding="utf-8")
    (directory / "still.deck").write_text(changed(text, "output", report="on"), encoding="utf-8")
    call(gudgeon, "tolerance", directory / "still.deck", "--out", directory / "still", "--quiet")
    page = Page((directory / "still" / "report.html").read_text(encoding="utf-8"))
    summary = json.loads((directory / "still" / "summary.json").read_text(encoding="utf-8"))
    rows = page.tables["requests"]
    assert rows[0][:2] == ["channel", "unit"] and len(rows) == 1 + len(summary["tolerance"])
    factor = {"mm": 1e3, "m": 1.0, "µm": 1e6}
    for row in rows[1:]:
        channel = summary["tolerance"][row[0]]
        for column, wanted in ((3, channel["nominal"]["value"][0]), (4, channel["band"]["low"][0]), (6, channel["sigma"]["value"][0])):
            assert abs(float(row[column]) / factor[row[1]] - wanted) <= 1e-5 * abs(wanted), (row, column, wanted)
    with h5py.File(directory / "still" / "tolerance.h5") as file:
        worst = {name: file[f"tolerance_worst/{name}"][()] for name in ("member", "value", "share")}
    rows = page.tables["worst"]
    assert rows[0][:4] == ["channel", "unit", "member", "value"] and rows[0][4:] == ["r", "l", "gudgeon.x", "gudgeon.y"]
    for row, member, value, share in zip(rows[1:], worst["member"], worst["value"], worst["share"], strict=True):
        assert int(row[2]) == member and abs(float(row[3]) / factor[row[1]] - value) <= 1e-5 * abs(value)
        assert row[4:6] == ["-", "-"] and [float(cell) for cell in row[6:]] == pytest.approx(share[2:], rel=1e-2), "parts without tolerance"
    limits = "\n[tolerance.limit]\nname channel lower upper\nx slider.position.x 108.9mm 109.4mm\n"
    (directory / "limited.deck").write_text(changed(text, "output", report="on") + limits, encoding="utf-8")
    call(gudgeon, "tolerance", directory / "limited.deck", "--out", directory / "limited", "--quiet")
    found = json.loads((directory / "limited" / "summary.json").read_text(encoding="utf-8"))["tolerance_study"]["yield"]
    status = (directory / "limited" / "report.html").read_text(encoding="utf-8").split('<p class="status complete">')[1].split("</p>")[0]
    told = re.search(r"yield: ([\d.]+), 95 %: ([\d.]+) to ([\d.]+) within all limits$", status)
    assert [float(number) for number in told.groups()] == pytest.approx([found["value"], found["low"], found["high"]], abs=1e-6)
    (directory / "moving.deck").write_text(f'''deck = 1
include "{ROOT / "inputs" / "studies" / "tolerance_study.deck"}"
[tolerance.study]
requests = motor.moment.rms
members = 6
{study_pages.FEW.replace("runs = 3", "runs = 2")}
[statistics]
after = 0.2 turns of motor
[analysis.dynamic]
end = 0.6 turns of motor
[output]
report = on
''', encoding="utf-8")
    call(gudgeon, "tolerance", directory / "moving.deck", "--out", directory / "moving", "--quiet")
    data, runs = object_of(directory / "moving" / "report.html"), csv_of(directory / "moving" / "sweep.csv")
    found = {result["n"]: numbers(result["v"], "<f8") for result in data["results"]}
    np.testing.assert_array_equal(found["motor.moment.rms"], numbers_of(runs["motor.moment.rms"]))
    for parameter in data["parameters"]:
        x = numbers(parameter["x"], "<f8")[numbers(parameter["at"], "<i4")].repeat(data["members"])
        np.testing.assert_array_equal(x, numbers_of(runs[parameter["n"]]))
        assert max(map(len, parameter["texts"])) < 16, parameter["texts"]
