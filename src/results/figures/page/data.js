// What the run wrote (D), and the pose of each body at any time between two positions.
const S = D.size;                      // size of the symbols [m]
const times = f64(D.t), N = times.length;
const places = f32(D.r), turns = f32(D.q);               // (frame, body, 3) [m], (frame, body, 4) quaternions x y z w
const loads = f32(D.g);                                  // (frame, force element, 3) [N]
const track = {t: f64(D.track.t), e: D.track.e.map(f32), f: D.track.f.map(f32)};   // rows of joints with clearance: (row, 3) [m], [N]
const nBody = D.bodies.length;

let at = 0;                            // position that is shown: a whole number, or between two of them
const below = () => Math.min(Math.floor(at), N - 1);
const timeAt = u => {
  const k = Math.min(Math.floor(u), N - 1), w = u - k;
  return k + 1 < N ? times[k] * (1 - w) + times[k + 1] * w : times[k];
};

// A vector of a list (frame, item, 3), linear between two positions
function vectorAt(list, count, item) {
  const k = below(), w = at - k, i = 3 * (k * count + item), j = k + 1 < N ? i + 3 * count : i;
  return [0, 1, 2].map(c => list[i + c] * (1 - w) + list[j + c] * w);
}

// Eccentricity or force of a joint with clearance, linear between two rows of the run: impacts are shorter than a position lasts
function rowVector(list) {
  if (!track.t.length) return [0, 0, 0];
  const [k, w] = placeOf(track.t, timeAt(at)), i = 3 * k, j = k + 1 < track.t.length ? i + 3 : i;
  return [0, 1, 2].map(c => list[i + c] * (1 - w) + list[j + c] * w);
}

// Pose of a body: position linear, quaternion linear and normalised
function poseAt(b) {
  const k = below(), w = at - k, i = 4 * (k * nBody + b), j = k + 1 < N ? i + 4 * nBody : i;
  let near = 0;
  for (let c = 0; c < 4; c++) near += turns[i + c] * turns[j + c];
  const q = [0, 1, 2, 3].map(c => turns[i + c] * (1 - w) + turns[j + c] * (near < 0 ? -w : w));
  const l = Math.hypot(...q);
  return {r: vectorAt(places, nBody, b), q: q.map(v => v / l)};
}
