// What all pages need: elements, arrays in base 64, little-endian, places in a list, numbers that read well.
'use strict';
const $ = id => document.getElementById(id);
const bytes = s => Uint8Array.from(atob(s), c => c.charCodeAt(0)).buffer;
const f32 = s => new Float32Array(bytes(s)), f64 = s => new Float64Array(bytes(s)), i32 = s => new Int32Array(bytes(s));

// Where a time is among increasing ones: the last that is not later, and the part of the way to the next
function placeOf(x, t) {
  let a = 0, b = x.length - 1;
  while (b - a > 1) { const m = (a + b) >> 1; if (x[m] <= t) a = m; else b = m; }
  return [a, b > a && x[b] > x[a] ? Math.min(1, Math.max(0, (t - x[a]) / (x[b] - x[a]))) : 0];
}

// A number with a prefix that makes it short
function unit(x, u) {
  const a = Math.abs(x);
  const [n, f] = a >= 1e6 ? ['M', 1e-6] : a >= 1e4 ? ['k', 1e-3] : a >= 1 || a === 0 ? ['', 1] : a >= 1e-3 ? ['m', 1e3]
    : a >= 1e-6 ? ['\u00b5', 1e6] : ['n', 1e9];
  return +(x * f).toPrecision(4) + ' ' + n + u;
}
