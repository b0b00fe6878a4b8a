// The run that is picked with its histories, the table of the runs, and what the controls do.
const side = $('side');
let first = 0,
  last = 1,
  at = 0,
  cursors = [];
const timeAt = t => t;
const firstDrawn = Math.max(
  0,
  R.findIndex(r => r.drawn),
);
const stateOf = k => (exit[k] === 0 ? 'done' : exit[k] < 0 ? 'not run' : 'failed (exit code ' + exit[k] + ')');

function seek(t) {
  at = Math.min(last, Math.max(first, t));
  cursors.forEach(move => move(true));
}

// The history of a channel: the run, and in an ensemble mean, standard deviation and extremes of the runs of its case with the same window
function historyPlot(h) {
  const own = h.runs[picked];
  if (!own) return null;
  const read = r => r.read || (r.read = {v: f32(r.v), lo: f32(r.lo), hi: f32(r.hi)}),
    n = read(own).v.length,
    t = Float64Array.from({length: n}, (_, k) => first + ((last - first) * k) / (n - 1));
  const parts = list => ({x: t.slice(0, -1), width: (last - first) / (n - 1), ...list});
  const plot = {
    title: h.n,
    unit: h.u,
    curves: [{n: 'run', x: t, y: own.read.v}],
    bands: [parts({lo: own.read.lo, hi: own.read.hi, colour: strokes[0], opacity: 0.5})],
  };
  const others = Object.keys(h.runs)
    .filter(k => caseOf(+k) === caseOf(picked) && h.runs[k].w.every((w, j) => Math.abs(w - own.w[j]) < 1e-9 * own.w[1]))
    .map(k => read(h.runs[k]));
  if (others.length < 2) return plot;
  const over = (list, f) => Float64Array.from(list[0], (_, k) => f(list.map(l => l[k]).filter(v => v === v)));
  const mean = over(
      others.map(o => o.v),
      l => l.reduce((a, b) => a + b, 0) / l.length,
    ),
    deviation = over(
      others.map(o => o.v),
      l => {
        const a = l.reduce((p, q) => p + q, 0) / l.length;
        return Math.sqrt(l.reduce((p, q) => p + (q - a) ** 2, 0) / (l.length - 1));
      },
    );
  plot.curves.push({n: 'mean of ' + others.length, x: t, y: mean}, {n: 'deviation', x: t, y: deviation, isHidden: true});
  plot.bands.unshift(
    parts({
      lo: over(
        others.map(o => o.lo),
        l => Math.min(...l),
      ),
      hi: over(
        others.map(o => o.hi),
        l => Math.max(...l),
      ),
      colour: '#888',
      opacity: 0.25,
    }),
    {x: t, lo: mean.map((v, k) => v - deviation[k]), hi: mean.map((v, k) => v + deviation[k]), colour: strokes[1], opacity: 0.25},
  );
  return plot;
}

// Beside the plot: the picked run, its histories, the distribution of the result
function buildSide() {
  side.innerHTML = '';
  cursors = [];
  const k = picked,
    keys = [...new Set([$('y').value, $('x').value, $('c').value])].map(quantity).filter(q => q && q.result >= 0),
    box = document.createElement('div');
  box.className = 'picked';
  const row = (a, b) => `<dt>${safe(a)}</dt><dd>${safe(String(b))}</dd>`;
  box.innerHTML =
    `<h2>${runText(k)} <button id="before" aria-label="previous run">&#9664;</button> <button id="next" aria-label="next run">&#9654;</button></h2><dl>` +
    P.map(p => row(p.n, p.texts[p.at[caseOf(k)]])).join('') +
    row('status', stateOf(k)) +
    keys.map(q => row(q.n, said(q, k))).join('') +
    (D.said[k] ? row('message', D.said[k].trim()) : '') +
    '</dl>';
  side.append(box);
  $('before').onclick = () => pick(picked - 1);
  $('next').onclick = () => pick(picked + 1);
  const y = quantity($('y').value),
    i = y && y.result >= 0 ? y.result : R.length && keys.length ? keys[0].result : firstDrawn;
  const kept = D.histories.find(h => h.runs[k]);
  if (kept) {
    [first, last] = kept.runs[k].w;
    const moves = plot => plot.bands.some(b => b.hi.some((v, j) => v - b.lo[j] > 1e-12 * Math.abs(v)) || b.hi.some(v => v !== b.hi[0]));
    D.histories
      .map(historyPlot)
      .filter(p => p)
      .map((p, j) => [p, moves(p) ? j : 1e6 + j])
      .sort((a, b) => a[1] - b[1])
      .forEach(p => cursors.push(timePlot(element(160), p[0]))); // constant ones last
  }
  if (R.length && nRun > 1) {
    const target = element(236);
    target.parentNode.className = 'plain';
    distribution(target, i, D.ensemble ? caseOf(k) : -1);
    if (kept) box.after(target.parentNode);
  }
  seek(at);
}

