// The scene: a group for each body, symbols of joints, and what changes its shape with the motion.
const lit = new THREE.MeshLambertMaterial({vertexColors: THREE.VertexColors, side: THREE.DoubleSide});
const flat = new THREE.MeshBasicMaterial({vertexColors: THREE.VertexColors, side: THREE.DoubleSide});
const pale = new THREE.MeshLambertMaterial({vertexColors: THREE.VertexColors, side: THREE.DoubleSide, transparent: true, opacity: 0.3,
  depthWrite: false});
const dark = '#404040', grey = '#8a8f94', red = '#d1495b', journal = '#9fb4c7', hole = '#f2d98d';
const rodRadius = (D.spatial ? 0.008 : 0.0055) * S;

const world = new THREE.Scene(), groups = [], reach = [];   // reach: boxes about what is fixed in each body
const moving = [];                                          // what is done at each position
const arrows = new THREE.Group(), traces = new THREE.Group();
world.add(arrows, traces);

const place = (b, s) => vec(s).applyMatrix4(groups[b].matrix);
const raised = (p, layer) => D.spatial ? p : p.clone().setZ(layer * 0.01 * S);   // in the plane: what covers what

function buildBodies() {
  const parts = D.bodies.map(() => ({lit: new Solid(), flat: new Solid(), pale: new Solid()}));
  D.bodies.forEach(() => { const g = new THREE.Group(); g.matrixAutoUpdate = false; world.add(g); groups.push(g); });
  D.parts.forEach(p => addPart(p, parts[p.b]));
  D.marks.forEach(m => addMark(m, parts));
  parts.forEach((part, b) => {
    const box = new THREE.Box3();
    [['lit', lit], ['flat', flat], ['pale', pale]].forEach(([key, material]) => {
      if (!part[key].p.length) return;
      const mesh = part[key].mesh(material);
      mesh.geometry.computeBoundingBox();
      box.union(mesh.geometry.boundingBox);
      groups[b].add(mesh);
    });
    reach.push(box);
  });
}

// Faces and lines of a body. In the plane a face is a pale area with its outline; in space bodies are solid.
function addPart(part, solid) {
  const s = f32(part.s), points = [], colour = colourOf(part.b);
  for (let k = 0; k < s.length; k += 3) points.push(V3(s[k], s[k + 1], s[k + 2]));
  const t = part.t ? i32(part.t) : [], faces = part.f.slice();
  if (part.t && !D.spatial) {                                                    // a mesh in the plane: below the symbols
    const top = points.reduce((z, p) => Math.max(z, p.z), -Infinity);
    points.forEach(p => { p.z -= top; });
  }
  for (let k = 0; k < t.length; k += 3) faces.push([t[k], t[k + 1], t[k + 2]]);
  if (D.spatial || part.t) {
    solid.lit.faces(points, faces, colour);
    if (faces.length === 1) solid.lit.strip(faces[0].map(v => points[v]), true, newell(points, faces[0]).normalize(), 0.006 * S, colour);
  } else {
    solid.pale.faces(points, faces, colour);
    faces.forEach(f => solid.flat.strip(f.map(v => raised(points[v], 1)), true, V3(0, 0, 1), 0.007 * S, colour));
  }
  part.l.forEach(l => l.slice(1).forEach((v, k) => {
    const a = raised(points[l[k]], 1), b = raised(points[v], 1);
    if (D.spatial) solid.lit.rod(a, b, rodRadius, colour, true);
    else solid.flat.strip([a, b], false, V3(0, 0, 1), 2 * rodRadius, colour);
    [a, b].forEach(p => D.spatial ? solid.lit.ball(p, rodRadius, colour)
      : solid.flat.add(new THREE.CircleBufferGeometry(rodRadius, 14), new THREE.Matrix4().setPosition(p), colour));
  }));
}

