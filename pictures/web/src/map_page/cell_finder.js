// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Finds the cell of the layout that contains a point.

import {locate} from './bezier.js';
import {controlOf} from './map_data.js';

export class CellFinder {
  constructor(map) { this.map = map; }

  // Returns bounding boxes of the cells' control points: low u, v and high u, v each.
  boxes(uv) {
    if (this.uv === uv) return this.found;
    this.uv = uv;
    this.found = new Float64Array(4 * this.map.faceCount);
    const {faceCount, size, cells} = this.map;
    for (let face = 0; face < faceCount; ++face)
      for (let d = 0; d < 2; ++d) {
        let low = Infinity, high = -Infinity;
        for (let l = 0; l < size; ++l) {
          const x = uv[2 * cells[face * size + l] + d];
          low = Math.min(low, x);
          high = Math.max(high, x);
        }
        this.found[4 * face + d] = low;
        this.found[4 * face + 2 + d] = high;
      }
    return this.found;
  }

  // Returns the first {face, xi} whose image under the map with control points uv is there, or
  // null.
  find(uv, at) {
    const boxes = this.boxes(uv);
    for (let face = 0; face < this.map.faceCount; ++face) {
      const b = 4 * face;
      if (at[0] < boxes[b] || at[0] > boxes[b + 2] || at[1] < boxes[b + 1] || at[1] > boxes[b + 3])
        continue;
      const xi = locate(this.map.degree, controlOf(this.map, face, uv), at);
      if (xi) return {face, xi};
    }
    return null;
  }
}
