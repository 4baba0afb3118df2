// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Uniforms that the programs of both views share: textures of the map, and values of the state.

import {kMeets, tints, rgbOf} from './marks.js';
import * as textures from './textures.js';

const kCheckers = 40;  // squares along the layout; at least half of them are used

// Returns the width of a square of the checkerboard, 1, 2 or 5 times a power of ten; steps: number
// of steps in this sequence.
export function checkerWidth({size}, steps) {
  const width = size / kCheckers;
  const power = Math.floor(Math.log10(width));
  const first = [1, 2, 5, 10].findIndex((digit) => digit * 10 ** power >= width);
  const step = first + steps + 3 * power;
  return [1, 2, 5][((step % 3) + 3) % 3] * 10 ** Math.floor(step / 3);
}

// Returns [squares along the layout's size, phase of u and v].
export function checkerFrame({size, center}, width) {
  return [size / width, ...center.map((c) => (c / width) % 2)];
}

// Maps positions in the frame of the surface to uv in that of the layout.
const restFrame = ({uvBounds}, center, radius) =>
    [radius, ...[0, 1].map((d) => center[d] - uvBounds.center[d])].map((x) => x / uvBounds.size);

// An image fills the unit square of layouts made for it, and the square around the middle of
// others.
function imageFrame({isInSquare, uvBounds: {size, center}}) {
  return isInSquare ? [size, ...center] : [1, 0.5, 0.5];
}

export function makeUniforms({map}) {
  const {low, high, center} = map.bounds;
  const radius = 0.5 * Math.hypot(...high.map((x, d) => x - low[d])) || 1;
  const inFrame = map.positions.map((x, k) => (x - center[k % 3]) / radius);
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
    uOther: null,
    uOtherFactor: 1,
    uHovered: -1,
    uPinned: -1,
    uScale: [0, 0, 1, 0],
    uUnit: 1,
    uBrush: [0, 1],
    uChecker: [1, 0, 0],
    uRestFrame: restFrame(map, center, radius),
    uImageFrame: imageFrame(map),
    uAccent: [0, 0, 0],
    uFlipped: rgbOf('#d600be'),
    uMeets: rgbOf(kMeets),
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