// A joint: what is fixed in its bodies goes to their solids, the rest moves
function addMark(m, parts) {
  const [i, j] = m.b, p = m.s.map(vec), ground = m.b.indexOf(0);
  if (m.k === 1 || m.k === 3 || m.k === 5) { if (ground >= 0) stand(parts[0], p[ground]); }
  if (m.k === 1 && D.spatial && m.aj.some(v => v)) { arm(parts[i], p[0], m.a); arm(parts[j], p[1], m.aj); }
  if (m.k === 1) pin(parts[j], p[1], m.a.some(v => v) && j === 0 ? vec(m.a) : null);
  if (m.k === 3) { pin(parts[i], p[0]); pin(parts[j], p[1]); movingRod(m, 0.5 * rodRadius, dark); }
  if (m.k === 2) guide(m, parts[i]);
  if (m.k === 10) { slot(m, parts[i]); pin(parts[j], p[1]); if (j === 0) stand(parts[0], p[1]); }
  if (m.k === 7) plane(m, parts[i]);
  if (m.k === 4 || m.k === 8) {
    m.b.forEach((b, k) => { if (!b && D.spatial) parts[0].lit.add(new THREE.BoxBufferGeometry(0.03 * S, 0.03 * S, 0.03 * S), new THREE.Matrix4().setPosition(p[k]), grey); });
    if (!D.spatial && ground >= 0) anchor(m, ground, parts[0]);
    if (m.k === 4) spring(m); else damper(m);
  }
  if (m.k === 5) bearing(m, parts[i]);
  if ((m.l || m.q) && D.force > 0) arrow(m);
}

function pin(solid, p, axis) {
  if (!D.spatial) solid.flat.disc(raised(p, 3), 0.014 * S, '#ffffff', dark);
  else if (axis) solid.lit.add(new THREE.CylinderBufferGeometry(0.012 * S, 0.012 * S, 0.05 * S, 18), along(p, axis), '#d8dde2');
  else solid.lit.ball(p, 0.0125 * S, '#d8dde2');
}

// An arm of a cross
function arm(solid, p, axis) {
  const way = vec(axis).normalize().multiplyScalar(0.035 * S);
  solid.lit.rod(p.clone().sub(way), p.clone().add(way), 0.007 * S, dark);
}

// A slot over the way of its pin
function slot(m, solid) {
  const p = raised(vec(m.s[0]), 1.5), u = vec(m.a), n = V3(-u.y, u.x, 0).multiplyScalar(m.h[0]), h = 2 * m.h[0];
  const at = (x, side) => p.clone().addScaledVector(u, x).addScaledVector(n, side);
  solid.flat.strip([at(m.w[0] - h, 1), at(m.w[1] + h, 1), at(m.w[1] + h, -1), at(m.w[0] - h, -1)], true, V3(0, 0, 1), 0.004 * S, dark);
}

// The wall at the fixed end of a spring or damper, across where it points at the first position
function anchor(m, end, solid) {
  const b = m.b[1 - end], p = raised(vec(m.s[end]), -1), q = vec(turned(b, m.s[1 - end])).add(vec(vectorAt(places, nBody, b)));
  const d = p.clone().sub(q).setZ(0);
  if (!(d.length() > 0)) return;
  const n = d.normalize(), across = V3(-n.y, n.x, 0).multiplyScalar(2 * m.c);
  wall(solid, p.clone().sub(across), p.clone().add(across), n);
}

// The ground at a point
function stand(solid, p) {
  const h = 0.035 * S;
  if (D.spatial) {
    solid.lit.add(new THREE.BoxBufferGeometry(h, h, 0.4 * h), new THREE.Matrix4().setPosition(p.clone().setZ(p.z - 0.8 * h)), grey);
    solid.lit.add(new THREE.CylinderBufferGeometry(0.15 * h, 0.35 * h, 0.8 * h, 14), along(p.clone().setZ(p.z - 0.4 * h), V3(0, 0, 1)), grey);
    return;
  }
  const y = p.y - 1.5 * h, line = (...q) => solid.flat.strip(q.map(([a, b]) => V3(a, b, -0.01 * S)), false, V3(0, 0, 1), 0.003 * S, '#707070');
  line([p.x - h, y], [p.x, p.y], [p.x + h, y]);
  line([p.x - 1.5 * h, y], [p.x + 1.5 * h, y]);
  for (let k = -1; k < 2; k += 0.5) line([p.x + k * 1.4 * h, y], [p.x + (k - 0.4) * 1.4 * h, y - 0.6 * h]);
}

// A line with hatching on the side of n
function wall(solid, a, b, n) {
  const z = V3(0, 0, 1), d = b.clone().sub(a), count = Math.max(1, Math.round(d.length() / (0.02 * S)));
  solid.flat.strip([a, b], false, z, 0.003 * S, '#707070');
  for (let k = 0; k < count; k++) {
    const q = a.clone().addScaledVector(d, k / count);
    solid.flat.strip([q, q.clone().addScaledVector(n, 0.016 * S).addScaledVector(d.clone().normalize(), -0.012 * S)], false, z, 0.002 * S, '#707070');
  }
}

