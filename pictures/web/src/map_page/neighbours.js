// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Finds faces that share an edge on the surface, also across cuts of the layout.

import {cornersOf, positionOf} from './map_data.js';

const edgeEnds = [[0, 1], [1, 2], [2, 0]];

// Names corners such that corners at one place of the surface have one name.
export function surfaceNames(map) {
  const names = new Map();
  return Array.from({length: map.cornerCount}, (_, corner) => {
    const key = positionOf(map, corner).join();
    if (!names.has(key)) names.set(key, names.size);
    return names.get(key);
  });
}

// Returns for each edge its key, the same for both sides, and the faces that have it.
export function facesOfEdges(map, nameOf) {
  const faces = new Map();
  const keys = new Array(3 * map.faceCount);
  for (let face = 0; face < map.faceCount; ++face) {
    const names = cornersOf(map, face).map(nameOf);
    edgeEnds.forEach(([a, b], edge) => {
      const [p, q] = [Math.min(names[a], names[b]), Math.max(names[a], names[b])];
      const key = p * map.cornerCount + q;
      keys[3 * face + edge] = key;
      if (faces.has(key)) faces.get(key).push(face);
      else faces.set(key, [face]);
    });
  }
  return {at: (face, edge) => faces.get(keys[3 * face + edge])};
}

export function neighboursOf(edges, face) {
  return [0, 1, 2].flatMap((edge) => edges.at(face, edge).filter((other) => other !== face));
}
