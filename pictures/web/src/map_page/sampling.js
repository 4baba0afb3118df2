// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Samples singular values at evenly spaced places of all faces, for histograms and for pictures
// without WebGL.

import {cellSize, lastTriangle, multiIndices} from './bezier.js';

// Returns the middles of the k * k triangles into which a triangle is divided; each represents the
// same area.
export function evenPlaces(k) {
  const places = [];
  const add = (i, j) => places.push([i / (3 * k), j / (3 * k), (3 * k - i - j) / (3 * k)]);
  for (let i = 0; i < k; ++i)
    for (let j = 0; j < k - i; ++j) {
      add(3 * i + 1, 3 * j + 1);
      if (i + j < k - 1) add(3 * i + 2, 3 * j + 2);
    }
  return places;
}

// Returns the sample places of reports for extremes of a map of that degree: (i, j, k) / 8, or the
// middle if the map is affine.
export function extremePlaces(degree) {
  if (degree === 1) return [[1 / 3, 1 / 3, 1 / 3]];
  return multiIndices(8).map((index) => index.map((x) => x / 8));
}

// Returns coefficients of n (q0 - q2) and n (q1 - q2) at a place, by local index.
function derivativeWeights(n, xi) {
  const size = cellSize(n);
  const weights = [new Float64Array(size), new Float64Array(size)];
  for (let l = 0; l < size; ++l) {
    const unit = new Float64Array(2 * size);
    unit[2 * l] = 1;
    const q = lastTriangle(n, unit, xi);
    weights[0][l] = n * (q[0][0] - q[2][0]);
    weights[1][l] = n * (q[1][0] - q[2][0]);
  }
  return weights;
}

// Returns {S, s}: #faces * #places signed singular values, face by face, times the scale of the
// layout.
export function sampleSingularValues(map, uv, places) {
  const {degree, size, faceCount, cells, rest, scale} = map;
  const weights = places.map((xi) => derivativeWeights(degree, xi));
  const S = new Float64Array(faceCount * places.length);
  const s = new Float64Array(faceCount * places.length);
  let at = 0;
  for (let face = 0; face < faceCount; ++face) {
    const ra = rest[4 * face], rb = rest[4 * face + 1], rc = rest[4 * face + 2],
          rd = rest[4 * face + 3];
    for (const [we, wf] of weights) {
      let eu = 0, ev = 0, fu = 0, fv = 0;
      for (let l = 0; l < size; ++l) {
        const point = 2 * cells[face * size + l];
        eu += we[l] * uv[point];
        ev += we[l] * uv[point + 1];
        fu += wf[l] * uv[point];
        fv += wf[l] * uv[point + 1];
      }
      const a = eu * ra + fu * rc, b = eu * rb + fu * rd;
      const c = ev * ra + fv * rc, d = ev * rb + fv * rd;
      const alpha = 0.5 * scale * Math.hypot(a + d, c - b);
      const beta = 0.5 * scale * Math.hypot(a - d, c + b);
      S[at] = alpha + beta;
      s[at] = alpha - beta;
      ++at;
    }
  }
  return {S, s, perFace: places.length};
}
