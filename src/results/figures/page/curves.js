// Curves over time with a cursor that moves along, as all pages draw them. The page gives the window (`first`, `last`), the elements' place
// (`side`), the time of the cursor (`at`, `timeAt`) and what moves it (`seek`).
const strokes = ['#1f6fb4', '#d1495b', '#2e8b57', '#c98a00', '#7b4fa3', '#17a2b8'];
const text = (x, y, s, anchor, colour) =>
  `<text x="${x}" y="${y}" font-size="12" text-anchor="${anchor || 'start'}" fill="${colour || '#333'}">${s}</text>`;
const safe = s => s.replace(/[<>&"]/g, c => `&#${c.charCodeAt(0)};`);
const short = x => +x.toPrecision(4);
const points = list => list.map(p => p[0].toFixed(2) + ',' + p[1].toFixed(2)).join(' ');
const X = t => 62 + 346 * (t - first) / (last - first);

function element(height) {
  const svg = document.createElementNS('http://www.w3.org/2000/svg', 'svg');
  svg.setAttribute('viewBox', `0 0 420 ${height}`);
  const box = document.createElement('div');
  box.append(svg);
  side.append(box);
  return svg;
}

// A plot over time: {title, unit, curves: [{n, x, y}], bands: [{x, lo, hi, width, colour, opacity}]}; a band with a width has steps as wide,
// a hidden curve is a number of the cursor only. Returns what moves its cursor, and its numbers if all is to be shown: the cursor
// is an element of its own, so that the curves are not drawn again as it moves.
function timePlot(svg, plot) {
  let lo = Infinity, hi = -Infinity;
  const widen = (x, y) => y.forEach((v, k) => {
    if (v === v && x[k] >= first && x[k] <= last) { lo = Math.min(lo, v); hi = Math.max(hi, v); }
  });
  plot.curves.forEach(c => { if (!c.isHidden) widen(c.x, c.y); });
  (plot.bands || []).forEach(b => { widen(b.x, b.lo); widen(b.x, b.hi); });
  if (!(lo <= hi)) { lo = 0; hi = 1; }
  const least = 1e-4 * Math.max(Math.abs(lo), Math.abs(hi)), isFlat = !(hi - lo > least);   // less would be round-off of what is written
  const pad = isFlat ? least || 1 : 0.06 * (hi - lo), rows = Math.ceil(plot.curves.length / 2), top = 22 + 16 * rows, bottom = top + 120;
  const Y = v => bottom - 120 * (v - lo + pad) / (hi - lo + 2 * pad);
  svg.setAttribute('viewBox', `0 0 420 ${bottom + 24}`);
  const label = v => Math.abs(v) < 1e-6 * (hi - lo) ? '0' : short(v);
  const heading = plot.title.length > 46 ? plot.title.slice(0, 45) + '\u2026' : plot.title;
  const lines = plot.curves.map((c, i) => {
    if (c.isHidden) return '';
    const pieces = [[]];
    c.y.forEach((v, k) => {
      if (v !== v) pieces.push([]);
      else if (c.x[k] >= first && c.x[k] <= last) pieces[pieces.length - 1].push([X(c.x[k]), Y(v)]);
    });
    return pieces.map(p => `<polyline points="${points(p)}" fill="none" stroke="${strokes[i % strokes.length]}" stroke-width="1.3"/>`).join('');
  });
  const bands = (plot.bands || []).map(b => {
    const side = y => [...b.x].flatMap((t, k) => y[k] !== y[k] ? [] : b.width ? [[X(t), Y(y[k])], [X(t + b.width), Y(y[k])]] : [[X(t), Y(y[k])]]);
    return `<polygon points="${points(side(b.hi).concat(side(b.lo).reverse()))}" fill="${b.colour}" opacity="${b.opacity}" stroke="${b.colour}" stroke-width=".5"/>`;
  }).join('');
  svg.innerHTML = text(6, 15, safe(heading + (plot.unit ? ' [' + plot.unit + ']' : ''))) +
    (lo < 0 && hi > 0 ? `<path d="M62 ${Y(0)}H408" stroke="#ddd"/>` : '') + bands + lines.join('') +
    `<path d="M62 ${top}V${bottom}H408" stroke="#404040" fill="none"/>` + text(58, Y(hi) + 4, label(hi), 'end') + (isFlat ? '' : text(58, Y(lo) + 4, label(lo), 'end')) +
    text(62, bottom + 16, unit(first, 's')) + text(408, bottom + 16, unit(last, 's'), 'end') +
    plot.curves.map((c, i) => `<text class="value" x="${10 + 205 * (i % 2)}" y="${31 + 16 * Math.floor(i / 2)}" font-size="12" fill="${strokes[i % strokes.length]}"></text>`).join('');
  const cursor = document.createElement('i'), values = svg.querySelectorAll('.value');
  cursor.style.top = 100 * top / (bottom + 24) + '%';
  cursor.style.height = 100 * 120 / (bottom + 24) + '%';
  svg.parentNode.append(cursor);
  svg.onpointerdown = svg.onpointermove = e => {
    if (e.type === 'pointermove' && !(e.buttons & 1)) return;
    const box = svg.getBoundingClientRect(), t = first + (last - first) * ((e.clientX - box.left) / box.width * 420 - 62) / 346;
    seek(t);
  };
  return all => {
    const now = timeAt(at);
    cursor.style.transform = `translateX(${X(now) / 4.2}%)`;
    if (all) plot.curves.forEach((c, i) => { values[i].textContent = c.n + ' ' + label(valueAt(c, now)); });
  };
}

// A curve's value at a time, linear between its points
function valueAt(c, t) {
  const [k, w] = placeOf(c.x, t);
  return w > 0 ? c.y[k] * (1 - w) + c.y[k + 1] * w : c.y[k];
}
