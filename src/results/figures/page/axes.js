// Axes over any quantity: round ticks, logarithms, words; colours of a scale.
const tidy = x => (Object.is(+x.toPrecision(5), -0) ? 0 : +x.toPrecision(5));

// A round length of which a range has about n, or fewer; round values within the range, with labels
function roundStep(lo, hi, n) {
  const raw = (hi - lo) / Math.max(1, n),
    power = 10 ** Math.floor(Math.log10(raw));
  return [1, 2, 5, 10].map(m => m * power).find(s => s >= raw * 0.999);
}
function roundValues(lo, hi, n) {
  const step = roundStep(lo, hi, n),
    list = [];
  for (let k = Math.ceil(lo / step - 1e-6); k <= hi / step + 1e-6; k++) list.push([k * step, labelOf(k * step, step)]);
  return list;
}
// A tick's label: so many digits that neighbours differ
const labelOf = (v, step) =>
  step < 1e-6 || Math.abs(v) >= 1e7 ? String(+v.toPrecision(6)) : String(+v.toFixed(Math.max(0, -Math.floor(Math.log10(step) + 1e-9))));

// An axis of a quantity {n, u, log, words} from one place on the screen to another, over the values that it shows: `place` gives the place
// of a value, `ticks` are values with their labels.
function axisOf(q, values, from, to, edges) {
  const isLog = q.log && values.every(v => v > 0),
    g = isLog ? Math.log10 : v => v;
  let lo = Infinity,
    hi = -Infinity;
  values.forEach(v => {
    if (v === v) {
      lo = Math.min(lo, v);
      hi = Math.max(hi, v);
    }
  });
  if (!(lo <= hi)) {
    lo = 0;
    hi = 1;
  }
  if (!isLog && !edges && !q.words && lo > 0 && lo < 0.4 * hi) lo = 0;
  const flat = !(hi - lo > 1e-9 * Math.max(Math.abs(lo), Math.abs(hi)));
  let a = g(lo),
    b = g(hi);
  if (q.words) {
    a = 0.5;
    b = q.words.length + 0.5;
  } else if (flat) {
    const pad = isLog ? 0.5 : Math.abs(lo) * 0.1 || 1;
    a -= pad;
    b += pad;
  } else if (!edges) {
    const pad = 0.05 * (b - a);
    a -= lo === 0 ? 0 : pad;
    b += pad;
  }
  const place = v => from + ((to - from) * (g(v) - a)) / (b - a),
    space = Math.abs(to - from);
  let ticks = [];
  if (q.words) ticks = q.words.map((w, k) => [k + 1, w]);
  else if (isLog) {
    for (let p = Math.floor(a); p <= b; p++)
      [1, 2, 5].forEach(m => {
        const v = m * 10 ** p;
        if (g(v) >= a - 1e-9 && g(v) <= b + 1e-9) ticks.push([v, tidy(v)]);
      });
    if (ticks.length > space / 40) ticks = ticks.filter(t => Math.abs(Math.log10(t[0]) % 1) < 1e-9);
  }
  if (ticks.length < 2 && !q.words)
    ticks = roundValues(isLog ? 10 ** a : a, isLog ? 10 ** b : b, space / (from < to ? 80 : 50)).filter(t => !isLog || t[0] > 0);
  return {place, ticks, words: q.words, label: q.n + (q.u ? ' [' + q.u + ']' : '')};
}

// Height below an axis of words, which are turned where they are long
const longest = words => 7.2 * Math.max(...words.map(w => w.length));
const below = (words, width) => (words && longest(words) > width / words.length - 6 ? 42 + 0.41 * longest(words) : 52);

// Both axes with grid and labels
function axesText(x, y, box) {
  const [left, top, right, bottom] = box,
    height = below(x.words, right - left),
    isLong = height !== 52;
  return (
    x.ticks
      .map(t => {
        const p = x.place(t[0]).toFixed(1);
        return (
          `<path d="M${p} ${top}V${bottom}" stroke="#eee"/>` +
          (isLong
            ? `<g transform="translate(${p},${bottom + 15}) rotate(-24)">${text(0, 0, safe(String(t[1])), 'end')}</g>`
            : text(p, bottom + 17, safe(String(t[1])), 'middle'))
        );
      })
      .join('') +
    y.ticks
      .map(t => {
        const p = y.place(t[0]);
        return `<path d="M${left} ${p.toFixed(1)}H${right}" stroke="#eee"/>` + text(left - 6, p + 4, safe(String(t[1]).slice(0, 12)), 'end');
      })
      .join('') +
    `<path d="M${left} ${top}V${bottom}H${right}" fill="none" stroke="#404040"/>` +
    text((left + right) / 2, bottom + (isLong ? height - 8 : 38), safe(x.label), 'middle') +
    text(8, top - 10, safe(y.label))
  );
}

// Colours of a scale from 0 to 1
const palette = [
  [68, 1, 84],
  [59, 82, 139],
  [33, 145, 140],
  [94, 201, 98],
  [253, 231, 37],
];
function shade(u) {
  const s = 4 * Math.min(1, Math.max(0, u)),
    k = Math.min(3, Math.floor(s));
  return 'rgb(' + palette[k].map((c, i) => Math.round(c + (palette[k + 1][i] - c) * (s - k))).join(',') + ')';
}