function pick(k, isFromTable) {
  if (k < 0 || k >= nRun || !R.length) return;
  picked = k;
  ring(
    'ring',
    shown.marks.find(m => m[2] === picked || (shown.isCells && caseOf(m[2]) === caseOf(picked))),
  );
  buildSide();
  document.querySelectorAll('#table tr.picked').forEach(r => r.classList.remove('picked'));
  const row = document.querySelector(`#table tr[data-run="${$('rows').value === 'cases' ? caseOf(k) * D.members : k}"]`);
  if (row) row.classList.add('picked');
  if (row && !isFromTable) $('table').scrollTop = row.offsetTop - $('table').clientHeight / 2;
}

// The table: columns {h: heading, of: number or text of a run, words: left-aligned}; sorted by one of them
let by = 0,
  down = false;
function columnsOf() {
  const isCases = $('rows').value === 'cases',
    asked = [$('y').value, $('x').value, $('c').value].filter(s => s[0] === 'r').map(s => +s.slice(1));
  const list = R.map((_, i) => i).filter(i => $('all').checked || asked.includes(i) || R[i].drawn || (!R.some(r => r.drawn) && i < 8));
  const columns = [{h: 'case', of: k => caseOf(k) + 1}];
  if (D.ensemble && !isCases) columns.push({h: 'run', of: k => (k % D.members) + 1});
  P.forEach((p, i) => columns.push({h: p.n, of: quantity('p' + i).of, show: k => p.texts[p.at[caseOf(k)]], words: p.words}));
  const done = k => {
    let n = 0;
    for (let j = k; j < k + D.members && j < nRun; j++) n += exit[j] === 0;
    return n;
  };
  columns.push(isCases ? {h: 'runs done', of: done} : {h: 'status', of: k => exit[k], show: stateOf, words: true});
  list.forEach(i => {
    const q = quantity('r' + i),
      h = q.n + (q.u ? ' [' + q.u + ']' : '');
    if (isCases) columns.push({h: h + ' mean', of: k => meanOf(i, caseOf(k))}, {h: 'deviation', of: k => spread(i, caseOf(k), 1)});
    else columns.push({h, of: q.of});
  });
  return columns;
}
const most = 300; // rows that are shown at first
function buildTable(n) {
  const columns = columnsOf(),
    isCases = $('rows').value === 'cases',
    runs = isCases ? Array.from({length: nCase}, (_, m) => m * D.members) : [...Array(nRun).keys()];
  by = Math.min(by, columns.length - 1);
  const value = columns[by].of,
    order = (a, b) => (a !== a) - (b !== b) || (a - b) * (down ? -1 : 1);
  const keyed = runs
    .map(k => [value(k), k])
    .sort((a, b) => order(a[0], b[0]) || a[1] - b[1])
    .slice(0, n || most);
  const cell = (c, k) => {
    if (c.show) return safe(c.show(k));
    const v = c.of(k);
    return v === v ? tidy(v) : '';
  };
  $('table').innerHTML =
    '<table><thead><tr>' +
    columns
      .map(
        (c, i) =>
          `<th scope="col"${c.words ? ' class="text"' : ''}${i === by ? ` aria-sort="${down ? 'descending' : 'ascending'}"` : ''}><button data-column="${i}">` +
          safe(c.h) +
          (i === by ? (down ? ' \u25bc' : ' \u25b2') : '') +
          '</button></th>',
      )
      .join('') +
    '</tr></thead><tbody>' +
    keyed
      .map(
        ([, k]) =>
          `<tr data-run="${k}" class="${exit[k] > 0 && !isCases ? 'bad' : ''}${(isCases ? caseOf(k) === caseOf(picked) : k === picked) ? ' picked' : ''}">` +
          columns.map(c => `<td${c.words ? ' class="text"' : ''}>${cell(c, k)}</td>`).join('') +
          '</tr>',
      )
      .join('') +
    '</tbody></table>';
  $('count').innerHTML = keyed.length < runs.length ? `first ${keyed.length} of ${runs.length} rows <button id="more">show all</button>` : '';
  if ($('more')) $('more').onclick = () => buildTable(runs.length);
}

