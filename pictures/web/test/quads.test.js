// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Tests quads as two halves each: their corners, shapes and colours.

import assert from 'node:assert/strict';
import test from 'node:test';

import {measureQuads, quadCorners, shapeOfQuad} from '../src/map_page/quads.js';

// A square and a parallelogram of 60 degrees beside it: corners 0 1 2 3 and 1 4 5 2.
const rise = Math.sqrt(0.75);
const map = {
  degree: 1, size: 3, faceCount: 4, cells: Uint32Array.of(0, 1, 2, 0, 2, 3, 1, 4, 5, 1, 5, 2),
  positions: Float64Array.of(0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 1 + rise, 0.5, 0, 1 + rise, 1.5, 0),
};

test('halves have the corners of their quad', () => {
  for (const face of [0, 1]) assert.deepEqual(quadCorners(map, face), [0, 1, 2, 3]);
  for (const face of [2, 3]) assert.deepEqual(quadCorners(map, face), [1, 4, 5, 2]);
});

test('angles and scaled Jacobians are those of quads', () => {
  const [square, slanted] = measureQuads(map);
  assert.ok(square.deviation < 1e-9 && Math.abs(square.jacobian - 1) < 1e-12);
  assert.ok(Math.abs(slanted.deviation - 30) < 1e-9);
  assert.ok(Math.abs(slanted.jacobian - rise) < 1e-12);
});

test('a folded quad has a negative Jacobian', () => {
  assert.ok(shapeOfQuad([[0, 0, 0], [1, 0, 0], [0.2, 0.2, 0], [0, 1, 0]]).jacobian < 0);
});
