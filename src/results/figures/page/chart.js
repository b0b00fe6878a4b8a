// The plot of a sweep: a result of all runs over a parameter or another result, or cells over two parameters; the pointer over it.
function drawChart() {
  const x = quantity($('x').value),
    y = quantity($('y').value),
    c = quantity($('c').value),
    W = Math.max(300, svg.parentNode.clientWidth),
    H = Math.max(280, Math.min(0.7 * W, 0.7 * innerHeight, 700));
  svg.setAttribute('width', W);
  svg.setAttribute('height', H);
  const box = [70, 34, W - 16, H - below(x.words, W - 86)];
  shown = x.parameter >= 0 && y.parameter >= 0 ? cells(x, y, c, box) : cloud(x, y, c, box);
  svg.innerHTML = shown.text;
  $('key').innerHTML = shown.key;
  ring(
    'ring',
    shown.marks.find(m => m[2] === picked || (shown.isCells && caseOf(m[2]) === caseOf(picked))),
  );
}

// Points, and for a result over a parameter lines through the cases, in an ensemble through their means with the standard deviation
function cloud(x, y, c, box) {
  const colours = colouring(c),
    marks = marksOf(x, y),
    isCurve = x.parameter >= 0 && y.result >= 0,
    extra = [];
  const over = isCurve ? curvesOver(x.parameter) : [];
  if (isCurve && D.ensemble)
    for (let m = 0; m < nCase; m++)
      [-1, 1].forEach(s => {
        const d = spread(y.result, m, 1);
        extra.push(spread(y.result, m, 0) + s * (d === d ? d : 0));
      });
  const ax = axisOf(
      x,
      marks.map(m => m[0]),
      box[0],
      box[2],
    ),
    ay = axisOf(y, marks.map(m => m[1]).concat(extra), box[3], box[1]),
    paths = new Map();
  const placed = marks.map(m => [ax.place(m[0]), ay.place(m[1]), m[2], m[1]]);
  placed.forEach(m => {
    const k = colours.of(m[2]);
    paths.set(k, (paths.get(k) || '') + `M${m[0].toFixed(1)} ${m[1].toFixed(1)}h0`);
  });
  const lines = over.map(list => {
    const k = colours.of(list[0] * D.members),
      isOne = (!c || (c.parameter >= 0 && !together(c.parameter, x.parameter))) && isSeries(list);
    const p = list.map(m => [ax.place(x.of(m * D.members)), ay.place(meanOf(y.result, m)), m]).filter(q => q[1] === q[1]);
    const bars = !D.ensemble
      ? ''
      : p
          .map(q => {
            const d = spread(y.result, q[2], 1),
              a = spread(y.result, q[2], 0);
            return d === d
              ? `M${q[0].toFixed(1)} ${ay.place(a - d).toFixed(1)}V${ay.place(a + d).toFixed(1)}m-4 0h8M${(q[0] - 4).toFixed(1)} ${ay.place(a - d).toFixed(1)}h8`
              : '';
          })
          .join('');
    return (
      (isOne ? `<polyline points="${points(p)}" fill="none" stroke="${k}" stroke-width="1.5"/>` : '') +
      (bars ? `<path d="${bars}" stroke="${isOne ? k : '#555'}" stroke-width="1.5" fill="none"/>` : '') +
      (D.ensemble
        ? p.map(q => `<rect x="${(q[0] - 3).toFixed(1)}" y="${(q[1] - 3).toFixed(1)}" width="6" height="6" fill="${isOne ? k : '#555'}"/>`).join('')
        : '')
    );
  });
  const size = placed.length > 2000 ? 3 : D.ensemble && isCurve ? 5 : 8;
  const key = colours.key + (isCurve && D.ensemble ? '<span>squares: mean of the runs of a case; bars: standard deviation; dots: runs</span>' : '');
  const none = placed.length ? '' : text((box[0] + box[2]) / 2, (box[1] + box[3]) / 2, 'no values', 'middle');
  return {
    marks: placed,
    key,
    text:
      axesText(ax, ay, box) +
      [...paths]
        .map(
          ([k, d]) => `<path d="${d}" stroke="${k}" stroke-width="${size}" stroke-linecap="round" opacity="${D.ensemble && isCurve ? 0.45 : 0.9}"/>`,
        )
        .join('') +
      lines.join('') +
      none,
  };
}

