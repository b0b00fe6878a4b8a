// Triangles of bodies and symbols: what is fixed in a body becomes one mesh for each material.
const palette = ['#1f6fb4', '#2e8b57', '#7b4fa3', '#c98a00', '#17a2b8', '#8c564b', '#5a6e1e', '#3c3c78'];
const colourOf = b => b ? palette[(b - 1) % palette.length] : '#8a8f94';
const V3 = (x, y, z) => new THREE.Vector3(x, y, z), vec = a => V3(a[0], a[1], a[2]);
const crease = Math.cos(35 * Math.PI / 180);   // faces that meet at a larger angle keep their edge

class Solid {
  constructor() { this.p = []; this.n = []; this.c = []; this.i = []; }

  vertex(p, n, c) { this.p.push(p.x, p.y, p.z); this.n.push(n.x, n.y, n.z); this.c.push(c.r, c.g, c.b); return this.p.length / 3 - 1; }

  // A geometry of three.js, placed by a matrix
  add(geometry, matrix, colour) {
    const g = geometry.index ? geometry : geometry.toNonIndexed(), c = new THREE.Color(colour), first = this.p.length / 3;
    const turn = new THREE.Matrix3().getNormalMatrix(matrix), p = g.attributes.position, n = g.attributes.normal;
    for (let k = 0; k < p.count; k++)
      this.vertex(V3().fromBufferAttribute(p, k).applyMatrix4(matrix), V3().fromBufferAttribute(n, k).applyMatrix3(turn).normalize(), c);
    for (let k = 0; k < g.index.count; k++) this.i.push(first + g.index.getX(k));
  }

  // Polygons over shared vertices; normals are means over the faces at a vertex that meet at less than the crease
  faces(points, list, colour) {
    const c = new THREE.Color(colour), normals = list.map(f => newell(points, f)), about = points.map(() => []);
    list.forEach((f, k) => f.forEach(v => about[v].push(k)));
    const units = normals.map(n => n.clone().normalize());
    list.forEach((f, k) => {
      const own = f.map(v => {
        const n = V3(0, 0, 0);
        about[v].forEach(o => { if (units[o].dot(units[k]) > crease) n.add(normals[o]); });
        return this.vertex(points[v], n.lengthSq() > 0 ? n.normalize() : units[k], c);
      });
      triangles(f.map(v => points[v]), units[k]).forEach(t => this.i.push(own[t[0]], own[t[1]], own[t[2]]));
    });
  }

  // A flat strip of a width along a line in a plane with normal n
  strip(line, closed, n, width, colour) {
    const c = new THREE.Color(colour), count = line.length, first = this.p.length / 3;
    line.forEach((p, k) => {
      const a = line[k > 0 ? k - 1 : closed ? count - 1 : 0], b = line[k < count - 1 ? k + 1 : closed ? 0 : count - 1];
      const d1 = p.clone().sub(a).normalize(), d2 = b.clone().sub(p).normalize(), s = V3().crossVectors(n, d1.clone().add(d2)).normalize();
      const wide = 0.5 * width / Math.max(0.5, s.dot(V3().crossVectors(n, d1.lengthSq() > 0 ? d1 : d2)));
      this.vertex(p.clone().addScaledVector(s, wide), n, c);
      this.vertex(p.clone().addScaledVector(s, -wide), n, c);
    });
    for (let k = 0; k < (closed ? count : count - 1); k++) {
      const i = first + 2 * k, j = first + 2 * ((k + 1) % count);
      this.i.push(i, i + 1, j, j, i + 1, j + 1);
    }
  }

  rod(a, b, radius, colour, open) {
    const d = b.clone().sub(a), l = d.length();
    if (!(l > 0)) return;
    this.add(new THREE.CylinderBufferGeometry(radius, radius, l, 10, 1, open), along(a.clone().add(b).multiplyScalar(0.5), d), colour);
  }

  ball(p, radius, colour) { this.add(new THREE.SphereBufferGeometry(radius, 14, 10), new THREE.Matrix4().setPosition(p), colour); }

  // A disc with a rim, across z
  disc(p, radius, colour, rim) {
    this.add(new THREE.CircleBufferGeometry(radius, 96), new THREE.Matrix4().setPosition(p), colour);
    this.add(new THREE.RingBufferGeometry(radius - Math.min(0.14 * radius, 0.005 * S), radius, 96), new THREE.Matrix4().setPosition(p.clone().setZ(p.z + 1e-3 * S)), rim);
  }

  mesh(material) {
    const g = new THREE.BufferGeometry();
    g.setAttribute('position', new THREE.Float32BufferAttribute(this.p, 3));
    g.setAttribute('normal', new THREE.Float32BufferAttribute(this.n, 3));
    g.setAttribute('color', new THREE.Float32BufferAttribute(this.c, 3));
    g.setIndex(this.p.length / 3 > 65535 ? new THREE.Uint32BufferAttribute(this.i, 1) : new THREE.Uint16BufferAttribute(this.i, 1));
    return new THREE.Mesh(g, material);
  }
}

// From the y axis of a geometry of three.js to a direction, at a place
function along(p, d) {
  const q = new THREE.Quaternion().setFromUnitVectors(V3(0, 1, 0), d.clone().normalize());
  return new THREE.Matrix4().compose(p, q, V3(1, 1, 1));
}

// Normal of a polygon, as long as twice its area
function newell(points, face) {
  const n = V3(0, 0, 0);
  face.forEach((v, k) => {
    const a = points[v], b = points[face[(k + 1) % face.length]];
    n.x += (a.y - b.y) * (a.z + b.z); n.y += (a.z - b.z) * (a.x + b.x); n.z += (a.x - b.x) * (a.y + b.y);
  });
  return n;
}

// A polygon in triangles, counter-clockwise about its normal; numbers of its corners
function triangles(corners, n) {
  if (corners.length === 3) return [[0, 1, 2]];
  const u = (Math.abs(n.x) < 0.7 ? V3(1, 0, 0) : V3(0, 1, 0)).cross(n).normalize(), v = V3().crossVectors(n, u);
  const flat = corners.map(p => new THREE.Vector2(p.dot(u), p.dot(v)));
  return THREE.ShapeUtils.triangulateShape(flat, []).map(([a, b, c]) =>
    flat[b].clone().sub(flat[a]).cross(flat[c].clone().sub(flat[a])) < 0 ? [a, c, b] : [a, b, c]);
}