function guide(m, solid) {
  const p = vec(m.s[0]), u = vec(m.a), from = m.w[0] - 0.09 * S, to = m.w[1] + 0.09 * S;
  if (D.spatial) { solid.lit.rod(p.clone().addScaledVector(u, from), p.clone().addScaledVector(u, to), 0.0045 * S, grey); return; }
  const n = V3(-u.y, u.x, 0);
  [1, -1].forEach(side => {
    const o = raised(p, -1).addScaledVector(n, side * m.h[side > 0 ? 0 : 1]), a = o.clone().addScaledVector(u, from), b = o.clone().addScaledVector(u, to);
    if (m.b[0] === 0) wall(solid, a, b, n.clone().multiplyScalar(side));
    else solid.flat.strip([a, b], false, V3(0, 0, 1), 0.003 * S, '#707070');
  });
}

function plane(m, solid) {
  const p = vec(m.s[0]), n = vec(m.a).normalize();
  if (!D.spatial) {
    const u = V3(n.y, -n.x, 0);
    wall(solid, raised(p, -1).addScaledVector(u, m.w[0] - 0.2 * S), raised(p, -1).addScaledVector(u, m.w[1] + 0.2 * S), n.clone().negate());
    return;
  }
  const same = D.marks.filter(o => o.k === 7 && o.b[0] === m.b[0] && String(o.s[0]) === String(m.s[0]) && String(o.a) === String(m.a));
  if (same[0] !== m) return;                                                     // one area for all that touch one plane
  const half = Math.max(...same.map(o => Math.max(Math.abs(o.w[0]), Math.abs(o.w[1])))) + 0.06 * S;
  const turn = new THREE.Quaternion().setFromUnitVectors(V3(0, 0, 1), n);
  solid.pale.add(new THREE.BoxBufferGeometry(2 * half, 2 * half, 0.004 * S),
    new THREE.Matrix4().compose(p.clone().addScaledVector(n, -0.002 * S), turn, V3(1, 1, 1)), grey);
}

// A mesh of unit length along y, stretched between two points at each position
function stretched(m, mesh) {
  world.add(mesh);
  mesh.matrixAutoUpdate = false;
  moving.push(() => {
    const a = raised(place(m.b[0], m.s[0]), -3), b = raised(place(m.b[1], m.s[1]), -3), d = b.clone().sub(a), l = d.length();
    mesh.visible = l > 0;
    if (l > 0) mesh.matrix.copy(along(a, d)).scale(V3(1, l, 1));
    mesh.matrixWorldNeedsUpdate = true;
  });
}

function movingRod(m, radius, colour) {
  const solid = new Solid();
  solid.add(new THREE.CylinderBufferGeometry(radius, radius, 1, 10), new THREE.Matrix4().makeTranslation(0, 0.5, 0), colour);
  stretched(m, solid.mesh(lit));
}

function spring(m) {
  const solid = new Solid(), coils = Math.max(2, Math.round(m.z / 2)), path = new THREE.Curve();
  path.getPoint = t => {
    const w = Math.min(1, Math.max(0, (t - 0.15) / 0.7)), c = m.c * (w > 0 && w < 1 ? 1 : 0);
    return V3(c * Math.sin(2 * Math.PI * coils * w), t, c * Math.cos(2 * Math.PI * coils * w));
  };
  const steps = 18 * coils + 12, r = Math.min(0.004 * S, 0.2 * m.c);
  for (let k = 0; k < steps; k++) solid.rod(path.getPoint(k / steps), path.getPoint((k + 1) / steps), r, dark, true);
  stretched(m, solid.mesh(lit));
}

function damper(m) {
  const solid = new Solid(), c = Math.max(m.c, 0.004 * S), cylinder = (r, l, y, colour) =>
    solid.add(new THREE.CylinderBufferGeometry(r, r, l, 16), new THREE.Matrix4().makeTranslation(0, y, 0), colour);
  cylinder(0.25 * c, 0.3, 0.15, dark);
  cylinder(c, 0.45, 0.5, '#b9c2cb');
  cylinder(0.35 * c, 0.3, 0.85, dark);
  stretched(m, solid.mesh(lit));
}

