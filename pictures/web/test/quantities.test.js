// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

import assert from 'node:assert/strict';
import test from 'node:test';

import {densityAt, energyNames, parseEnergy} from '../src/map_page/energies.js';
import {readable} from '../src/map_page/numbers.js';
import {evenPlaces, sampleSingularValues} from '../src/map_page/sampling.js';
import {Scale} from '../src/map_page/scales.js';
import {meet} from '../src/map_page/ray.js';

const near = (a, b, tolerance = 1e-12) =>
    assert.ok(Math.abs(a - b) <= tolerance * Math.max(1, Math.abs(b)), `${a} is not ${b}`);

// Values computed by hand at singular values 2 and 1/2, and at an isometry.
const known = {
  'symmetric-dirichlet': [8.5, 4], 'asap': [2.25, 0], 'mips': [4.25, 2], 'arap': [1.25, 0],
  'symmetric-arap': [2.5, 0], 'log-isometric': [2 * Math.log(2) ** 2, 0], 'authalic': [2, 2],
  'amips-exponential': [Math.exp(5 * (6.25 / 4 - 1)), 1],
};

test('densities', () => {
  assert.deepEqual(energyNames.sort(), Object.keys(known).sort());
  for (const [name, [stretched, isometric]] of Object.entries(known)) {
    near(densityAt(parseEnergy(name), 2, 0.5), stretched);
    near(densityAt(parseEnergy(name), 1, 1), isometric);
  }
  assert.equal(densityAt(parseEnergy('mips'), 1, -1), Infinity);
  near(densityAt(parseEnergy('asap'), 1, -1), 4);
});

test('sums of energies', () => {
  near(densityAt(parseEnergy('mips + 1e+1*asap'), 2, 0.5), 4.25 + 22.5);
  near(densityAt(parseEnergy(' 0.5 * arap+mips '), 2, 0.5), 0.625 + 4.25);
  for (const wrong of ['', undefined, 'mips +', '-1*mips', 'dirichlet', 'x*mips'])
    assert.equal(parseEnergy(wrong), null);
});

const colors = btoa(String.fromCharCode(...Array.from({length: 768}, (_, k) => k % 256)));

test('positions on scales', () => {
  const area = new Scale({diverging: true, low: 1 / 8, neutral: 1, high: 8, unit: 1, colors});
  near(area.position(1), 0.5);
  near(area.position(2), 2 / 3);
  near(area.position(0.25), 1 / 6);
  assert.equal(area.position(100), 1);
  assert.equal(area.position(-1), 0);
  const density = new Scale({diverging: false, low: 4, neutral: 4, high: 40, unit: 2.25, colors});
  assert.equal(density.position(4), 0);
  near(density.position(4 + 2.25 * (Math.sqrt(17) - 1)), 0.5);
  for (const scale of [area, density])
    for (const t of [0, 0.2, 0.5, 0.9, 1]) near(scale.position(scale.value(t)), t);
});

test('samples stand for equal areas', () => {
  for (const k of [1, 2, 3, 5]) {
    const places = evenPlaces(k);
    assert.equal(places.length, k * k);
    for (const c of [0, 1, 2]) near(places.reduce((sum, xi) => sum + xi[c], 0) / (k * k), 1 / 3);
  }
  // The unit right triangle as the identity of degree 2, scaled by 3.
  const uv = Float64Array.from([1, 0, 0.5, 0.5, 0.5, 0, 0, 1, 0, 0.5, 0, 0]);
  const map = {degree: 2, size: 6, faceCount: 1, cells: Uint32Array.from([0, 1, 2, 3, 4, 5]),
               rest: Float64Array.from([1, 0, 0, 1]), scale: 3};
  const {S, s} = sampleSingularValues(map, uv, evenPlaces(3));
  for (const x of [...S, ...s]) near(x, 3);
});

test('rays and triangles', () => {
  const triangle = [[0, 0, 2], [1, 0, 2], [0, 1, 2]];
  const found = meet([0.2, 0.3, 0], [0, 0, 1], ...triangle);
  [2, 0.2, 0.3].forEach((x, k) => near(found[k], x));
  assert.equal(meet([0.8, 0.3, 0], [0, 0, 1], ...triangle), null);
  assert.equal(meet([0.2, 0.3, 0], [1, 0, 0], ...triangle), null);
});

test('numbers for people', () => {
  assert.equal(readable(10000), '10,000');
  assert.equal(readable(0.123456789), '0.12346');
  assert.equal(readable(1e-9), '1e-9');
  assert.equal(readable(1.23456789e12), '1.2346e12');
  assert.equal(readable(null), '\u2013');
  assert.equal(readable(-Infinity), '-\u221e');
});
