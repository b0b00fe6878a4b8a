// Camera, orbit, standard views, names and axes over the picture.
const frame = $('scene');
let renderer = null, camera, controls, needsDraw = true, isFitted = true, isTurned = true;

const directions = {front: [0, -1, 0], top: [0, 0, 1], right: [1, 0, 0], isometric: [1, -1, 0.8]};

// Whether the browser draws in three dimensions; if not, a sentence stands in place of the picture
function startView() {
  try {
    const canvas = document.createElement('canvas');
    if (!canvas.getContext('webgl')) throw new Error('no WebGL');
    renderer = new THREE.WebGLRenderer({canvas, antialias: true});
  } catch (problem) {
    frame.insertAdjacentHTML('afterbegin', '<p>This browser does not draw in three dimensions (WebGL is off or missing), so the ' +
      'mechanism is not shown. The plots are.</p>');
    return false;
  }
  renderer.setPixelRatio(sharpest());
  renderer.setClearColor(0xffffff);
  frame.insertBefore(renderer.domElement, frame.firstChild);
  camera = new THREE.OrthographicCamera(-1, 1, 1, -1, -1e3 * S, 1e3 * S);
  camera.up.set(0, D.spatial ? 0 : 1, D.spatial ? 1 : 0);
  world.add(camera, new THREE.HemisphereLight(0xffffff, 0x8d8d9a, 0.75));
  const lamp = new THREE.DirectionalLight(0xffffff, 0.5);
  lamp.position.set(-0.5, 0.8, 1);
  camera.add(lamp);
  camera.position.set(0, 0, S);
  controls = new THREE.OrbitControls(camera, renderer.domElement);
  if (!D.spatial) {
    controls.enableRotate = false;
    controls.mouseButtons.LEFT = THREE.MOUSE.PAN;
    controls.touches.ONE = THREE.TOUCH.PAN;
  }
  controls.addEventListener('change', () => { needsDraw = isTurned = true; });
  controls.addEventListener('start', () => { isFitted = false; });
  window.addEventListener('resize', resize);
  buildBodies();
  return true;
}

// While it plays: fewer pixels where pictures come slower than thirty in a second; all of them again when it stops
const sharpest = () => Math.min(window.devicePixelRatio || 1, 2);
let interval = 20;                     // mean time between pictures [ms]
function keepPace(ms) {
  interval += 0.15 * (Math.min(ms, 200) - interval);
  if (interval < 35 || renderer.getPixelRatio() < 0.5) return;
  renderer.setPixelRatio(0.8 * renderer.getPixelRatio());
  interval = 20;
}

function sharpen() {
  interval = 20;
  if (renderer.getPixelRatio() < sharpest()) renderer.setPixelRatio(sharpest());
  needsDraw = true;
}

function resize() {
  renderer.setSize(frame.clientWidth, frame.clientHeight);
  const a = frame.clientWidth / frame.clientHeight;
  camera.left = -a; camera.right = a; camera.top = 1; camera.bottom = -1;
  if (isFitted) fit(); else camera.updateProjectionMatrix();
  needsDraw = isTurned = true;
}

function setView(name) {
  const d = vec(directions[name]).normalize();
  camera.position.copy(controls.target).addScaledVector(d, 3 * S);
  if (name === 'top') camera.position.y -= 1e-4 * S;   // the orbit has its pole there
  controls.update();
  fit();
}

// All positions of all bodies in the picture
function fit() {
  camera.updateMatrixWorld(true);
  const right = V3().setFromMatrixColumn(camera.matrixWorld, 0), up = V3().setFromMatrixColumn(camera.matrixWorld, 1);
  const back = V3().setFromMatrixColumn(camera.matrixWorld, 2), lo = [Infinity, Infinity, Infinity], hi = [-Infinity, -Infinity, -Infinity];
  const kept = at, stride = Math.max(1, Math.floor(N / 40)), corner = V3();
  const take = p => [right, up, back].forEach((axis, k) => {
    const x = p.dot(axis);
    lo[k] = Math.min(lo[k], x);
    hi[k] = Math.max(hi[k], x);
  });
  for (let k = 0; k < N; k += stride) {
    at = k;
    showPoses();
    groups.forEach((g, b) => {
      if (b && reach[b].isEmpty()) take(corner.setFromMatrixPosition(g.matrix));
      if (reach[b].isEmpty() || (b === 0 && k > 0)) return;
      for (let c = 0; c < 8; c++) {
        corner.set(...[0, 1, 2].map(e => (c >> e & 1 ? reach[b].max : reach[b].min).getComponent(e)));
        take(corner.applyMatrix4(g.matrix));
      }
    });
    D.marks.forEach(m => {
      if (m.k !== 7) m.b.forEach((b, e) => take(place(b, m.s[e])));
      if ((m.l || m.q) && D.force > 0) forcesUntil(m, k, stride).forEach(f => take(place(m.b[1], m.s[1]).add(arrowOf(f).d)));
    });
  }
  at = kept;
  showPoses();
  const middle = lo.map((v, k) => 0.5 * (v + hi[k])), shift = V3();
  [right, up, back].forEach((axis, k) => shift.addScaledVector(axis, middle[k]));
  camera.position.add(shift.clone().sub(controls.target));
  controls.target.copy(shift);
  camera.zoom = Math.min(2 * camera.right / (1.12 * (hi[0] - lo[0]) + 0.05 * S), 2 / (1.12 * (hi[1] - lo[1]) + 0.05 * S));
  camera.updateProjectionMatrix();
  controls.update();
  isFitted = true;
  needsDraw = isTurned = true;
}