// A joint with clearance: hole and journal in their size or larger, the eccentricity magnified
function bearing(m, solid) {
  const p = vec(m.s[0]), [R, r] = m.R, hasSize = R > 0.0341 * S, axis = m.a.some(v => v) ? vec(m.a) : null, inner = new Solid();
  if (!D.spatial) {
    solid.flat.disc(raised(p, 2), R, '#fff4d6', dark);
    inner.disc(V3(0, 0, 0), r, journal, dark);
    if (hasSize) inner.strip([V3(-r, 0, 0.002 * S), V3(r, 0, 0.002 * S)], false, V3(0, 0, 1), 0.004 * S, dark);   // its turn is seen
  } else if (axis) {
    solid.pale.add(new THREE.CylinderBufferGeometry(R, R, 0.07 * S, 28), along(p, axis), hole);
    inner.add(new THREE.CylinderBufferGeometry(r, r, 0.09 * S, 24), along(V3(0, 0, 0), axis), journal);
  } else {
    solid.pale.ball(p, R, hole);
    inner.ball(V3(0, 0, 0), r, journal);
  }
  const mesh = inner.mesh(D.spatial ? lit : flat);
  world.add(mesh);
  moving.push(() => {
    const e = m.l ? vec(rowVector(track.e[m.l - 1])).multiplyScalar(D.magnified) : V3(0, 0, 0);
    mesh.position.copy(raised(place(m.b[0], m.s[0]), 3).add(e));
    mesh.quaternion.setFromRotationMatrix(groups[m.b[D.spatial ? 0 : 1]].matrix);
  });
}

// A force as it is drawn: in proportion to the largest at the positions; what is beyond is cut there and has a second head
const longestArrow = 0.25 * S;
function arrowOf(force) {
  const d = vec(force).multiplyScalar(longestArrow / D.force), l = d.length(), isCut = l > 1.001 * longestArrow;
  return {d: isCut ? d.multiplyScalar(1.2 * longestArrow / l) : d, isCut};
}
const forceOf = m => m.l ? rowVector(track.f[m.l - 1]) : vectorAt(loads, loads.length / 3 / N, m.q - 1);

// A force at the second point
function arrow(m) {
  const shaft = new Solid(), head = new Solid();
  shaft.add(new THREE.CylinderBufferGeometry(0.0045 * S, 0.0045 * S, 1, 12), new THREE.Matrix4().makeTranslation(0, 0.5, 0), red);
  head.add(new THREE.ConeBufferGeometry(0.014 * S, 0.04 * S, 18), new THREE.Matrix4().makeTranslation(0, -0.02 * S, 0), red);
  const meshes = [shaft.mesh(lit), head.mesh(lit), head.mesh(lit)];
  meshes.forEach(mesh => { mesh.matrixAutoUpdate = false; arrows.add(mesh); });
  moving.push(() => {
    const {d, isCut} = arrowOf(forceOf(m)), l = d.length(), a = raised(place(m.b[1], m.s[1]), 5);
    meshes.forEach((mesh, k) => { mesh.visible = l > 1e-3 * S && (k < 2 || isCut); });
    if (!(l > 1e-3 * S)) return;
    const size = Math.min(1, l / (0.06 * S)), second = d.clone().setLength(Math.max(0, l - 0.05 * S));
    meshes[0].matrix.copy(along(a, d)).scale(V3(size, Math.max(l - 0.03 * S * size, 0.01 * l), size));
    meshes[1].matrix.copy(along(a.clone().add(d), d)).scale(V3(size, size, size));
    meshes[2].matrix.copy(along(a.clone().add(second), d));
    meshes.forEach(mesh => { mesh.matrixWorldNeedsUpdate = true; });
  });
}

// The path of a point through all positions
function setTrace(point) {
  traces.children.slice().forEach(mesh => { traces.remove(mesh); mesh.geometry.dispose(); });
  if (!point) return;
  const kept = at, solid = new Solid();
  let before = null;
  for (at = 0; at < N; at++) {
    const pose = poseAt(point.b), q = new THREE.Quaternion(...pose.q), p = raised(vec(point.s).applyQuaternion(q).add(vec(pose.r)), 4);
    if (before) solid.rod(before, p, 0.003 * S, red, true);
    before = p;
  }
  at = kept;
  if (solid.p.length) traces.add(solid.mesh(lit));
}

function showPoses() {
  groups.forEach((g, b) => {
    const pose = poseAt(b);
    g.matrix.compose(vec(pose.r), new THREE.Quaternion(...pose.q), V3(1, 1, 1));
    g.matrixWorldNeedsUpdate = true;
  });
  moving.forEach(move => move());
}