// A result over two parameters: a cell for each pair of values, in it the mean over its runs
function cells(x, y, c, box) {
  const edges = (q, p) => {
    const g = q.log ? Math.log : v => v,
      h = q.log ? Math.exp : v => v,
      v = [...new Set(q.words ? q.words.map((_, k) => k + 1) : [...P[p].x].map(u => u * P[p].f))].sort((a, b) => a - b),
      t = v.map(g);
    const half = k => (t.length < 2 ? Math.abs(t[0]) / 2 || 0.5 : (t[Math.max(1, k)] - t[Math.max(1, k) - 1]) / 2);
    return v.map((u, k) => [u, h(t[k] - half(k)), h(t[k] + half(Math.min(k + 1, t.length - 1)))]);
  };
  const ex = edges(x, x.parameter),
    ey = edges(y, y.parameter),
    result = c && c.result >= 0 ? c : quantity('r' + firstDrawn),
    found = new Map();
  for (let m = 0; m < nCase; m++) {
    const k = m * D.members,
      key = x.of(k) + ';' + y.of(k),
      v = meanOf(result.result, m),
      cell = found.get(key) || {sum: 0, n: 0, k};
    if (v === v) {
      cell.sum += v;
      cell.n++;
    }
    found.set(key, cell);
  }
  const ends = e => e.flatMap(r => [r[1], r[2]]),
    ax = axisOf(x, ends(ex), box[0], box[2], true),
    ay = axisOf(y, ends(ey), box[3], box[1], true),
    all = [...found.values()].filter(s => s.n).map(s => s.sum / s.n);
  const lo = all.reduce((a, b) => Math.min(a, b), Infinity),
    hi = all.reduce((a, b) => Math.max(a, b), -Infinity),
    marks = [],
    parts = [];
  ex.forEach(([u, u0, u1]) =>
    ey.forEach(([v, v0, v1]) => {
      const cell = found.get(u + ';' + v);
      if (!cell) return;
      const r = `x="${ax.place(u0).toFixed(1)}" y="${ay.place(v1).toFixed(1)}" width="${(ax.place(u1) - ax.place(u0) + 0.5).toFixed(1)}" height="${(ay.place(v0) - ay.place(v1) + 0.5).toFixed(1)}"`,
        w = cell.n ? cell.sum / cell.n : NaN;
      const share = hi > lo ? (w - lo) / (hi - lo) : 0.5;
      marks.push([ax.place(u), ay.place(v), cell.k]);
      parts.push(
        cell.n
          ? `<rect ${r} fill="${shade(share)}" shape-rendering="crispEdges"/>` +
              (found.size <= 36 ? text(ax.place(u).toFixed(1), (ay.place(v) + 4).toFixed(1), tidy(w), 'middle', share > 0.6 ? '#111' : '#fff') : '')
          : `<rect ${r} fill="#eee" stroke="#aaa"/>` + text(ax.place(u).toFixed(1), (ay.place(v) + 4).toFixed(1), 'no value', 'middle', '#777'),
      );
    }),
  );
  const key = `<span>${safe(result.n)}${D.ensemble ? ', mean' : ''} ${tidy(lo)}<b style="background:linear-gradient(90deg,${[0, 0.25, 0.5, 0.75, 1].map(shade)})"></b>${tidy(hi)} ${safe(result.u)}</span>`;
  return {marks, key, text: axesText(ax, ay, box) + parts.join(''), isCells: true, result};
}

// A ring around a point: an element of its own, so that the plot is not drawn again as it moves
function ring(id, mark) {
  $(id).hidden = !mark;
  if (mark) $(id).style.transform = `translate(${mark[0].toFixed(1)}px,${mark[1].toFixed(1)}px)`;
}

// The nearest point of the plot to the pointer
function nearest(e) {
  const box = svg.getBoundingClientRect(),
    u = e.clientX - box.left,
    v = e.clientY - box.top;
  let best = null,
    least = shown.isCells ? Infinity : 30 ** 2;
  shown.marks.forEach(m => {
    const d = (m[0] - u) ** 2 + (m[1] - v) ** 2;
    if (d < least) {
      least = d;
      best = m;
    }
  });
  return best;
}
function hover(e) {
  const m = nearest(e),
    tip = $('tip');
  ring('near', m);
  tip.hidden = !m;
  if (!m) return;
  const asked = [...new Set([$('y').value, $('x').value, $('c').value])].map(quantity).filter(q => q && q.of && !(q.parameter >= 0));
  tip.textContent = [runText(m[2]), ...P.map(p => p.n + ' = ' + p.texts[p.at[caseOf(m[2])]]), ...asked.map(q => q.n + ' = ' + said(q, m[2]))].join(
    '\n',
  );
  const y = quantity($('y').value);
  if (y.samples >= 0) tip.textContent += '\n' + y.n + ' = ' + tidy(m[3]) + ' ' + y.u;
  const left = m[0] + 14 + tip.offsetWidth > svg.clientWidth ? m[0] - 14 - tip.offsetWidth : m[0] + 14;
  tip.style.transform = `translate(${Math.max(0, left)}px,${Math.min(m[1], svg.clientHeight - tip.offsetHeight)}px)`;
}
