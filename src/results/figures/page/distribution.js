// Histogram and cumulative distribution of a result over some runs; mean, standard deviation and interval of a case of an ensemble
function distribution(target, i, m) {
  const q = quantity('r' + i),
    runs = [...Array(nRun).keys()].filter(k => m < 0 || caseOf(k) === m),
    v = runs
      .map(q.of)
      .filter(u => u === u)
      .sort((a, b) => a - b),
    n = v.length;
  const box = [48, 40, 372, 178],
    head = text(6, 15, safe(q.n + (q.u ? ' [' + q.u + ']' : ''))) + text(6, 31, 'runs', 'start') + text(414, 31, 'share', 'end', '#d1495b');
  target.setAttribute('viewBox', '0 0 420 236');
  if (!n) {
    target.innerHTML = head + text(210, 110, 'no values', 'middle');
    return;
  }
  const isFlat = !(v[n - 1] - v[0] > 1e-9 * Math.abs(v[n - 1])),
    pad = isFlat ? Math.abs(v[0]) * 0.1 || 1 : 0,
    step = roundStep(v[0] - pad, v[n - 1] + pad, Math.min(40, Math.max(4, Math.ceil(2 * Math.sqrt(n)))));
  const low = step * Math.floor((v[0] - pad) / step + 1e-9),
    nBin = Math.max(1, Math.ceil((v[n - 1] + pad - low) / step + 1e-9)),
    counts = Array(nBin).fill(0);
  v.forEach(u => counts[Math.min(nBin - 1, Math.floor((u - low) / step + 1e-9))]++);
  const ax = axisOf({n: '', u: ''}, [low, low + nBin * step], box[0], box[2], true),
    most = Math.max(...counts),
    Y = u => box[3] - (box[3] - box[1]) * u;
  const bars = counts
    .map(
      (u, b) =>
        `<rect x="${ax.place(low + b * step).toFixed(1)}" y="${Y(u / most).toFixed(1)}" width="${(ax.place(step) - ax.place(0)).toFixed(1)}" height="${(box[3] - Y(u / most)).toFixed(1)}" fill="#9cc3e6" stroke="#fff"/>`,
    )
    .join('');
  const steps = 'M' + box[0] + ' ' + box[3] + v.map((u, k) => `H${ax.place(u).toFixed(1)}V${Y((k + 1) / n).toFixed(1)}`).join('') + 'H' + box[2];
  let band = '',
    words = `${n} runs; minimum ${tidy(v[0])}, maximum ${tidy(v[n - 1])}`;
  if (m >= 0 && R[i].s) {
    const a = spread(i, m, 0),
      d = spread(i, m, 1),
      h = n > 1 ? (student[n - 2] * d) / Math.sqrt(n) : NaN;
    const part = (w, y, colour) =>
      `<path d="M${Math.max(box[0], ax.place(a - w)).toFixed(1)} ${y}H${Math.min(box[2], ax.place(a + w)).toFixed(1)}" stroke="${colour}" stroke-width="5" opacity=".7"/>`;
    band =
      `<path d="M${ax.place(a).toFixed(1)} ${box[1]}V${box[3]}" stroke="#2e8b57" stroke-width="2"/>` +
      (n > 1 ? part(d, box[1] - 3, '#c9d8cf') + part(h, box[1] - 3, '#2e8b57') : '');
    words =
      `mean ${tidy(a)}` +
      (n > 1 ? `, 95 % interval \u00b1${tidy(h)}; deviation ${tidy(d)}` : '') +
      `;;${n} runs; minimum ${tidy(v[0])}, maximum ${tidy(v[n - 1])}`;
  }
  const own = q.of(picked),
    mark = own === own && runs.includes(picked) ? `<path d="M${ax.place(own).toFixed(1)} ${box[3]}l-5 9h10z" fill="#111"/>` : '';
  target.innerHTML =
    head +
    bars +
    ax.ticks
      .map(t => text(ax.place(t[0]).toFixed(1), box[3] + 22, t[1], 'middle'))
      .filter((_, k) => k % Math.ceil(ax.ticks.length / 6) === 0)
      .join('') +
    [0, most].map(u => text(box[0] - 5, Y(u / most) + 4, u, 'end')).join('') +
    [0, 1].map(u => text(box[2] + 5, Y(u) + 4, u, 'start', '#d1495b')).join('') +
    `<path d="${steps}" fill="none" stroke="#d1495b" stroke-width="1.5"/>` +
    band +
    mark +
    `<path d="M${box[0]} ${box[1]}V${box[3]}H${box[2]}" fill="none" stroke="#404040"/>` +
    words
      .split(';;')
      .map((w, k) => text(6, box[3] + 39 + 16 * k, safe(w)))
      .join('');
}
