// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Reads the data of the page (docs/pictures.md) as arrays.

import {cellSize, lastTriangle, restInverse} from './bezier.js';
import {readable} from './numbers.js';

function bytesOf(base64) {
  const text = atob(base64);
  const bytes = new Uint8Array(text.length);
  for (let k = 0; k < text.length; ++k) bytes[k] = text.charCodeAt(k);
  return bytes;
}

const arrayOf = (Type, base64) => (base64 ? new Type(bytesOf(base64).buffer) : null);

function planeOf(data) {
  return {
    degree: data.degree,
    faceCount: data.faces,
    size: cellSize(data.degree),
    uv: arrayOf(Float64Array, data.uv),
    cells: arrayOf(Uint32Array, data.cells),
  };
}

// Returns the control points of one face, pairs by local index.
export function controlOf(map, face, uv = map.uv) {
  const control = new Float64Array(2 * map.size);
  for (let l = 0; l < map.size; ++l) {
    const point = map.cells[face * map.size + l];
    control[2 * l] = uv[2 * point];
    control[2 * l + 1] = uv[2 * point + 1];
  }
  return control;
}

// Returns the places of corners 0, 1, 2 in the local order.
export const cornerLocals = (n) => [0, cellSize(n) - n - 1, cellSize(n) - 1];

// Returns the middle of edge 0 (01), 1 (12), 2 (20) of a face in barycentric coordinates.
export const middleOf = (edge) => [0, 1, 2].map((k) => (k === (edge + 2) % 3 ? 0 : 0.5));

export function cornersOf({degree, size, cells}, face) {
  const last = face * size + size - 1;
  return [cells[face * size], cells[last - degree], cells[last]];
}

export const positionOf = ({positions}, corner) =>
    [positions[3 * corner], positions[3 * corner + 1], positions[3 * corner + 2]];

function areaOf([p, q, r]) {
  const [a, b] = [q, r].map((x) => [x[0] - p[0], x[1] - p[1], x[2] - p[2]]);
  return 0.5 * Math.hypot(a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2],
                          a[0] * b[1] - a[1] * b[0]);
}

function addGeometry(map) {
  map.rest = new Float64Array(4 * map.faceCount);
  map.areas = new Float64Array(map.faceCount);
  for (let face = 0; face < map.faceCount; ++face) {
    const corners = cornersOf(map, face).map((corner) => positionOf(map, corner));
    map.rest.set(restInverse(...corners), 4 * face);
    map.areas[face] = areaOf(corners);
  }
}

function boundsBetween(low, high) {
  const center = low.map((x, d) => 0.5 * x + 0.5 * high[d]);
  const size = Math.max(...low.map((x, d) => high[d] - x));
  return {low, high, center, size: size > 0 ? size : 1};
}

const unionOf = (a, b) => boundsBetween(a.low.map((x, d) => Math.min(x, b.low[d])),
                                        a.high.map((x, d) => Math.max(x, b.high[d])));

export function boundsOf(values, dimension) {
  const low = Array(dimension).fill(Infinity);
  const high = Array(dimension).fill(-Infinity);
  for (let k = 0; k < values.length; ++k) {
    const d = k % dimension;
    if (values[k] < low[d]) low[d] = values[k];
    if (values[k] > high[d]) high[d] = values[k];
  }
  return boundsBetween(low, high);
}

// Returns uv of points, turned so that the direction is horizontal.
export function turnedAlong([c, s], uv) {
  const turned = new Float64Array(uv.length);
  for (let k = 0; k < uv.length; k += 2) {
    turned[k] = c * uv[k] + s * uv[k + 1];
    turned[k + 1] = c * uv[k + 1] - s * uv[k];
  }
  return turned;
}

// Returns where boundary edges of the layout meet: [{edges: [[a, b], [c, d]], uv, places}], by
// vertices of the input; places: the halves of these edges that belong to faces, as {face, edge}.
function contactsOf(map) {
  const listed = map.facts.result?.boundary?.contacts;
  if (!Array.isArray(listed) || listed.length === 0 || !map.inputVertex) return [];
  const halves = new Map(listed.flatMap(({edges}) => edges).map((edge) => [edge.join(), null]));
  for (let face = 0; face < map.faceCount; ++face) {
    const names = cornersOf(map, face).map((corner) => map.inputVertex[corner]);
    for (let edge = 0; edge < 3; ++edge) {
      const key = `${names[edge]},${names[(edge + 1) % 3]}`;
      if (halves.has(key)) halves.set(key, {face, edge});
    }
  }
  return listed.map((contact) => ({
    ...contact, places: contact.edges.map((edge) => halves.get(edge.join())).filter(Boolean),
  }));
}

// Reads the map of the page. uv, positions: as in the file, in doubles; with bounds of both, and of
// the whole film.
export function readMap(data) {
  const map = {
    ...planeOf(data),
    title: data.title,
    cornerCount: data.corners,
    positions: arrayOf(Float64Array, data.positions),
    inputVertex: arrayOf(Int32Array, data.input_vertex),
    inputFace: arrayOf(Int32Array, data.input_face),
    chart: arrayOf(Int32Array, data.chart),
    seamEdges: arrayOf(Int32Array, data.seam_edges),
    cones: data.cones,
    points: data.points,
    faults: data.faults,
    scaffold: data.scaffold ? planeOf(data.scaffold) : null,
    claims: data.claims,
    facts: data.facts,
    direction: data.direction,
    eye: data.eye,
    scale: data.scale.value,
    scaleIsAssumed: data.scale.assumed,
  };
  map.snapshots = data.snapshots.map(({uv, ...rest}) => ({...rest, uv: arrayOf(Float32Array, uv)}));
  map.uvBounds = boundsOf(map.uv, 2);
  map.turnedBounds = boundsOf(turnedAlong(map.direction, map.uv), 2);
  map.shownBounds = map.snapshots.reduce(
      (all, {uv}) => unionOf(all, boundsOf(turnedAlong(map.direction, uv), 2)), map.turnedBounds);
  map.bounds = boundsOf(map.positions, 3);
  // True if this is not a map of a surface, but the sides of elements of a volume mesh. Each
  // element is a chart with its number in the input.
  map.isOfElements = map.facts.command === 'mesh check';
  // True if this is a quad mesh, with two halves for each quad (quads.js).
  map.isOfQuads = map.facts.command === 'quads';
  // True for layouts made for the unit square, or by programs that know no others.
  map.isInSquare = Boolean(map.claims.normalized) || map.scaleIsAssumed;
  map.contacts = contactsOf(map);
  addGeometry(map);
  return map;
}

// Returns "face 12" of the page, or the element or quad that contains it.
export function nameOf(map, face) {
  if (map.isOfQuads) return `quad ${readable(map.inputFace[face])}`;
  return map.isOfElements ? `element ${map.inputFace[face]}` : `face ${readable(face)}`;
}

// Evaluates the map, or the straight map with the same corners, at xi on a face.
export function evaluate(map, face, xi, uv = map.uv) {
  return lastTriangle(map.degree, controlOf(map, face, uv), xi);
}
