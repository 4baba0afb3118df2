// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

import assert from 'node:assert/strict';
import {test} from 'node:test';

import {combine, lastTriangle} from '../src/map_page/bezier.js';
import {Chords, bendsOf, piecesFor} from '../src/map_page/chords.js';

// One quadratic cell: the straight unit triangle with moved edge midpoints.
const cell = (...moved) => {
  const uv = [1, 0, 0.5, 0.5, 0.5, 0, 0, 1, 0, 0.5, 0, 0];
  [1, 2, 4].forEach((l, edge) => { uv[2 * l] += moved[edge]; });
  return {degree: 2, size: 6, faceCount: 1, cells: Uint32Array.from([0, 1, 2, 3, 4, 5]),
          uv: Float64Array.from(uv)};
};

test('bends are what quadratic cells are off by', () => {
  for (const plane of [cell(0.3, 0.3, 0.3), cell(0.2, 0, 0), cell(-0.1, 0.2, 0.05)]) {
    let most = 0;
    const steps = 60;
    for (let i = 0; i <= steps; ++i)
      for (let j = 0; i + j <= steps; ++j) {
        const xi = [i / steps, j / steps, 1 - (i + j) / steps];
        const [u, v] = combine(lastTriangle(2, plane.uv, xi), xi);
        most = Math.max(most, Math.hypot(u - xi[0], v - xi[1]));
      }
    const [bend] = bendsOf(plane, plane.uv);
    assert.ok(most <= bend * (1 + 1e-9), `${most} ${bend}`);
    assert.ok(most > 0.5 * bend, `${most} ${bend}`);
  }
  assert.equal(bendsOf(cell(0, 0, 0), cell(0, 0, 0).uv)[0], 0);
});

test('pieces are as many as bends ask for, and not too many', () => {
  assert.deepEqual([...piecesFor([0, 0.4, 0.6, 3, 100]).pieces], [1, 1, 2, 4, 16]);
  assert.equal(piecesFor([100]).areCoarse, false);
  assert.equal(piecesFor([1000]).areCoarse, true);
  const many = piecesFor(new Float64Array(20000).fill(100));
  assert.ok(many.areCoarse);
  assert.ok(many.pieces.reduce((sum, k) => sum + k * k, 0) <= 1e6);
});

// Two cells have the same vertices on their common edge.
test('the coarser of two cells decides on their edge', () => {
  const curved = cell(0.3, 0, 0);
  const plane = {
    degree: 2, size: 6, faceCount: 2, cornerCount: 4,
    // The second cell is across edge 12 of the first, which is straight.
    cells: Uint32Array.from([0, 4, 5, 1, 6, 2, 2, 6, 7, 1, 8, 3]),
  };
  const uv = new Float64Array(18);
  [[0, 0], [4, 1], [5, 2], [1, 3], [6, 4], [2, 5]].forEach(([point, l]) => {
    uv.set(curved.uv.subarray(2 * l, 2 * l + 2), 2 * point);
  });
  uv.set([-1, 0], 6);
  uv.set([-0.5, 0], 14);
  uv.set([-0.5, 0.5], 16);
  const {pieces, edges} = new Chords(plane).of(uv, 256);
  assert.equal(pieces[0], 16);
  assert.equal(pieces[1], 1);
  assert.deepEqual([...edges], [16, 1, 16, 1, 1, 1]);
});
