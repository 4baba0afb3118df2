// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// GLSL of the Bezier triangles of a map, for its degree. Geometry is not in attributes: cells are
// numbers, and their data are fetched from textures (textures.js).

import {cellSize, localIndex, multiIndices, multinomial} from './bezier.js';
import {cornerLocals} from './map_data.js';
import {kTextureWidth} from './textures.js';

// Returns the degree that is evaluated, and the control points of a cell that it needs: all, or the
// corners for the straight map.
export function pieceOf({degree}, straight) {
  if (straight) return {n: 1, locals: cornerLocals(degree)};
  return {n: degree, locals: Array.from({length: cellSize(degree)}, (_, l) => l)};
}

export const fetches = `
precision highp float;
precision highp int;
precision highp sampler2D;
uniform sampler2D uControl;  // (uv - center) / size, by cell and local index
uniform sampler2D uCorner;   // positions in the frame of the view, by cell and corner
uniform sampler2D uFace;     // chart, fault (0, 1)
ivec2 at(int i) { return ivec2(i % ${kTextureWidth}, i / ${kTextureWidth}); }
vec3 ofCorners(sampler2D values, int face, vec3 xi) {
  return texelFetch(values, at(3 * face), 0).xyz * xi.x +
         texelFetch(values, at(3 * face + 1), 0).xyz * xi.y +
         texelFetch(values, at(3 * face + 2), 0).xyz * xi.z;
}`;

// Expressions for the control points of a cell of a plane (the map, a scaffold).
export const fetched = (plane, straight, face, texture = 'uControl') =>
    pieceOf(plane, straight).locals.map(
        (l) => `texelFetch(${texture}, at(${face} * ${cellSize(plane.degree)} + ${l}), 0).xy`);

// void NAME(p0, ..., xi, value, d): the map of control points p0, ... and its derivatives by the
// barycentric coordinates, as sums over the control points, each with its three Bernstein
// polynomials of degree n - 1.
export function bezierGlsl(plane, straight, name = 'bezier') {
  const {n} = pieceOf(plane, straight);
  const power = (x, e) => (e === 0 ? [] : [e === 1 ? x : `${x}${e}`]);
  const lines = [];
  for (const x of ['a', 'b', 'c'])
    for (let e = 2; e < n; ++e)
      lines.push(`float ${x}${e} = ${e === 2 ? x : x + (e - 1)} * ${x};`);
  multiIndices(n - 1).forEach(([i, j, k], l) => {
    const factors = [`${multinomial(i, j, k)}.0`, ...power('a', i), ...power('b', j),
                     ...power('c', k)];
    lines.push(`float w${l} = ${factors.join(' * ')};`);
  });
  const sums = [[], [], []];
  multiIndices(n).forEach(([i, j, k], l) => {
    const term = (lower) => `w${lower} * p${l}`;
    if (i > 0) sums[0].push(term(localIndex(n - 1, i - 1, j)));
    if (j > 0) sums[1].push(term(localIndex(n - 1, i, j - 1)));
    if (k > 0) sums[2].push(term(localIndex(n - 1, i, j)));
  });
  sums.forEach((terms, c) => lines.push(`vec2 q${c} = ${terms.join(' + ')};`));
  const points = multiIndices(n).map((_, l) => `vec2 p${l}`);
  return `
void ${name}(${points.join(', ')}, vec3 xi, out vec2 value, out mat3x2 d) {
  float a = xi.x, b = xi.y, c = xi.z;
  ${lines.join('\n  ')}
  value = a * q0 + b * q1 + c * q2;
  d = ${n}.0 * mat3x2(q0, q1, q2);
}`;
}

// vec4 placeAt(face, xi): a point of a cell in clip space, on the surface or in the layout.
export function placeGlsl(plane, view, straight) {
  if (view === 'surface') return `${fetches}
uniform mat4 uCamera;
vec4 placeAt(int face, vec3 xi) { return uCamera * vec4(ofCorners(uCorner, face, xi), 1.0); }`;
  return `${fetches}
uniform mat4 uCamera;${bezierGlsl(plane, straight)}
vec4 placeAt(int face, vec3 xi) {
  vec2 uv;
  mat3x2 d;
  bezier(${fetched(plane, straight, 'face').join(', ')}, xi, uv, d);
  return uCamera * vec4(uv, 0.0, 1.0);
}`;
}
