"""Pages opened by a real browser, headless Chromium: those of animations load without an error and show another picture after a step,
that of a run shows its pictures, its tables and the animation in its frame.

open_pages.py PROGRAM DIRECTORY [--rate]: runs the decks of inputs/ there with the program; exits with 1 if something is wrong.
--rate: pictures per second while each page plays, and while the pointer moves over the page of a sweep. Chromium: apt-get install chromium.
"""

import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys

import h5py
import numpy as np
from visit import browser_here, visit, watched

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "e2e"))
import study_pages  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
LIMIT = 5_000_000  # bytes of a page
REPORTS = ("slider_crank_dry", "four_bar_spatial")
# what a user does, and what is then to be seen: the picture's pixels, the plots, the time
DO = """const look=()=>[pixels(),$('side').innerHTML,$('time').textContent],click=k=>$(k).click();
const pixels=()=>{draw();const g=renderer.getContext(),w=g.drawingBufferWidth,h=g.drawingBufferHeight,b=new Uint8Array(4*w*h);
g.readPixels(0,0,w,h,g.RGBA,g.UNSIGNED_BYTE,b);let sum=0,ink=0;for(let k=0;k<b.length;k+=4){const c=b[k]|b[k+1]<<8|b[k+2]<<16;
sum=(Math.imul(sum,31)+c)|0;if(c!=0xffffff)ink++}return{sum,ink}};
await new Promise(r=>requestAnimationFrame(()=>requestAnimationFrame(r)));found.start=look();
for(let k=0;k<12;k++)click('step');found.stepped=look();for(let k=0;k<12;k++)click('back');found.back=look();
click('with-names');found.names=[...document.querySelectorAll('#names span')].map(s=>s.textContent);
const extent=p=>{const q=pointPlot(p);return q.curves.reduce((s,c)=>s+Math.max(...c.y)-Math.min(...c.y),0)*(q.unit=='mm'?1e-3:1)};
const [most,far]=D.points.map((p,k)=>[extent(p),k]).sort((a,b)=>b[0]-a[0])[0];found.moves=most>0.02*S;$('trace').value=far;$('trace').onchange();found.traced=look();
$('trace').value=-1;$('trace').onchange();
found.views=D.spatial?['front','top','right','isometric'].map(v=>{document.querySelector(`[data-view=${v}]`).click();return pixels()}):[];
$('slider').value=N-1;$('slider').oninput({target:$('slider')});found.last=look();
click('play');found.playing=$('play').textContent;click('play');found.n=N;found.wide=document.body.scrollWidth-innerWidth;
found.plots=cursors.length;found.triangles=renderer.info.render.triangles"""
# pictures per second while the page plays, and the processor's time for one
RATE = """await new Promise(r=>requestAnimationFrame(r));$('play').click();let n=0,t0=performance.now(),spent=0;const own=draw;
draw=()=>{const t=performance.now();own();renderer.getContext().finish();spent+=performance.now()-t;n++};
await new Promise(r=>setTimeout(r,3000));found.rate=1000*n/(performance.now()-t0);found.cost=spent/n"""
# a browser without WebGL
BLIND = """<script>HTMLCanvasElement.prototype.getContext=()=>null</script>"""
SEEN_BLIND = """found.text=$('scene').textContent;found.plots=cursors.length;$('step').click();found.time=$('time').textContent;
found.buttons=$('fit').hidden&&$('for-names').hidden"""
# the page of a run: what it shows when all is loaded
REPORT = """found.pictures=[...document.images].map(p=>p.complete?p.naturalWidth:0);
found.frames=[...document.querySelectorAll('iframe')].map(f=>f.contentDocument.querySelectorAll('#scene canvas').length);
found.rows=[...document.querySelectorAll('table')].map(t=>t.rows.length);found.wide=document.body.scrollWidth-window.innerWidth"""
# the zoom of a guide with clearance at each position: corners of the slider, walls
GUIDE = """found.corners=[];found.walls=[];found.times=[];for(let k=0;k<N;k++){show(k);const z=document.querySelector('.orbit');
found.corners.push(z.querySelector('polygon').getAttribute('points').split(' ').map(q=>q.split(',').map(Number)));
found.walls.push([...z.querySelectorAll('.wall')].map(p=>+p.getAttribute('d').match(/M0 ([0-9.e-]+)H/)[1]));found.times.push(times[k])}"""

