"""Shortened studies of inputs/studies with their pages, and what a user does there, for tests in a browser and without one."""

import concurrent.futures
import csv
import os
import subprocess

import numpy as np
from support import ROOT, SLOWNESS

# sections by which a study is shortened; each needs one run of a part of a second
TURN = "[analysis.dynamic]\nend = 0.9 turns of motor\n[statistics]\nafter = 0.1 turns of motor\nperiod = 0.2 turns of motor\n"
SHORT = {"wear_joints_study": TURN.replace("0.9", "0.3").replace("period = 0.2 turns of motor\n", ""), "wear_study": TURN}
FEW = "[ensemble]\nruns = 3\nseed = 1\nposition = 1e-9 m\nvelocity = 1e-6 m/s\n"
NAMES = sorted(path.stem for path in (ROOT / "inputs" / "studies").glob("*.deck") if "[sweep]" in path.read_text(encoding="utf-8"))
GRID = """deck = 1
include "{}"
[scene]
title = "Grid </script><b>&"
[sweep]
friction = 0.01 0.03 0.1
c = 0.5 0.2 mm
keep = channels
[statistics]
after = 1 ms
channels = motor.moment
[analysis.dynamic]
end = 6 ms
[output]
report = on
every = 20 us
channels = motor.moment gudgeon.normal_force slider.velocity
figures = contour(motor.moment.peak)
"""
# what a user does: every plot over every kind of abscissa, a point, a row, sorting; then pictures per second while the pointer moves
DO = """const wait=()=>new Promise(r=>requestAnimationFrame(()=>requestAnimationFrame(r)));await wait();
const rows=()=>[...document.querySelectorAll('#table tr')].map(r=>[...r.children].map(c=>c.textContent));
const set=(id,v)=>{$(id).value=v;$(id).onchange()};found.first=[$('y').value,$('x').value,$('c').value];
found.text=$('side').innerText;found.table=rows();found.points=shown.marks.length;found.wide=document.body.scrollWidth-innerWidth;
found.all=[];$('all').checked=true;$('all').onchange();found.whole=rows();$('all').checked=false;$('all').onchange();
for(const y of[...$('y').options].slice(0,4).concat([...$('y').options].slice(-2)))for(const x of[...$('x').options].slice(0,P.length+2)){set('y',y.value);set('x',x.value);
found.all.push([y.value,x.value,shown.marks.length,/NaN|Infinity|undefined/.test(svg.outerHTML+$('key').innerHTML)])}
set('y',found.first[0]);set('x',found.first[1]);
const header=i=>document.querySelectorAll('#table th button')[i].click(),n=found.table[0].length-1;
header(n);found.up=rows();header(n);found.down=rows();header(0);
if(D.ensemble){set('rows','cases');found.cases=rows();set('rows','runs')}
const target=shown.marks[shown.marks.length-1],box=svg.getBoundingClientRect(),at=(t,m)=>svg.dispatchEvent(new PointerEvent(t,{clientX:box.left+m[0],clientY:box.top+m[1],bubbles:true}));
at('pointermove',target);found.tip=$('tip').textContent;at('click',target);found.picked=picked;found.name=runText(picked);
const own=shown.marks.find(m=>m[2]==picked);found.off=Math.hypot(own[0]-target[0],own[1]-target[1]);found.side=side.innerText+[...side.querySelectorAll('text')].map(t=>t.textContent).join(' ');
found.row=document.querySelector('#table tr.picked').textContent;found.plots=cursors.length;
at('click',target);const again=shown.marks.find(m=>m[2]==picked);found.again=Math.hypot(again[0]-target[0],again[1]-target[1]);pick(target[2]);
if(cursors.length){seek((first+last)/3);found.at=at_time();found.values=[...side.querySelectorAll('.value')].map(v=>v.textContent)}
function at_time(){return timeAt(window.eval('at'))}
"""
# pictures per second while the pointer moves over the plot and along the histories and runs are picked, and the processor's time for one
RATE = """await new Promise(r=>requestAnimationFrame(()=>requestAnimationFrame(r)));
let count=0,t0=performance.now(),spent=0,k=0;while(performance.now()-t0<SPAN){await new Promise(r=>requestAnimationFrame(r));count++;k++;
const t=performance.now(),m=shown.marks[k%shown.marks.length],b=svg.getBoundingClientRect();
svg.dispatchEvent(new PointerEvent('pointermove',{clientX:b.left+m[0],clientY:b.top+m[1]}));if(k%8==0)pick((picked+1)%nRun);
if(cursors.length)seek(first+(last-first)*(k%50)/50);document.body.offsetWidth;spent+=performance.now()-t}
found.rate=1000*count/(performance.now()-t0);found.cost=spent/count;"""
DO += RATE.replace("SPAN", "500") + """found.histories=D.histories.map(h=>Object.fromEntries(Object.entries(h.runs).map(([k,r])=>[k,{n:h.n,u:h.u,w:r.w,v:[...f32(r.v)],lo:[...f32(r.lo)],hi:[...f32(r.hi)]}])));
found.results=R.map(r=>[r.n,r.u,r.f])"""


def make_studies(program, directory):
    """Pages by name: every sweep of inputs/studies, shortened, and a grid that keeps its channels. Without pictures by gnuplot."""
    directory.mkdir(exist_ok=True)
    (directory / "grid.deck").write_text(GRID.format(ROOT / "inputs" / "slider_crank_dry.deck"), encoding="utf-8")
    for name in NAMES:
        text = f'deck = 1\ninclude "{ROOT / "inputs" / "studies" / name}.deck"\n' + SHORT.get(name, TURN) + "[output]\nreport = on\n"
        if "[ensemble]" in (ROOT / "inputs" / "studies" / f"{name}.deck").read_text(encoding="utf-8"):
            text += FEW
        (directory / f"{name}.deck").write_text(text, encoding="utf-8")

    def one(name):
        words = [program, "sweep", directory / f"{name}.deck", "--jobs", "1", "--out", directory / name, "--quiet"]
        subprocess.run(words, check=True, timeout=60 * SLOWNESS, env={**os.environ, "PATH": str(directory)})
        return directory / name / "report.html"

    names = ["grid", *NAMES]
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return dict(zip(names, pool.map(one, names)))


def csv_of(path):
    """A table: columns by their names without units."""
    with path.open(encoding="utf-8", newline="") as file:
        names, *rows = csv.reader(file)
    return {name.split(" [")[0]: [row[i] for row in rows] for i, name in enumerate(names)}


def numbers_of(cells):
    """Cells as numbers; NaN where there is none."""
    return np.array([float(cell) if cell else np.nan for cell in cells])
