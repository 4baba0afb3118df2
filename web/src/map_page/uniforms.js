// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// What the programs of both views share: textures of the map, and what the state says.

import {tints, rgbOf} from './marks.js';
import * as textures from './textures.js';

const kCheckers = 40;  // along the layout, at least half of them

// [cells along the layout's size, phase of u and v]: a cell is 1, 2 or 5 times a power of ten wide.
function checkerFrame({size, center}) {
  const wanted = size / kCheckers;
  const power = 10 ** Math.floor(Math.log10(wanted));
  const width = power * [1, 2, 5, 10].find((digit) => digit * power >= wanted);
  return [size / width, ...center.map((c) => (c / width) % 2)];
}

// An image fills the unit square of layouts that were made for one, and the square around the
// middle of others.
function imageFrame({claims, scaleIsAssumed, uvBounds: {size, center}}) {
  return claims.normalized || scaleIsAssumed ? [size, ...center] : [1, 0.5, 0.5];
}

export function makeUniforms({map}) {
  const {low, high, center} = map.bounds;
  const radius = 0.5 * Math.hypot(...high.map((x, d) => x - low[d])) || 1;
  const inFrame = (corner) =>
      [0, 1, 2].map((d) => (map.positions[3 * corner + d] - center[d]) / radius);
  const tintBytes = Uint8Array.from(tints.flatMap((hex) => rgbOf(hex).map((x) => 255 * x)));
  const values = {
    uControl: textures.controlTexture(map, map.uvBounds),
    uCorner: textures.cornerTexture(map, inFrame),
    uNormal: textures.cornerTexture(map, textures.smoothNormals(map)),
    uRest: textures.restTexture(map),
    uFace: textures.faceTexture(map, tints.length),
    uTints: textures.colorTexture(tintBytes, textures.nearest),
    uColors: textures.colorTexture(new Uint8Array(768)),
    uImage: null,
    uHovered: -1,
    uPinned: -1,
    uScale: [0, 0, 1, 0],
    uUnit: 1,
    uBrush: [0, 1],
    uChecker: checkerFrame(map.uvBounds),
    uImageFrame: imageFrame(map),
    uAccent: [0, 0, 0],
    uFlipped: rgbOf('#d600be'),
    uFaultsShown: true,
    uEdges: 0,
    uEye: [0, 0, 1],
    uPixel: 1,
    uRim: [1, 1, 1],
    uPaper: [1, 1, 1],
    uInk: [0, 0, 0],
  };
  return {
    surfaceFrame: {center, radius},
    uniforms: Object.fromEntries(
        Object.entries(values).map(([name, value]) => [name, {value}])),
    scaffoldControl: map.scaffold ? textures.controlTexture(map.scaffold, map.uvBounds) : null,
  };
}
