// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Makes the textures that the programs of shaders.js fetch from arrays of the map.

import {
  ClampToEdgeWrapping, DataTexture, FloatType, LinearFilter, NearestFilter, RGBAFormat, RGFormat,
  UnsignedByteType,
} from 'three';

import {cornersOf} from './map_data.js';

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

// Returns xyz of three corners a cell, from values per corner.
export function cornerTexture(map, valueOf) {
  const texture = floatTexture(3 * map.faceCount, 4);
  const {data} = texture.image;
  for (let face = 0; face < map.faceCount; ++face)
    cornersOf(map, face).forEach((corner, c) => data.set(valueOf(corner), 4 * (3 * face + c)));
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

// Returns for each corner the area-weighted normal of its faces; corners at one place count as one.
export function smoothNormals(map) {
  const sums = new Map();
  const keyOf = (corner) => map.positions.subarray(3 * corner, 3 * corner + 3).join();
  const keys = Array.from({length: map.cornerCount}, (_, corner) => keyOf(corner));
  for (let face = 0; face < map.faceCount; ++face) {
    const corners = cornersOf(map, face);
    const [p, q, r] = corners.map((c) => map.positions.subarray(3 * c, 3 * c + 3));
    const a = [q[0] - p[0], q[1] - p[1], q[2] - p[2]];
    const b = [r[0] - p[0], r[1] - p[1], r[2] - p[2]];
    const n = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
    for (const corner of corners) {
      const sum = sums.get(keys[corner]) ?? [0, 0, 0];
      sums.set(keys[corner], sum.map((x, d) => x + n[d]));
    }
  }
  return (corner) => {
    const n = sums.get(keys[corner]);
    const length = Math.hypot(...n);
    return length > 0 ? n.map((x) => x / length) : [0, 0, 1];
  };
}