# the journal in its clearance at rows between two positions, in pixels; a plot of round-off; speeds
INSET = """found.inset=[];for(let k=4;k<80;k+=8){const t=track.t[Math.floor(k*track.t.length/80)];seek(t);cursors[0](true);
const c=document.querySelectorAll('.orbit circle')[1];found.inset.push([t,c.getAttribute('cx')-210,200-c.getAttribute('cy')])}
const svg=element(160);timePlot(svg,{title:'flat',unit:'N',curves:[{n:'f',x:times,y:Array.from(times,(t,k)=>2000+1e-4*(k%2))}]})(true);
found.flat=svg.querySelector('polyline').getAttribute('points').split(' ').map(p=>+p.split(',')[1]);
found.labels=[...svg.querySelectorAll('text')].filter(t=>t.textContent=='2000').length;found.speeds=[...$('speed').options].map(o=>[o.text,+o.value]);
found.per=+$('speed').value*6/span"""


def page_of(program, directory, name, changes=(), env=None):
    """A deck's animation, and beside it the page of its run."""
    text = (ROOT / "inputs" / f"{name}.deck").read_text(encoding="utf-8")
    for file in ("engine_gas.txt", "valve_lift.txt"):
        text = text.replace(file, str(ROOT / "inputs" / file))
    text = re.sub(r"^(figures|report) *=.*\n", "", text, flags=re.MULTILINE)
    text = re.sub(r"^\[output\].*$", r"\g<0>\nreport = on\nfigures = animation(n=24) energy.kinetic mechanism", text, flags=re.MULTILINE)
    for pattern, by in changes:
        text, n = re.subn(pattern, by, text, count=1, flags=re.MULTILINE)
        assert n == 1, (name, pattern)
    deck = directory / f"{name}.deck"
    deck.write_text(text, encoding="utf-8")
    subprocess.run([program, "run", deck, "--out", directory / name, "--quiet"], check=True, timeout=300, env=env)
    return directory / name / "figures" / "animation.n.24.html"


def check_page(name, path, found):
    """Small enough, nothing wrong or asked for, a picture that a step, a trace and a view change, and that comes back."""
    assert path.stat().st_size < LIMIT, name
    assert found["errors"] == [] and found["asked"] == 0, (name, found["errors"])
    assert found["start"][0]["ink"] > 300, f"{name}: nothing drawn"
    assert found["stepped"][0] != found["start"][0] and found["stepped"][2] != found["start"][2], f"{name}: a step shows nothing new"
    assert found["back"][0] == found["start"][0] and found["back"][2] == found["start"][2], f"{name}: back is not where it was"
    assert found["traced"][0] != found["start"][0] or not found["moves"], f"{name}: no trace"
    assert found["n"] in (24, 25) and found["last"][2] != found["start"][2] and found["playing"] == "stop", name
    assert found["plots"] > 0 and "polyline" in found["start"][1] and "NaN" not in found["start"][1] + found["last"][1], f"{name}: no plots"
    assert len({view["sum"] for view in found["views"]}) == len(found["views"]) and all(found["names"]), f"{name}: views are the same"
    assert found["wide"] <= 0, f"{name}: wider than the window"


def check_report(page, found):
    """The page of a run: every picture is there, the frame plays, tables are filled, nothing reaches beyond the window."""
    assert found["errors"] == [] and found["asked"] == 0, (page, found["errors"])
    assert len(found["pictures"]) == 2 and min(found["pictures"]) > 200, (page, found["pictures"])
    assert found["frames"] == [1], (page, found["frames"])
    assert len(found["rows"]) > 5 and max(found["rows"]) > 5 and found["wide"] <= 0, (page, found["rows"], found["wide"])


def check_guide(directory, seen):
    """A guide with clearance beside its force: a corner of the slider lies beyond its wall in those positions in which it penetrates."""
    assert seen["errors"] == [] and len(seen["corners"]) == 24, seen
    with h5py.File(directory / "slider_crank_translational" / "run.h5") as file:
        even = np.flatnonzero(file["row_kind"][:] == 0)
        names = [name.decode() for name in file["clearances/contact_label"][:]]
        depth = file["clearances/contacts/penetration"][:][even]
        times = file["time"][:][even]
    touched = 0
    for t, corners, walls in zip(seen["times"], seen["corners"], seen["walls"]):
        row = depth[np.argmin(abs(times - t))]
        (_, d), (_, c), (_, b), (_, a) = corners  # drawn from the upper one behind, clockwise: y goes down
        beyond = {"D_upper": walls[0] - d, "C_upper": walls[0] - c, "B_lower": b - walls[1], "A_lower": a - walls[1]}
        for name, value in beyond.items():
            here = row[names.index(name)]
            touched += here > 0
            assert (value > 0) == (here > 0) and (here == 0 or abs(value / here * 0.5e-3 / 55 - 1) < 0.02), (t, name, value, here)
    assert touched > 0


