// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

import assert from 'node:assert/strict';
import test from 'node:test';

import {
  cellSize, combine, lastTriangle, localIndex, locate, multiIndices, multinomial, restInverse,
  singularValues,
} from '../src/map_page/bezier.js';

const corners = [[0, 0], [1, 0], [0, 1]];
const random = (() => {
  let state = 7;
  return () => (state = (state * 16807) % 2147483647) / 2147483647;
})();

const bernstein = (n, [i, j, k], [a, b, c]) => multinomial(i, j, k) * a ** i * b ** j * c ** k;

test('the order of control points', () => {
  for (let n = 1; n <= 8; ++n) {
    const indices = multiIndices(n);
    assert.equal(indices.length, cellSize(n));
    indices.forEach(([i, j, k], at) => {
      assert.equal(i + j + k, n);
      assert.equal(localIndex(n, i, j), at);
    });
  }
  assert.deepEqual(multiIndices(2)[0], [2, 0, 0]);
  assert.equal(multinomial(2, 3, 1), 60);
});

test('values and derivatives are those of the Bernstein sum', () => {
  for (let n = 1; n <= 8; ++n) {
    const uv = Float64Array.from({length: 2 * cellSize(n)}, () => 2 * random() - 1);
    const value = (xi) => [0, 1].map((d) => multiIndices(n).reduce(
        (sum, index, l) => sum + bernstein(n, index, xi) * uv[2 * l + d], 0));
    const xi = [0.2, 0.3, 0.5];
    const q = lastTriangle(n, uv, xi);
    value(xi).forEach((x, d) => assert.ok(Math.abs(combine(q, xi)[d] - x) < 1e-14));
    const h = 1e-6;
    const [more, less] = [value([0.2 + h, 0.3, 0.5 - h]), value([0.2 - h, 0.3, 0.5 + h])];
    for (const d of [0, 1]) {
      const slope = (more[d] - less[d]) / (2 * h);
      assert.ok(Math.abs(n * (q[0][d] - q[2][d]) - slope) < 1e-7, `degree ${n}`);
    }
  }
});

test('singular values of affine maps', () => {
  const place = (p) => [2 + 0.6 * p[0] - 0.8 * p[1], 1 + 0.8 * p[0] + 0.6 * p[1], 3];
  const rest = restInverse(...corners.map(place));
  const check = (matrix, expected) => {
    const uv = corners.flatMap(([x, y]) => [matrix[0] * x + matrix[1] * y,
                                            matrix[2] * x + matrix[3] * y]);
    // corners of degree 1 are in the order (1,0,0), (0,1,0), (0,0,1)
    const q = lastTriangle(1, uv, [0.1, 0.2, 0.7]);
    singularValues(1, q, rest, 1).forEach((x, k) => assert.ok(Math.abs(x - expected[k]) < 1e-14));
  };
  check([1, 0, 0, 1], [1, 1]);
  check([3, 0, 0, 0.5], [3, 0.5]);
  check([0, -3, 0.5, 0], [3, 0.5]);
  check([2, 0, 0, -1], [2, -1]);  // an inverted cell
});

test('a value is found where it is taken', () => {
  for (let n = 1; n <= 8; ++n) {
    const uv = multiIndices(n).flatMap(
        ([i, j]) => [i / n + 0.05 * (random() - 0.5) / n, j / n + 0.05 * (random() - 0.5) / n]);
    for (let k = 0; k < 20; ++k) {
      const [a, b] = [random(), random()].sort((x, y) => x - y);
      const xi = [a, b - a, 1 - b];
      const found = locate(n, uv, combine(lastTriangle(n, uv, xi), xi));
      found.forEach((x, c) => assert.ok(Math.abs(x - xi[c]) < 1e-9, `degree ${n}`));
    }
    assert.equal(locate(n, uv, [1.2, 1.2]), null);
  }
});
