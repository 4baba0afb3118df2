// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Bezier triangles of any degree n, in doubles: values, derivatives, singular values.
//
// Control points of a cell are ordered by multi-index (i, j, k), i + j + k = n, where i belongs to
// corner 0: i falls first, then j. Barycentric coordinates xi = [a, b, c] belong to the corners.

export const cellSize = (n) => ((n + 1) * (n + 2)) / 2;

// Returns the place of (i, j, k) in this order.
export function localIndex(n, i, j) {
  const row = n - i;
  return (row * (row + 1)) / 2 + (row - j);
}

export function multiIndices(n) {
  const indices = [];
  for (let i = n; i >= 0; --i) for (let j = n - i; j >= 0; --j) indices.push([i, j, n - i - j]);
  return indices;
}

// Returns n! / (i! j! k!).
export function multinomial(i, j, k) {
  let value = 1;
  for (let s = 1; s <= j; ++s) value *= (i + s) / s;
  for (let s = 1; s <= k; ++s) value *= (i + j + s) / s;
  return Math.round(value);
}

// Does all but the last step of de Casteljau's algorithm. Returns the values q[a] = [u, v] of the
// three polynomials of degree n - 1 that start at the multi-indices e_a. The map is the sum of xi_a
// q[a], its derivative by xi_a is n q[a]. uv: pairs, by local index.
export function lastTriangle(n, uv, [a, b, c]) {
  let points = Float64Array.from(uv);
  for (let degree = n - 1; degree >= 1; --degree) {
    const next = new Float64Array(2 * cellSize(degree));
    let to = 0;
    for (const [i, j] of multiIndices(degree)) {
      const at0 = 2 * localIndex(degree + 1, i + 1, j);
      const at1 = 2 * localIndex(degree + 1, i, j + 1);
      const at2 = 2 * localIndex(degree + 1, i, j);
      for (let d = 0; d < 2; ++d)
        next[to++] = a * points[at0 + d] + b * points[at1 + d] + c * points[at2 + d];
    }
    points = next;
  }
  return [[points[0], points[1]], [points[2], points[3]], [points[4], points[5]]];
}

export const combine = (q, [a, b, c]) =>
    [0, 1].map((d) => a * q[0][d] + b * q[1][d] + c * q[2][d]);

// Returns the inverse of the matrix with columns p0 - p2 and p1 - p2, in an orthonormal frame of
// the triangle whose first axis is along p0 - p2: [a, b, c, d] by rows. Not finite without area.
export function restInverse(p0, p1, p2) {
  const minus = (p, q) => [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
  const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
  const [e, f] = [minus(p0, p2), minus(p1, p2)];
  const cross = [e[1] * f[2] - e[2] * f[1], e[2] * f[0] - e[0] * f[2], e[0] * f[1] - e[1] * f[0]];
  const length = Math.hypot(...e);
  const x = dot(e, f) / length;
  const y = Math.hypot(...cross) / length;
  return [1 / length, -x / (length * y), 0, 1 / y];
}

// Returns singular values, signed, first >= |second|, of the Jacobian D rest: D has the columns n
// (q0 - q2), n (q1 - q2).
export function singularValues(n, q, rest, scale) {
  const d = (k, c) => scale * n * (q[k][c] - q[2][c]);
  const J = [0, 1].map((c) => [
    d(0, c) * rest[0] + d(1, c) * rest[2],
    d(0, c) * rest[1] + d(1, c) * rest[3],
  ]);
  const alpha = 0.5 * Math.hypot(J[0][0] + J[1][1], J[1][0] - J[0][1]);
  const beta = 0.5 * Math.hypot(J[0][0] - J[1][1], J[1][0] + J[0][1]);
  return [alpha + beta, alpha - beta];
}

// Returns barycentric coordinates where a cell of the map takes the value uv, or null, by Newton's
// method from several places. `inside`: the tolerance outside of the cell.
export function locate(n, control, uv, inside = 1e-9) {
  for (const start of [[1 / 3, 1 / 3], [0.6, 0.2], [0.2, 0.6], [0.2, 0.2]]) {
    let [a, b] = start;
    for (let step = 0; step < 30; ++step) {
      const q = lastTriangle(n, control, [a, b, 1 - a - b]);
      const value = combine(q, [a, b, 1 - a - b]);
      const [x, y] = [uv[0] - value[0], uv[1] - value[1]];
      const m = [0, 1].map((c) => [n * (q[0][c] - q[2][c]), n * (q[1][c] - q[2][c])]);
      const det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
      const da = (x * m[1][1] - y * m[0][1]) / det;
      const db = (y * m[0][0] - x * m[1][0]) / det;
      if (!Number.isFinite(da + db)) break;
      a += da;
      b += db;
      if (Math.abs(a) + Math.abs(b) > 8) break;
      if (Math.abs(da) + Math.abs(db) < 1e-13) break;
    }
    const c = 1 - a - b;
    if (Math.min(a, b, c) < -inside || !Number.isFinite(c)) continue;
    const found = combine(lastTriangle(n, control, [a, b, c]), [a, b, c]);
    const size = Math.abs(control[0] - control[2]) + Math.abs(control[1] - control[3]) + 1e-300;
    if (Math.hypot(found[0] - uv[0], found[1] - uv[1]) < 1e-6 * size) return [a, b, c];
  }
  return null;
}
