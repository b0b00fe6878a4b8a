// Plots beside the picture: histories of the figures of the deck, force and path of a joint with clearance, motion of a point.
const side = $('side'), first = times[0], last = Math.max(times[N - 1], first + Number.MIN_VALUE), span = last - first;
// Two directions across the view: x to the right, y upward
const across = () => camera && D.spatial ? [V3().setFromMatrixColumn(camera.matrixWorld, 0), V3().setFromMatrixColumn(camera.matrixWorld, 1)]
  .map(v => v.toArray()) : [[1, 0, 0], [0, 1, 0]];
const dot = (a, b) => a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
const turned = (b, s) => { const q = poseAt(b).q; return vec(s).applyQuaternion(new THREE.Quaternion(...q)).toArray(); };

// The guide that a joint with clearance is; none if it is another
const isGuide = j => D.marks.find(m => m.k === 2 && m.l === j + 1 && m.d > 0);

// A joint with clearance in the view of the picture, its clearance filling the plot
function orbit(svg, j) {
  const joint = D.joints[j], t = track.t, e = track.e[j];
  const m = isGuide(j);
  let big = joint.c;
  for (let k = 0; k < e.length; k += 3) big = Math.max(big, Math.hypot(e[k], e[k + 1], e[k + 2]));
  const g = 120 / big, R = 165, r = R - joint.c * g, title = text(6, 16, safe(joint.n)) + text(414, 16, 'clearance ' + safe(joint.cw), 'end');
  const circle = (x, y, q, fill) => `<circle cx="${x}" cy="${y}" r="${q}" fill="${fill}" stroke="#404040"/>`;
  return all => {
    if (!all) return;
    const [u, v] = across(), now = rowVector(e), path = [];
    if (m) { svg.innerHTML = slider(m, joint, now, u, v); return; }
    for (let k = 0; k < t.length && t[k] <= timeAt(at); k++) {
      const s = [e[3 * k], e[3 * k + 1], e[3 * k + 2]];
      path.push([210 + g * dot(u, s), 200 - g * dot(v, s)]);
    }
    const x = 210 + g * dot(u, now), y = 200 - g * dot(v, now);
    path.push([x, y]);
    svg.innerHTML = circle(210, 200, R, '#fff4d6') + circle(x, y, r, journal) +
      `<polyline points="${points(path.slice(-400))}" fill="none" stroke="${red}"/>` + circle(x, y, 4, red) + title +
      text(210, 392, 'path of the journal (drawn smaller than the hole)', 'middle');
  };
}

// A slider in its guide, clearance and tilt magnified by the same factor
function slider(m, joint, e, u, v) {
  const flat2 = w => [dot(u, w), -dot(v, w)], a = flat2(turned(m.b[0], m.a)), b = flat2(turned(m.b[1], m.aj));
  const l = Math.hypot(...a), w = Math.hypot(...b), n = [a[1] / l, -a[0] / l];
  if (l < 0.3 || w < 0.3) return text(6, 16, safe(joint.n) + ': seen along its axis');
  const g = 55 / Math.max(...m.g), tilt = (n[0] * b[0] + n[1] * b[1]) / w * m.d * g * Math.sign(a[0] * b[0] + a[1] * b[1]);
  const f = flat2(e), o = g * (n[0] * f[0] + n[1] * f[1]), y1 = 132 - o + tilt, y2 = 132 - o - tilt;
  const wallAt = (y, h) => `<rect x="0" y="${Math.min(y, y + h)}" width="420" height="30" fill="#ddd"/><path class="wall" d="M0 ${y}H420" stroke="#404040"/>`;
  return wallAt(132 - g * m.g[0], -30) + wallAt(272 + g * m.g[1], 30) + text(6, 16, safe(joint.n)) +
    `<polygon points="${points([[75, y1], [345, y2], [345, y2 + 140], [75, y1 + 140]])}" fill="${journal}" stroke="#404040"/>` +
    text(414, 16, 'gaps ' + unit(m.g[0], 'm') + ', ' + unit(m.g[1], 'm'), 'end') + text(210, 396, 'clearance and tilt magnified', 'middle');
}

// The coordinates of a point at all positions
function pointPlot(point) {
  const kept = at, xyz = [[], [], []];
  for (at = 0; at < N; at++) turned(point.b, point.s).forEach((v, c) => xyz[c].push(v + vectorAt(places, nBody, point.b)[c]));
  at = kept;
  const most = Math.max(...xyz.map(l => Math.max(...l.map(Math.abs)))), f = most < 1 ? 1e3 : 1;
  return {title: 'position of ' + point.n, unit: f > 1 ? 'mm' : 'm',
    curves: ['x', 'y', 'z'].slice(0, D.spatial ? 3 : 2).map((n, c) => ({n, x: times, y: xyz[c].map(v => v * f)}))};
}

const magnitudes = list => Array.from({length: list.length / 3}, (_, k) => Math.hypot(list[3 * k], list[3 * k + 1], list[3 * k + 2]));

let cursors = [];
function buildPlots() {
  side.innerHTML = '';
  cursors = [];
  const j = +$('joint').value, point = tracePoint();
  if (D.joints.length) {
    if (D.joints[j].c > 0 || isGuide(j)) {
      const svg = element(402);
      svg.setAttribute('class', 'orbit');
      cursors.push(orbit(svg, j));
    }
    const y = magnitudes(track.f[j]), most = y.reduce((a, b) => Math.max(a, b), 0), f = most >= 1e4 ? 1e-3 : 1;
    cursors.push(timePlot(element(160), {title: 'force in ' + D.joints[j].n, unit: f < 1 ? 'kN' : 'N',
      curves: [{n: 'force', x: track.t, y: y.map(v => v * f)}]}));
  }
  if (point) cursors.push(timePlot(element(160), pointPlot(point)));
  D.plots.forEach(p => cursors.push(timePlot(element(160), p)));
  if (!cursors.length && D.points.length) cursors.push(timePlot(element(160), pointPlot(D.points[D.points.length - 1])));
  side.hidden = !cursors.length;
}
