// Controls: play, scrub, views, names, forces, traces.
let playing = false, before = 0;
const seconds = 6;                     // of the whole motion at speed 1
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
    const next = at + (now - before) / 1000 * N / seconds * $('speed').value;
    show(next >= N ? 0 : next);
    if (next > N - 1 && next < N) at = next;   // the last position stands as long as every other
  }
  before = now;
  if (renderer && needsDraw) { needsDraw = false; draw(); if (D.spatial && D.joints.length && !playing) cursors[0](true); }
  requestAnimationFrame(tick);
}

function start() {
  D.plots.forEach(p => p.curves.forEach(c => { c.x = f64(c.x); c.y = f32(c.y); }));
  $('slider').max = N - 1;
  const option = (id, name, value) => $(id).add(new Option(name, value));
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
  const span = last - first, slow = seconds / span;
  $('legend').textContent = D.legend + '; ' + N + ' positions, straight between them' + (N > 1 ? '; speed \u00d7 1 is ' +
    (slow >= 1 ? short(slow) + ' times slower' : short(1 / slow) + ' times faster') + ' than the motion' : '') + '. ' + D.note +
    (is3D ? (D.spatial ? 'Drag: orbit; right button or two fingers: move' : 'Drag: move') + '; wheel: zoom; arrow keys: step; space: play.' : '');
  show(0);
  requestAnimationFrame(tick);
}
start();
