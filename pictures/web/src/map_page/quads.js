// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Pages of quad meshes: faces 2 q and 2 q + 1 are the halves a b c and a c d of quad a b c d, whose
// number is that of the output.

import {cornersOf, positionOf} from './map_data.js';
import {Scale} from './scales.js';

const kMostDegrees = 45;  // end of the scale

// Returns corners a, b, c, d of the quad that contains a half.
export function quadCorners(map, face) {
  const first = face - (face % 2);
  return [...cornersOf(map, first), cornersOf(map, first + 1)[2]];
}

const minus = (p, q) => [p[0] - q[0], p[1] - q[1], p[2] - q[2]];
const dot = (p, q) => p[0] * q[0] + p[1] * q[1] + p[2] * q[2];
const cross = (p, q) =>
    [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]];

// Returns for four points the largest |angle - 90| of a corner in degrees, and the scaled Jacobian,
// the least sine of a corner relative to the normal (c - a) x (d - b).
export function shapeOfQuad(points) {
  const n = cross(minus(points[2], points[0]), minus(points[3], points[1]));
  let deviation = 0, jacobian = Infinity;
  points.forEach((p, k) => {
    const on = minus(points[(k + 1) % 4], p), back = minus(points[(k + 3) % 4], p);
    const area = cross(on, back);
    const angle = Math.atan2(Math.hypot(...area), dot(on, back)) * 180 / Math.PI;
    deviation = Math.max(deviation, Math.abs(angle - 90));
    jacobian = Math.min(
        jacobian, dot(area, n) / (Math.hypot(...on) * Math.hypot(...back) * Math.hypot(...n)));
  });
  return {deviation, jacobian};
}

// Returns {deviation, jacobian} of every quad.
export const measureQuads = (map) => Array.from(
    {length: map.faceCount / 2},
    (_, quad) => shapeOfQuad(quadCorners(map, 2 * quad).map((c) => positionOf(map, c))));

// like: the scale whose colours are used.
export const deviationScale = (like) => new Scale({
  ...like, name: 'deviation', label: 'degrees', diverging: false, low: 0, neutral: 0,
  high: kMostDegrees, unit: kMostDegrees,
}).withRange(0, kMostDegrees);
