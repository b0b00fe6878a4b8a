"""Pages opened by a real browser, headless Chromium: those of animations load without an error and show another picture after a step,
that of a run shows its pictures, its tables and the animation in its frame.

open_pages.py PROGRAM DIRECTORY: runs decks there with the program; exits with 1 if something is wrong. Chromium: apt-get install chromium.
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
DECKS = ("slider_crank_dry", "four_bar_spatial", "hanging_chain", "double_pendulum", "billiards")
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
# before the page's own script: errors and requests are counted; after it: what a user does, and what is then to be seen
BEFORE = """<script>window.found={errors:[],asked:0};window.onerror=(m,u,l,c)=>{found.errors.push(m+' '+l+':'+c)};
window.fetch=()=>{found.asked++};XMLHttpRequest.prototype.open=()=>{found.asked++};</script>"""
AFTER = """<script>{const look=()=>['scene','zoom','force','time'].map(k=>document.getElementById(k).innerHTML);
const click=k=>document.getElementById(k).click();found.start=look();for(let k=0;k<5;k++)click('step');found.stepped=look();
for(let k=0;k<5;k++)click('back');found.back=look();const v=document.getElementById('view');
v.selectedIndex=v.options.length-1;v.dispatchEvent(new Event('change'));found.turned=look();
const s=document.getElementById('slider');s.value=s.max;s.dispatchEvent(new Event('input'));found.last=look();
click('play');found.playing=document.getElementById('play').textContent;click('play');
document.documentElement.setAttribute('data-found',encodeURIComponent(JSON.stringify(found)))}</script></body>"""

# at the end of the page of a run: what it shows when all is loaded
REPORT = """<script>window.addEventListener('load',()=>{found.pictures=[...document.images].map(p=>p.complete?p.naturalWidth:0);
found.frames=[...document.querySelectorAll('iframe')].map(f=>f.contentDocument.getElementById('scene').innerHTML);
found.rows=[...document.querySelectorAll('table')].map(t=>t.rows.length);found.wide=document.body.scrollWidth-window.innerWidth;
document.documentElement.setAttribute('data-found',encodeURIComponent(JSON.stringify(found)))})</script></body>"""


# the zoom of a loose guide at each picture: corners of the slider, walls
GUIDE = """<script>{found.corners=[];found.walls=[];found.times=[];for(let k=0;k<N;k++){show(k);const z=document.getElementById('zoom');
found.corners.push(z.querySelector('polygon').getAttribute('points').split(' ').map(q=>q.split(',').map(Number)));
found.walls.push([...z.querySelectorAll('path')].map(p=>+p.getAttribute('d').match(/M0 ([0-9.e-]+)H/)[1]));found.times.push(D.frames[k].t)}
document.documentElement.setAttribute('data-found',encodeURIComponent(JSON.stringify(found)))}</script></body>"""


def browser_here():
    """A browser's command; None, and a word about it, if there is none."""
    browser = next((name for name in BROWSERS if shutil.which(name)), None)
    if browser is None:
        print("browser-test: no Chromium; on Debian: apt-get install chromium", file=sys.stderr)
    return browser


def page_of(program, directory, name):
    """A deck's animation, and beside it the page of its run."""
    text = (ROOT / "inputs" / f"{name}.deck").read_text(encoding="utf-8")
    text, n = re.subn(r"^figures( *)=.*$", r"report = on\nfigures\1= animation(n=24) energy.kinetic mechanism", text, flags=re.MULTILINE)
    assert n == 1, name
    deck = directory / f"{name}.deck"
    deck.write_text(text, encoding="utf-8")
    subprocess.run([program, "run", deck, "--out", directory / name, "--quiet"], check=True, timeout=300)
    return directory / name / "figures" / "animation.n.24.html"


def what_is_found(browser, page, before, after):
    """What the browser sees in a page."""
    text = page.read_text(encoding="utf-8")
    assert not re.search(r"https?:|@import|src=(?!.data:image)", text), "the page asks for something"
    watched = page.with_name("watched.html")
    head, _, tail = text.partition(before)
    body, _, end = tail.rpartition("</body>")
    watched.write_text(head + BEFORE + before + body + after + end, encoding="utf-8")
    command = [browser, "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=10000", "--dump-dom",
               watched.resolve().as_uri()]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120)
    found = re.search(r'data-found="([^"]*)"', done.stdout)
    errors = re.search(r"errors:\[\]", done.stdout)
    assert found, f"the script did not come to its end: {done.stderr[-500:]} {errors}"
    return json.loads(re.sub(r"%([0-9A-Fa-f]{2})", lambda m: chr(int(m.group(1), 16)), found.group(1)))


def check_report(browser, page):
    """The page of a run: every picture is there, the frame plays, tables are filled, nothing reaches beyond the window."""
    found = what_is_found(browser, page, "<style>", REPORT)
    assert found["errors"] == [] and found["asked"] == 0, (page, found["errors"])
    assert len(found["pictures"]) == 2 and min(found["pictures"]) > 200, (page, found["pictures"])
    assert len(found["frames"]) == 1 and "<poly" in found["frames"][0], page
    assert len(found["rows"]) > 5 and max(found["rows"]) > 5 and found["wide"] <= 0, (page, found["rows"], found["wide"])


def check_guide(browser, program, directory):
    """A loose guide beside its force: a corner of the slider lies beyond its wall in those pictures in which it penetrates."""
    page = page_of(program, directory, "slider_crank_translational")
    seen = what_is_found(browser, page, "<script>", GUIDE)
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
            assert (value > 0) == (here > 0) and (here == 0 or abs(value / here * 0.5e-3 / 55 - 1) < 0.01), (t, name, value, here)
    assert touched > 0
    print("browser-test: slider_crank_translational: its guide as in run.h5")


def main(program, directory):
    """All pages."""
    browser = browser_here()
    if browser is None:
        return 1
    directory.mkdir(parents=True, exist_ok=True)
    for name in DECKS:
        page = page_of(program, directory, name)
        found = what_is_found(browser, page, "<script>", AFTER)
        assert found["errors"] == [] and found["asked"] == 0, (name, found["errors"])
        for k, part in enumerate(("scene", "zoom", "force", "time")):
            there = found["start"][k] != "" or (part in ("zoom", "force") and "loose:[]" in page.read_text(encoding="utf-8"))
            assert there, f"{name}: no {part}"
        assert "<poly" in found["start"][0] and "NaN" not in str(found["start"]) + str(found["last"]), name
        assert found["stepped"][0] != found["start"][0] and found["stepped"][3] != found["start"][3], f"{name}: a step shows nothing new"
        assert found["back"] == found["start"], f"{name}: back is not where it was"
        assert found["last"][0] != found["turned"][0] and found["playing"] == "stop", name
        if "spatial:true" in page.read_text(encoding="utf-8"):
            assert found["turned"][0] != found["start"][0], f"{name}: another view is the same"
        report = directory / name / "report.html"
        check_report(browser, report)
        print(f"browser-test: {name}: as expected ({page.stat().st_size // 1000} kB, report {report.stat().st_size // 1000} kB)")
    check_guide(browser, program, directory)
    return 0


if __name__ == "__main__":
    sys.exit(main(pathlib.Path(sys.argv[1]).resolve(), pathlib.Path(sys.argv[2]).resolve()))