function start() {
  const option = (id, name, value) => $(id).add(new Option(name, value));
  const byName = R.map((r, i) => [r, i]).sort((a, b) => b[0].drawn - a[0].drawn || a[1] - b[1]);
  byName.forEach(([r, i]) => option('y', r.n, 'r' + i));
  samples.list.forEach((s, i) => option('y', s.n + ', Poincar\u00e9 samples', 's' + i));
  if (P.length > 1) P.forEach((p, i) => option('y', p.n, 'p' + i));
  P.forEach((p, i) => option('x', p.n, 'p' + i));
  option('x', 'number of the run', 'n');
  byName.forEach(([r, i]) => option('x', r.n, 'r' + i));
  option('c', 'none', '-');
  P.forEach((p, i) => option('c', p.n, 'p' + i));
  byName.forEach(([r, i]) => option('c', r.n, 'r' + i));
  if (P.length > 1 && D.together < P.length) $('c').value = 'p' + (D.together > 1 ? D.together : 1);
  if (P.length === 2 && D.together < 2 && P[1].texts.length > 8) $('y').value = 'p1';
  option('rows', 'table of the runs', 'runs');
  if (D.ensemble) option('rows', 'table of the cases', 'cases');
  $('rows').hidden = !D.ensemble;
  $('for-all').hidden = R.length <= 8 && !R.some(r => r.drawn);
  const redraw = () => {
    // a map shows a result
    if ([$('x'), $('y')].every(s => s.value[0] === 'p') && $('c').value[0] !== 'r') $('c').value = 'r' + firstDrawn;
    drawChart();
    buildSide();
  };
  ['x', 'y', 'c'].forEach(id => {
    $(id).onchange = () => {
      $('tip').hidden = true;
      redraw();
      buildTable();
    };
  });
  $('rows').onchange = $('all').onchange = () => buildTable();
  $('table').onclick = e => {
    const head = e.target.closest('button[data-column]'),
      row = e.target.closest('tr[data-run]');
    if (head) {
      down = +head.dataset.column === by && !down;
      by = +head.dataset.column;
      buildTable();
    }
    if (row) pick(+row.dataset.run, true);
  };
  svg.onpointermove = hover;
  svg.onpointerleave = () => {
    $('tip').hidden = true;
    ring('near', null);
  };
  svg.onclick = e => {
    // of points that lie on each other the next one
    const m = nearest(e),
      here = m ? shown.marks.filter(o => Math.hypot(o[0] - m[0], o[1] - m[1]) < 3).map(o => o[2]) : [];
    if (m) pick(here.includes(picked) ? here[(here.indexOf(picked) + 1) % here.length] : m[2]);
  };
  document.onkeydown = e => {
    if (/SELECT|INPUT/.test(e.target.tagName)) return;
    if (e.key === 'ArrowRight') pick(picked + 1);
    if (e.key === 'ArrowLeft') pick(picked - 1);
  };
  buildTable();
  document.querySelector('nav').hidden = document.querySelector('main').hidden = !R.length;
  if (R.length) {
    redraw();
    let width = $('chart').clientWidth;
    new ResizeObserver(() => {
      if (width !== $('chart').clientWidth) {
        width = $('chart').clientWidth;
        drawChart();
      }
    }).observe($('chart'));
  }
  $('legend').textContent =
    (D.ensemble ? 'Distribution: green line the mean of a case, above it its 95 % interval (dark) and the standard deviation (light). ' : '') +
    (D.histories.length
      ? 'Histories: ' +
        (D.ensemble
          ? 'blue the run, red the mean of its case with the standard deviation, grey from minimum to maximum of its runs'
          : 'minimum and maximum in each of 200 parts of the time') +
        '; drag to read values. '
      : '') +
    'Click a point or a row to pick a run; arrow keys: previous and next run. Numbers have five digits; all are in sweep.csv' +
    (D.ensemble ? ' and cases.csv' : '') +
    '. ' +
    D.note;
}
start();
