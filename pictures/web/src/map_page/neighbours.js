// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Finds faces that share an edge, in the layout or on the surface, where cuts join.
//
// Pages have up to a million faces: lists are typed arrays, and each is made once for a map.

import {cornersOf} from './map_data.js';

const madeOnce = (make) => {
  const known = new WeakMap();
  return (map) => {
    if (!known.has(map)) known.set(map, make(map));
    return known.get(map);
  };
};

// Returns for every corner the first corner at its place of the surface.
export const surfaceNames = madeOnce(({cornerCount, positions}) => {
  const mask = 2 ** Math.ceil(Math.log2(2 * cornerCount + 1)) - 1;
  const table = new Int32Array(mask + 1).fill(-1);
  const names = new Uint32Array(cornerCount);
  const place = new Float64Array(3);
  const words = new Uint32Array(place.buffer);
  for (let corner = 0; corner < cornerCount; ++corner) {
    for (let d = 0; d < 3; ++d) place[d] = positions[3 * corner + d] + 0;  // -0 becomes 0
    let hash = 0;
    for (let k = 0; k < 6; ++k) {
      hash = Math.imul(hash ^ words[k], 0x9e3779b1);
      hash ^= hash >>> 15;
    }
    let at = hash & mask;
    for (; table[at] >= 0; at = (at + 1) & mask) {
      const other = 3 * table[at];
      if (positions[other] === place[0] && positions[other + 1] === place[1] &&
          positions[other + 2] === place[2])
        break;
    }
    if (table[at] < 0) table[at] = corner;
    names[corner] = table[at];
  }
  return names;
});

// The edges of a map whose corners have names, numbers of points. at(face, edge)
// returns all faces with this edge, in ascending order, and countAt() their number.
class Edges {
  constructor(map, names) {
    const {faceCount} = map;
    const points = map.cells.reduce((most, point) => Math.max(most, point), 0) + 1;
    this.low = new Uint32Array(3 * faceCount);
    this.high = new Uint32Array(3 * faceCount);
    this.first = new Uint32Array(points + 1);  // places in `halves`, by the lower name
    for (let face = 0; face < faceCount; ++face) {
      const ends = cornersOf(map, face);
      if (names) for (let k = 0; k < 3; ++k) ends[k] = names[ends[k]];
      for (let edge = 0; edge < 3; ++edge) {
        const a = ends[edge], b = ends[(edge + 1) % 3];
        this.low[3 * face + edge] = Math.min(a, b);
        this.high[3 * face + edge] = Math.max(a, b);
        ++this.first[Math.min(a, b) + 1];
      }
    }
    for (let k = 0; k < points; ++k) this.first[k + 1] += this.first[k];
    const next = this.first.slice();
    this.halves = new Uint32Array(3 * faceCount);  // 3 face + edge
    for (let half = 0; half < 3 * faceCount; ++half) this.halves[next[this.low[half]]++] = half;
  }

  at(face, edge) {
    const half = 3 * face + edge;
    const faces = [];
    for (let k = this.first[this.low[half]]; k < this.first[this.low[half] + 1]; ++k)
      if (this.high[this.halves[k]] === this.high[half]) faces.push(Math.floor(this.halves[k] / 3));
    return faces;
  }

  countAt(face, edge) {
    const half = 3 * face + edge;
    let count = 0;
    for (let k = this.first[this.low[half]]; k < this.first[this.low[half] + 1]; ++k)
      if (this.high[this.halves[k]] === this.high[half]) ++count;
    return count;
  }
}

export const layoutEdges = madeOnce((map) => new Edges(map, null));
export const surfaceEdges = madeOnce((map) => new Edges(map, surfaceNames(map)));

export function neighboursOf(edges, face) {
  return [0, 1, 2].flatMap((edge) => edges.at(face, edge).filter((other) => other !== face));
}
