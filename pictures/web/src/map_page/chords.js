// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Divides curved cells of the layout into flat pieces for drawing, so finely that none is more than
// a fraction of a pixel off.

import {localIndex, multiIndices} from './bezier.js';
import {layoutEdges} from './neighbours.js';

const kError = 0.5;   // pixels between a cell and its pieces
const kMostPieces = 16;  // along an edge; a power of two
const kMostTriangles = 1e6;

// Returns for every cell its approximate distance from the flat triangle of its corners. A
// quadratic map with second derivatives M along the edges differs by half the sum of xi_a xi_b
// M_ab, at most a sixth of the largest; small pieces of other maps are nearly quadratic. The M of a
// cell are n (n - 1) times second differences of its control points. For k * k pieces the distance
// is a k^2-th.
export function bendsOf({degree: n, size, faceCount, cells}, uv) {
  const bends = new Float64Array(faceCount);
  if (n === 1) return bends;
  // Returns local indices p, q, r of all differences p - 2 q + r.
  const differences = multiIndices(n - 2).flatMap(([i, j]) => {
    const at = (a, b) => localIndex(n, i + a, j + b);
    return [[at(2, 0), at(1, 0), at(0, 0)], [at(0, 2), at(0, 1), at(0, 0)],
            [at(2, 0), at(1, 1), at(0, 2)]];
  });
  for (let face = 0; face < faceCount; ++face) {
    let most = 0;
    for (const locals of differences) {
      const [p, q, r] = locals.map((l) => 2 * cells[face * size + l]);
      most = Math.max(most, Math.hypot(uv[p] - 2 * uv[q] + uv[r],
                                       uv[p + 1] - 2 * uv[q + 1] + uv[r + 1]));
    }
    bends[face] = n * (n - 1) / 6 * most;
  }
  return bends;
}

function piecesWithin(error, bends) {
  return Uint8Array.from(bends, (bend) => {
    let k = 1;
    while (k < kMostPieces && bend > error * k * k) k *= 2;
    return k;
  });
}

// Returns {pieces, areCoarse}: the pieces along the edges of every cell, a power of two; and
// whether some are less accurate than required, because there would be too many. bends: in pixels.
export function piecesFor(bends) {
  let error = kError;
  let pieces = piecesWithin(error, bends);
  while (pieces.reduce((sum, k) => sum + k * k, 0) > kMostTriangles) {
    error *= 2;
    pieces = piecesWithin(error, bends);
  }
  return {pieces, areCoarse: bends.some((bend, face) => bend > kError * pieces[face] ** 2)};
}

// A layout whose cells are divided. `of(uv, scale)` returns {pieces, edges, areCoarse} for control
// points uv and pixels per unit of uv. edges: for edges 01, 12, 20 of every cell, the pieces of the
// coarser of the two cells there, so that there are no gaps. The same object is returned as long as
// it suffices.
export class Chords {
  constructor(plane) {
    this.plane = plane;
    this.sides = layoutEdges(plane);
  }

  of(uv, scale) {
    // else every step of a zoom would divide all cells again
    const level = Math.ceil(Math.log2(scale));
    if (this.uv === uv && this.level === level) return this.cut;
    if (this.uv !== uv) this.bends = bendsOf(this.plane, uv);
    Object.assign(this, {uv, level});
    const {pieces, areCoarse} = piecesFor(this.bends.map((bend) => bend * 2 ** level));
    const edges = new Uint8Array(3 * pieces.length);
    for (let face = 0; face < pieces.length; ++face)
      for (let edge = 0; edge < 3; ++edge)
        edges[3 * face + edge] =
            this.sides.at(face, edge).reduce((k, other) => Math.min(k, pieces[other]), kMostPieces);
    this.cut = {pieces, edges, areCoarse};
    return this.cut;
  }
}
