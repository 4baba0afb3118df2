// Lines and dots that are drawn over cells: outlines, seams, cones, points and what the mouse is on.

import {cornerLocals, cornersOf} from './map_data.js';

// Colours of seams and charts: Okabe and Ito's, and a few more of their kind.
export const tints = [
  '#0072b2', '#d55e00', '#009e73', '#cc79a7', '#e69f00', '#56b4e9', '#7a5195', '#6b8e23',
  '#b5651d', '#c43d5a',
];
export const rgbOf = (hex) =>
    [1, 3, 5].map((at) => parseInt(hex.slice(at, at + 2), 16) / 255);

const edgeEnds = [[0, 1], [1, 2], [2, 0]];

// Corners that are at one place of the surface have one name.
function surfaceNames(map) {
  const names = new Map();
  return Array.from({length: map.cornerCount}, (_, corner) => {
    const key = map.positions.subarray(3 * corner, 3 * corner + 3).join();
    if (!names.has(key)) names.set(key, names.size);
    return names.get(key);
  });
}

function countEdges(map, nameOf) {
  const counts = new Map();
  for (let face = 0; face < map.faceCount; ++face) {
    const names = cornersOf(map, face).map(nameOf);
    for (const [a, b] of edgeEnds) {
      const [p, q] = [names[a], names[b]];
      const key = p < q ? `${p},${q}` : `${q},${p}`;
      counts.set(key, (counts.get(key) ?? 0) + 1);
    }
  }
  return (p, q) => counts.get(p < q ? `${p},${q}` : `${q},${p}`);
}

// [{face, edge, kind, number}]: kind `boundary` of the surface, `cut` of the layout alone, `seam`;
// number: of the chain, of the chart.
export function outlineEdges(map) {
  const names = surfaceNames(map);
  const inLayout = countEdges(map, (corner) => corner);
  const onSurface = countEdges(map, (corner) => names[corner]);
  const edges = [];
  for (let face = 0; face < map.faceCount; ++face) {
    const corners = cornersOf(map, face);
    edgeEnds.forEach(([a, b], edge) => {
      const chain = map.seamEdges ? map.seamEdges[3 * face + edge] : 0;
      if (chain > 0) {
        edges.push({face, edge, kind: 'seam', number: chain - 1});
      } else if (inLayout(corners[a], corners[b]) === 1) {
        const open = onSurface(names[corners[a]], names[corners[b]]) === 1;
        edges.push({face, edge, kind: open ? 'boundary' : 'cut', number: map.chart?.[face] ?? -1});
      }
    });
  }
  return edges;
}

// For every corner one face that has it, and which of its corners it is there.
export function cornerPlaces(map) {
  const places = new Array(map.cornerCount);
  for (let face = 0; face < map.faceCount; ++face)
    cornerLocals(map.degree).forEach((local, c) => {
      places[map.cells[face * map.size + local]] ??= {face, corner: c};
    });
  return places;
}
