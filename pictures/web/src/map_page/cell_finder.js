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
    for (let face = 0; face < this.map.faceCount; ++face) {
      const control = controlOf(this.map, face, uv);
      const box = [Infinity, Infinity, -Infinity, -Infinity];
      for (let k = 0; k < control.length; ++k) {
        box[k % 2] = Math.min(box[k % 2], control[k]);
        box[2 + (k % 2)] = Math.max(box[2 + (k % 2)], control[k]);
      }
      this.found.set(box, 4 * face);
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
