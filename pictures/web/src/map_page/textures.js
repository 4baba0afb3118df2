// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Makes the textures that the programs of shaders.js fetch from arrays of the map.

import {
  ClampToEdgeWrapping, DataTexture, FloatType, LinearFilter, NearestFilter, RGBAFormat, RGFormat,
  UnsignedByteType,
} from 'three';

import {cornerLocals, cornersOf} from './map_data.js';
import {surfaceNames} from './neighbours.js';

export const kTextureWidth = 2048;  // texel i is at (i % width, i / width)

// components: 2 or 4 a texel.
function floatTexture(texels, components) {
  const height = Math.max(1, Math.ceil(texels / kTextureWidth));
  const data = new Float32Array(components * kTextureWidth * height);
  const format = components === 2 ? RGFormat : RGBAFormat;
  const texture = new DataTexture(data, kTextureWidth, height, format, FloatType);
  texture.needsUpdate = true;
  return texture;
}

// Returns (uv - center) / size of every control point of every cell.
export function controlTexture(plane, bounds) {
  const texture = floatTexture(plane.faceCount * plane.size, 2);
  fillControl(texture, plane, bounds, plane.uv);
  return texture;
}

export function fillControl(texture, plane, {center, size}, uv) {
  const {data} = texture.image;
  plane.cells.forEach((point, at) => {
    data[2 * at] = (uv[2 * point] - center[0]) / size;
    data[2 * at + 1] = (uv[2 * point + 1] - center[1]) / size;
  });
  texture.needsUpdate = true;
}

// Returns xyz of three corners a cell. values: three for each corner.
export function cornerTexture(map, values) {
  const texture = floatTexture(3 * map.faceCount, 4);
  const {data} = texture.image;
  const locals = cornerLocals(map.degree);
  for (let face = 0; face < map.faceCount; ++face)
    for (let c = 0; c < 3; ++c) {
      const corner = map.cells[face * map.size + locals[c]];
      for (let d = 0; d < 3; ++d) data[4 * (3 * face + c) + d] = values[3 * corner + d];
    }
  return texture;
}

// Returns inverses of the cells' edges, scaled so that the Jacobian of (uv - center) / size is in
// units of the surface, times the scale of the layout.
export function restTexture(map) {
  const texture = floatTexture(map.faceCount, 4);
  const factor = map.uvBounds.size * map.scale;
  for (let k = 0; k < map.rest.length; ++k) texture.image.data[k] = map.rest[k] * factor;
  return texture;
}

// Returns chart and fault of every cell, and the deviation of its quad from right angles.
export function faceTexture(map, tintCount) {
  const texture = floatTexture(map.faceCount, 4);
  const {data} = texture.image;
  for (let face = 0; face < map.faceCount; ++face)
    data[4 * face] = map.chart ? map.chart[face] % tintCount : 0;
  for (const {face} of map.faults) data[4 * face + 1] = 1;
  map.quads?.forEach(({deviation}, quad) => {
    for (const face of [2 * quad, 2 * quad + 1]) data[4 * face + 2] = deviation;
  });
  return texture;
}

// Returns a row of colours, bytes r, g, b each.
export function colorTexture(bytes, filter = LinearFilter) {
  const count = bytes.length / 3;
  const data = new Uint8Array(4 * count).fill(255);
  for (let k = 0; k < count; ++k) data.set(bytes.subarray(3 * k, 3 * k + 3), 4 * k);
  const texture = new DataTexture(data, count, 1, RGBAFormat, UnsignedByteType);
  texture.minFilter = texture.magFilter = filter;
  texture.wrapS = texture.wrapT = ClampToEdgeWrapping;
  texture.needsUpdate = true;
  return texture;
}

export const nearest = NearestFilter;

// Returns for each corner the area-weighted normal of its faces, three numbers; corners at one place
// count as one.
export function smoothNormals(map) {
  const {positions} = map;
  const names = surfaceNames(map);
  const sums = new Float64Array(3 * map.cornerCount);  // by name
  for (let face = 0; face < map.faceCount; ++face) {
    const corners = cornersOf(map, face);
    const [p, q, r] = corners.map((c) => 3 * c);
    const ax = positions[q] - positions[p], ay = positions[q + 1] - positions[p + 1],
          az = positions[q + 2] - positions[p + 2];
    const bx = positions[r] - positions[p], by = positions[r + 1] - positions[p + 1],
          bz = positions[r + 2] - positions[p + 2];
    for (const corner of corners) {
      const at = 3 * names[corner];
      sums[at] += ay * bz - az * by;
      sums[at + 1] += az * bx - ax * bz;
      sums[at + 2] += ax * by - ay * bx;
    }
  }
  const normals = new Float64Array(3 * map.cornerCount);
  for (let corner = 0; corner < map.cornerCount; ++corner) {
    const at = 3 * names[corner];
    const length = Math.hypot(sums[at], sums[at + 1], sums[at + 2]);
    for (let d = 0; d < 3; ++d)
      normals[3 * corner + d] = length > 0 ? sums[at + d] / length : Number(d === 2);
  }
  return normals;
}
