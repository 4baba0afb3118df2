// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Programs that draw marks over cells and around them: lines, dots, the scaffold.

import {placeGlsl} from './bezier_glsl.js';

// Draws bands of constant width in pixels along edges of cells, or from a point to its target.
export const linesVertex = (map, view, straight) => `${placeGlsl(map, view, straight)}
uniform vec2 uViewport;  // in pixels
uniform float uPixel;
in vec3 position;  // t along the line, side -1 or 1, width
in vec3 line;      // cell; edge 0 (01), 1 (12), 2 (20), 3: corner to target, 4: target alone; corner
in vec3 tint;
in vec4 target;    // in the frame of the layout
out vec3 vTint;
vec3 along(float t, int edge) {
  if (edge == 0) return vec3(1.0 - t, t, 0.0);
  return edge == 1 ? vec3(0.0, 1.0 - t, t) : vec3(t, 0.0, 1.0 - t);
}
vec4 pointAt(float t) {
  int face = int(line.x), edge = int(line.y), corner = int(line.z);
  if (edge < 3) return placeAt(face, along(t, edge));
  if (edge == 4) return uCamera * vec4(mix(target.xy, target.zw, t), 0.0, 1.0);
  vec4 from = placeAt(face, vec3(corner == 0, corner == 1, corner == 2));
  return ${view === 'surface' ? 'from' : 'mix(from, uCamera * vec4(target.xy, 0.0, 1.0), t)'};
}
void main() {
  vTint = tint;
  vec4 here = pointAt(position.x);
  vec4 before = pointAt(position.x - 0.02), after = pointAt(position.x + 0.02);
  vec2 way = (after.xy / after.w - before.xy / before.w) * uViewport;
  vec2 across = length(way) > 0.0 ? normalize(vec2(-way.y, way.x)) : vec2(0.0);
  here.xy += across * position.y * position.z * uPixel / uViewport * here.w;
  ${view === 'surface' ? 'here.z -= 2e-3 * here.w;' : ''}
  gl_Position = here;
}`;

export const linesFragment = `
precision highp float;
in vec3 vTint;
out vec4 fragment;
void main() { fragment = vec4(vTint, 1.0); }`;

// Draws discs at points of cells.
export const dotsVertex = (map, view) => `${placeGlsl(map, view, false)}
uniform float uPixel;
in vec3 position;  // cell, first two barycentric coordinates
in vec4 disc;      // radius in pixels, tint
out vec3 vTint;
out float vRadius;
void main() {
  vTint = disc.yzw;
  vRadius = disc.x * uPixel;
  vec3 xi = vec3(position.yz, 1.0 - position.y - position.z);
  gl_Position = placeAt(int(position.x), xi);
  ${view === 'surface' ? 'gl_Position.z -= 4e-3 * gl_Position.w;' : ''}
  gl_PointSize = 2.0 * vRadius + 2.0;
}`;

export const dotsFragment = `
precision highp float;
uniform float uPixel;
uniform vec3 uRim;
in vec3 vTint;
in float vRadius;
out vec4 fragment;
void main() {
  float far = length(gl_PointCoord - 0.5) * (2.0 * vRadius + 2.0);
  float cover = clamp(vRadius + 0.5 - far, 0.0, 1.0);
  if (cover == 0.0) discard;
  float rim = smoothstep(vRadius - 1.8 * uPixel, vRadius - 1.2 * uPixel, far);
  fragment = vec4(mix(vTint, uRim, rim), cover);
}`;

// Draws the space around the image.
export const scaffoldVertex = (scaffold) => `${placeGlsl(scaffold, 'layout', false)}
in vec3 position;  // as of facesVertex
out vec2 vBary;
void main() {
  vBary = position.yz;
  gl_Position = placeAt(int(position.x), vec3(vBary, 1.0 - vBary.x - vBary.y));
}`;

export const scaffoldFragment = `
precision highp float;
uniform vec3 uPaper, uInk;
uniform float uPixel;
in vec2 vBary;
out vec4 fragment;
void main() {
  vec3 xi = vec3(vBary, 1.0 - vBary.x - vBary.y);
  vec3 width = fwidth(xi);
  vec3 far = xi / max(width, 1e-9);
  float near = min(far.x, min(far.y, far.z));
  float small = 1.0 - smoothstep(0.06, 0.35, max(width.x, max(width.y, width.z)) / uPixel);
  float edge = small * (1.0 - smoothstep(0.1 * uPixel, 0.9 * uPixel, near));
  fragment = vec4(mix(uPaper, uInk, 0.04 + 0.22 * edge), 1.0);
}`;

// Draws stripes over the whole view where the stencil allows it.
export const hatchVertex = `
in vec3 position;  // of the window, -1 to 1
void main() { gl_Position = vec4(position.xy, 0.0, 1.0); }`;

export const hatchFragment = `
precision highp float;
uniform float uPixel;
uniform vec3 uMeets;
out vec4 fragment;
void main() {
  bool isStripe = mod(gl_FragCoord.x - gl_FragCoord.y, 7.0 * uPixel) < 2.0 * uPixel;
  fragment = vec4(uMeets, isStripe ? 0.9 : 0.16);
}`;