def check_inset(directory, seen):
    """The journal lies where the row of the run has it, also between two positions; round-off is a flat line; speeds are round."""
    with h5py.File(directory / "slider_crank_dry" / "run.h5") as file:
        times, eccentricity = file["time"][:], file["clearances/eccentricity"][:, 0, :2]
    places = np.array(seen["inset"])
    rows = np.array([np.argmin(abs(times - t)) for t in places[:, 0]])
    want = eccentricity[rows]
    scale = np.linalg.norm(places[:, 1:]) / np.linalg.norm(want)
    assert seen["errors"] == [] and np.linalg.norm(want, axis=1).max() > 1e-4
    np.testing.assert_allclose(places[:, 1:] / scale, want, atol=2e-3 * np.linalg.norm(want, axis=1).max())
    assert np.ptp(seen["flat"]) < 1 and seen["labels"] == 1, (seen["flat"], seen["labels"])
    assert ["real time", 1] in seen["speeds"] and all(text == "real time" or "of real time" in text for text, rate in seen["speeds"] if rate <= 1)
    assert 0.7 < seen["per"] < 1.4, "the usual speed takes about six seconds"


def make_pages(program, directory, names, changes=None, env=None):
    """Pages of decks."""
    directory.mkdir(parents=True, exist_ok=True)
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        pages = pool.map(lambda name: page_of(program, directory, name, (changes or {}).get(name, ()), env), names)
        return dict(zip(names, pages))


def seen_in(paths, script=DO):
    """What the browser finds in pages."""
    return visit({name: watched(path.read_text(encoding="utf-8"), script) for name, path in paths.items()})


def main(program, directory, rate):
    """All pages."""
    if browser_here() is None:
        print("browser-test: no Chromium; on Debian: apt-get install chromium", file=sys.stderr)
        return 1
    if rate:
        pages = study_pages.make_studies(program, directory)
        for name, found in seen_in(pages, study_pages.RATE.replace("SPAN", "3000")).items():
            print(f"{name}: {found['rate']:.1f} pictures per second, {found['cost']:.1f} ms each, {pages[name].stat().st_size // 1000} kB")
    names = sorted(path.stem for path in (ROOT / "inputs").glob("*.deck"))
    paths = make_pages(program, directory, names)
    found = seen_in(paths, RATE if rate else DO)
    for name, path in paths.items():
        if rate:
            print(f"{name}: {found[name]['rate']:.1f} pictures per second, {found[name]['cost']:.1f} ms each, {path.stat().st_size // 1000} kB")
            continue
        check_page(name, path, found[name])
        print(f"browser-test: {name}: as expected ({path.stat().st_size // 1000} kB, {found[name]['triangles']} triangles)")
    if rate:
        return 0
    blind = watched(paths["slider_crank_dry"].read_text(encoding="utf-8"), SEEN_BLIND).replace("<style>", BLIND + "<style>", 1)
    dry = paths["slider_crank_dry"].read_text(encoding="utf-8")
    others = {"blind": blind, "inset": watched(dry, INSET), "guide": watched(paths["slider_crank_translational"].read_text(encoding="utf-8"), GUIDE)}
    others |= {name: watched((directory / name / "report.html").read_text(encoding="utf-8"), REPORT) for name in REPORTS}
    found = visit(others)
    seen = found["blind"]
    assert seen["errors"] == [] and "WebGL" in seen["text"] and seen["plots"] > 1 and seen["buttons"] and seen["time"] != "t = 0 s", seen
    check_guide(directory, found["guide"])
    check_inset(directory, found["inset"])
    for name in REPORTS:
        check_report(name, found[name])
    print("browser-test: without WebGL, the guide with clearance and the reports as expected")
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve(), "--rate" in sys.argv))
