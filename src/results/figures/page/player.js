// Controls: play, scrub, views, names, forces, traces.
let playing = false, before = 0;
// Seconds of the motion in one of the playback: round numbers. The usual one takes about six seconds for all.
const rates = [];
for (let p = 0; p <= 12; p++) [1, 1.5, 2, 3, 5, 7].forEach(m => rates.push(m * 10 ** p, 1 / (m * 10 ** p)));
rates.sort((a, b) => a - b);
const usual = rates.reduce((a, r, k) => Math.abs(Math.log(r * 6 / span)) < Math.abs(Math.log(rates[a] * 6 / span)) ? k : a, 0);
const rateName = r => r > 0.999 && r < 1.001 ? 'real time' : r >= 1 ? short(r) + ' \u00d7 real time' : '1/' + short(1 / r) + ' of real time';
const pause = 0.6;                     // seconds that the end stands, unless it is where the motion starts again
let resting = 0;
const tracePoint = () => D.points[+$('trace').value] || null;

let shown = 0;                         // when all numbers were shown last: ten times a second are enough while it plays
function show(u) {
  at = Math.min(Math.max(u, 0), N - 1);
  const all = !playing || before - shown > 100;
  if (all) shown = before;
  if (all) $('slider').value = at;
  if (all) $('time').textContent = 't = ' + unit(timeAt(at), 's');
  cursors.forEach(move => move(all));
  needsDraw = true;
}

function seek(t) {
  let k = 0;
  while (k < N - 2 && times[k + 1] <= t) k++;
  stop();
  show(N > 1 ? k + (t - times[k]) / (times[k + 1] - times[k]) : 0);
}

function stop() {
  playing = false;
  $('play').textContent = 'play';
  if (renderer) sharpen();
}

function tick(now) {
  if (playing) {
    if (renderer) keepPace(now - before);
    const passed = (now - before) / 1000, next = at + passed * $('speed').value * (N - 1) / span;
    if (next < N - 1) show(next);
    else if (D.repeats) show(next % (N - 1));
    else if ((resting = at < N - 1 ? 0 : resting + passed) < pause) show(N - 1);
    else show(0);
  }
  before = now;
  if (renderer && needsDraw) { needsDraw = false; draw(); if (D.spatial && D.joints.length && !playing) cursors[0](true); }
  requestAnimationFrame(tick);
}

function start() {
  D.plots.forEach(p => p.curves.forEach(c => { c.x = f64(c.x); c.y = f32(c.y); }));
  $('slider').max = N - 1;
  const option = (id, name, value) => $(id).add(new Option(name, value));
  const offered = [-6, -3, 0, 3].map(k => rates[usual + k]).filter(r => r).concat(1).sort((a, b) => a - b);
  offered.filter((r, k) => !(Math.abs(r / offered[k - 1] - 1) < 1e-3)).forEach(r => option('speed', rateName(r), r));
  $('speed').selectedIndex = [...$('speed').options].findIndex(o => Math.abs(o.value / rates[usual] - 1) < 1e-3);
  option('trace', 'trace: none', -1);
  D.points.forEach((p, k) => option('trace', 'trace: ' + p.n, k));
  D.joints.forEach((j, k) => option('joint', 'joint: ' + j.n, k));
  $('joint').hidden = D.joints.length < 2;
  $('views').hidden = !D.spatial;
  $('for-forces').hidden = !(D.force > 0);
  const is3D = startView();
  ['fit', 'views', 'for-names', 'for-forces'].forEach(id => { $(id).hidden = $(id).hidden || !is3D; });
  $('play').onclick = () => {
    if (playing) return stop();
    playing = true;
    if (at >= N - 1) at = 0;
    resting = 0;
    $('play').textContent = 'stop';
  };
  $('step').onclick = () => { stop(); show(Math.floor(at) + 1 > N - 1 ? 0 : Math.floor(at) + 1); };
  $('back').onclick = () => { stop(); show(Math.ceil(at) - 1 < 0 ? N - 1 : Math.ceil(at) - 1); };
  $('slider').oninput = e => { stop(); show(+e.target.value); };
  $('trace').onchange = () => { if (is3D) setTrace(tracePoint()); buildPlots(); show(at); };
  $('joint').onchange = () => { buildPlots(); show(at); };
  document.onkeydown = e => {
    if (/SELECT|INPUT/.test(e.target.tagName) && e.target.type !== 'checkbox') return;
    if (e.key === 'ArrowRight') $('step').click();
    if (e.key === 'ArrowLeft') $('back').click();
    if (e.key === ' ' && e.target.tagName !== 'BUTTON') { e.preventDefault(); $('play').click(); }
  };
  buildPlots();
  if (is3D) {
    frame.insertAdjacentHTML('beforeend', '<svg id="corner" width="240" height="76"></svg>');
    showPoses();
    buildLabels();
    $('with-names').onchange = e => { $('names').hidden = !e.target.checked; needsDraw = true; };
    $('with-forces').onchange = e => { arrows.visible = e.target.checked; needsDraw = true; };
    $('fit').onclick = fit;
    document.querySelectorAll('[data-view]').forEach(b => { b.onclick = () => setView(b.dataset.view); });
    resize();
    if (D.spatial) setView('isometric');
  }
  const peak = Math.max(0, ...track.f.map(f => magnitudes(f).reduce((a, b) => Math.max(a, b), 0)));
  $('legend').textContent = D.legend + (D.force > 0 && peak > 1.001 * D.force ? '; larger ones are cut and have two heads' : '') + '; ' + N +
    ' positions, straight between them' + (D.joints.length ? '; joints with clearance and their forces at ' + track.t.length + ' rows' : '') +
    '. ' + D.note +
    (is3D ? (D.spatial ? 'Drag: orbit; right button or two fingers: move' : 'Drag: move') + '; wheel: zoom; arrow keys: step; space: play.' : '');
  show(0);
  requestAnimationFrame(tick);
}
start();