// Forces at a mark from a position to the next that is looked at
function forcesUntil(m, k, stride) {
  if (!m.l) return [forceOf(m)];
  const list = [], f = track.f[m.l - 1], end = times[Math.min(k + stride, N - 1)];
  for (let i = placeOf(track.t, times[k])[0]; i < track.t.length && track.t[i] <= end; i++) list.push(f.subarray(3 * i, 3 * i + 3));
  return list;
}

// Names of bodies and joints as text over the picture
const labels = [];
function buildLabels() {
  const add = (text, colour, where) => {
    const span = document.createElement('span');
    span.textContent = text;
    span.style.color = colour;
    $('names').append(span);
    labels.push({span, where});
  };
  const used = new Set();
  D.bodies.forEach((name, b) => { if (b) add(name, colourOf(b), () => V3().setFromMatrixPosition(groups[b].matrix)); });
  D.marks.forEach(m => {
    if (used.has(m.n)) return;
    used.add(m.n);
    add(m.n, '#333', () => m.k === 3 || m.k === 4 || m.k === 8 ? place(m.b[0], m.s[0]).add(place(m.b[1], m.s[1])).multiplyScalar(0.5)
      : m.k === 2 || m.k === 10 ? place(m.b[1], m.s[1]) : place(m.b[0], m.s[0]));
  });
}

function placeLabels() {
  if ($('names').hidden) return;
  const w = frame.clientWidth, h = frame.clientHeight, taken = [];
  labels.forEach(({span, where}) => {
    const p = where().project(camera), x = (p.x + 1) / 2 * w + 8;
    let y = (1 - p.y) / 2 * h - 18;
    while (taken.some(q => Math.abs(q[0] - x) < 60 && Math.abs(q[1] - y) < 15)) y += 15;   // one below the other
    taken.push([x, y]);
    span.style.transform = `translate(${x}px,${y}px)`;
  });
}

// The world's axes and a scale in the corner
function drawCorner() {
  const right = V3().setFromMatrixColumn(camera.matrixWorld, 0), up = V3().setFromMatrixColumn(camera.matrixWorld, 1);
  const axes = [['x', '#c0392b', V3(1, 0, 0)], ['y', '#2e8b57', V3(0, 1, 0)], ['z', '#1f6fb4', V3(0, 0, 1)]];
  const lines = axes.slice(0, D.spatial ? 3 : 2).map(([name, colour, axis]) => {
    const x = 26 * axis.dot(right), y = -26 * axis.dot(up);
    return `<path d="M36 44l${x} ${y}" stroke="${colour}" stroke-width="2"/>` + (Math.hypot(x, y) < 3 ? '' :
      `<text x="${36 + 1.35 * x}" y="${48 + 1.35 * y}" fill="${colour}" font-size="12" text-anchor="middle">${name}</text>`);
  });
  const metre = frame.clientHeight * camera.zoom / 2, most = 120 / metre, ten = Math.pow(10, Math.floor(Math.log10(most)));
  const bar = ten * (most / ten >= 5 ? 5 : most / ten >= 2 ? 2 : 1), w = bar * metre;
  $('corner').innerHTML = lines.join('') + `<path d="M84 62v6M84 65h${w}M${84 + w} 62v6" stroke="#555" fill="none"/>` +
    `<text x="${84 + w / 2}" y="58" fill="#555" font-size="12" text-anchor="middle">${unit(bar, 'm')}</text>`;
}

function draw() {
  showPoses();
  renderer.render(world, camera);
  placeLabels();
  if (isTurned) drawCorner();
  isTurned = false;
}
