// The runs of a sweep as quantities: parameters, results, Poincaré samples; colours, points and curves of the plot.
const exit = i32(D.exit),
  nRun = exit.length,
  caseOf = k => Math.floor(k / D.members),
  nCase = caseOf(nRun - 1) + 1;
const spaced = s => s.replace(/^([-+]?[\d.]+(?:e[-+]?\d+)?)(?=[^\d.\s])/i, '$1 '); // as 5 mm
const P = D.parameters.map(p => ({...p, x: f64(p.x), at: i32(p.at), texts: p.texts.map(spaced)}));
const R = D.results.map(r => ({...r, v: f64(r.v), s: r.s ? f64(r.s) : null}));
const samples = {run: i32(D.poincare.run), list: D.poincare.list.map(s => ({...s, v: f64(s.v)}))};
const student = f64(D.student);
const svg = document.querySelector('#chart svg');
let picked = 0,
  shown = null; // number of a run; what the plot shows

// A quantity of the runs by its key: p0 a parameter, r0 a result, s0 Poincare samples, n the number of the run
function quantity(key) {
  const i = +key.slice(1);
  if (key[0] === 'p')
    return {
      n: P[i].n,
      u: P[i].u,
      log: P[i].log,
      words: P[i].words ? P[i].texts : null,
      parameter: i,
      of: k => P[i].x[P[i].at[caseOf(k)]] * (P[i].words ? 1 : P[i].f),
    };
  if (key[0] === 'r') return {n: R[i].n, u: R[i].u, result: i, of: k => R[i].v[k] * R[i].f};
  if (key[0] === 's') return {n: samples.list[i].n + ', Poincar\u00e9 samples', u: samples.list[i].u, samples: i};
  if (key[0] === 'n') return {n: 'run', u: '', of: k => k + 1};
  return null;
}
const spread = (i, m, j) => R[i].s[4 * m + j] * R[i].f; // mean, deviation, minimum, maximum of a case
const meanOf = (i, m) => (R[i].s ? spread(i, m, 0) : R[i].v[m] * R[i].f);
const said = (q, k) =>
  q.words ? q.words[q.of(k) - 1] : q.parameter >= 0 ? P[q.parameter].texts[P[q.parameter].at[caseOf(k)]] : tidy(q.of(k)) + (q.u ? ' ' + q.u : '');
const runText = k => (D.ensemble ? (nCase > 1 ? 'case ' + (caseOf(k) + 1) + ', ' : '') + 'run ' + ((k % D.members) + 1) : 'case ' + (caseOf(k) + 1));

// Colours of runs, and what explains them
function colouring(q) {
  if (!q) return {of: () => strokes[0], key: ''};
  if (q.parameter >= 0 && P[q.parameter].texts.length <= 8) {
    const many = strokes.concat('#8c564b', '#555555'),
      p = P[q.parameter];
    return {
      of: k => many[p.at[caseOf(k)]],
      key: p.texts.map((t, i) => `<span><i style="background:${many[i]}"></i>${safe(p.n + ' = ' + t)}</span>`).join(''),
    };
  }
  let lo = Infinity,
    hi = -Infinity;
  for (let k = 0; k < nRun; k++) {
    const v = q.of(k);
    if (v === v) {
      lo = Math.min(lo, v);
      hi = Math.max(hi, v);
    }
  }
  const u = v => (hi > lo ? (v - lo) / (hi - lo) : 0.5);
  return {
    of: k => (q.of(k) === q.of(k) ? shade(Math.round(40 * u(q.of(k))) / 40) : '#bbb'),
    at: v => shade(u(v)),
    key:
      lo > hi
        ? ''
        : `<span>${safe(q.n)} ${tidy(lo)}` +
          `<b style="background:linear-gradient(90deg,${[0, 0.25, 0.5, 0.75, 1].map(shade)})"></b>${tidy(hi)} ${safe(q.u)}</span>`,
  };
}

// Runs, or samples, as points of the plot
function marksOf(x, y) {
  const list = [],
    add = (k, v) => {
      const u = x.of(k);
      if (u === u && v === v) list.push([u, v, k]);
    };
  if (y.samples >= 0) samples.list[y.samples].v.forEach((v, j) => add(samples.run[j], v * samples.list[y.samples].f));
  else for (let k = 0; k < nRun; k++) add(k, y.of(k));
  return list;
}

// Cases that differ in nothing but a parameter and those that change together with it, by increasing values
const together = (j, p) => j === p || (j < D.together && p < D.together);
function curvesOver(p) {
  const curves = new Map();
  for (let m = 0; m < nCase; m++) {
    const key = P.map((q, j) => (together(j, p) ? '' : q.at[m])).join();
    curves.set(key, (curves.get(key) || []).concat(m));
  }
  return [...curves.values()].map(list => list.sort((a, b) => P[p].x[P[p].at[a]] - P[p].x[P[p].at[b]]));
}
// Whether cases that change together make a curve: in the order of the sweep, not sampled ones
const isSeries = list => D.together < 2 || [1, -1].some(s => list.every((m, k) => k === 0 || s * (m - list[k - 1]) > 0));
