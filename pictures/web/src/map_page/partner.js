// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Finds the other side of a cut: an edge that is one on the surface and two in the layout.

import {cornersOf} from './map_data.js';
import {layoutEdges, surfaceEdges, surfaceNames} from './neighbours.js';

const endsOf = (edge) => [edge, (edge + 1) % 3];

// Returns a function of a place {face, xi}: {here, there, foot, place} for the nearest cut in its
// face, or null if there is none. here, there: both sides {face, edge}; foot, place: the points on
// them.
export function partnerOf(map) {
  const names = surfaceNames(map);
  const inLayout = layoutEdges(map), onSurface = surfaceEdges(map);
  const namesAt = (face, edge) => {
    const corners = cornersOf(map, face);
    return endsOf(edge).map((end) => names[corners[end]]);
  };
  const sideOf = (face, ends) => [0, 1, 2].find(
      (edge) => ends.every((name) => namesAt(face, edge).includes(name)));
  // Returns the part along an edge from the end with that name.
  const placeOn = ({face, edge}, name, part) => {
    const first = namesAt(face, edge)[0] === name ? part : 1 - part;
    const [a, b] = endsOf(edge);
    const xi = [0, 0, 0];
    [xi[a], xi[b]] = [1 - first, first];
    return {face, xi};
  };
  return ({face, xi}) => {
    const cuts = [0, 1, 2].filter((edge) => inLayout.countAt(face, edge) === 1 &&
                                            onSurface.countAt(face, edge) === 2);
    if (cuts.length === 0) return null;
    const [edge] = cuts.sort((e, f) => xi[(e + 2) % 3] - xi[(f + 2) % 3]);
    const here = {face, edge};
    const ends = namesAt(face, edge);
    const other = onSurface.at(face, edge).find((beyond) => beyond !== face) ?? face;
    const there = {face: other, edge: sideOf(other, ends)};
    const [a, b] = endsOf(edge);
    const part = xi[b] / (xi[a] + xi[b] || 1);
    return {here, there, foot: placeOn(here, ends[0], part), place: placeOn(there, ends[0], part)};
  };
}
