// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Programs that draw the cells of a map, one for every picture, map and view, since software
// renderers execute all branches of a program.

import {bezierGlsl, fetched, fetches, pieceOf} from './bezier_glsl.js';
import {densityGlsl} from './energies.js';

const kMostFlat = 21;  // control points handed to fragments: 11 varyings of the 15 that exist

// Expressions of the singular values S >= s.
const quantities = {
  'density': (energy) => (energy ? densityGlsl(energy) : 'S * s'),
  'area': () => 'S * s',
  'angle': () => 'S / s',
  'sigma-max': () => 'S',
  'sigma-min': () => 's',
  'deviation': () => 'T',  // of quads
};

// The difference of the first and the second map.
const differenceOf = (energy, sign) => {
  const ofOther = densityGlsl(energy).replace(/\b[Ss]\b/g, (x) => (x === 'S' ? 'T' : 't'));
  return `${sign}.0 * ((${densityGlsl(energy)}) - (${ofOther}))`;
};

// Colours of fragments by name, with the data that they need: the `value` of the map, its
// `jacobian`.
const colors = {
  checker: {needs: 'value', glsl: 'checker(uv)'},
  grid: {needs: 'value', glsl: 'grid(uv)'},
  image: {needs: 'value', glsl: 'texture(uImage, uv * uImageFrame.x + uImageFrame.yz).rgb'},
  heat: {needs: 'jacobian', glsl: 'heat(sigma, other)'},
  chart: {glsl: 'mix(vec3(1.0), texelFetch(uTints, ivec2(int(face.x), 0), 0).rgb, 0.55)'},
};

// Passes that are read back instead of shown.
const passes = {
  uvPass: {needs: 'value', glsl: 'packed(uv + 0.5)'},
  facePass: {
    glsl: 'vec4(vec3(vFace + 1 >> 16 & 255, vFace + 1 >> 8 & 255, vFace + 1 & 255) / 255.0, 1.0)',
  },
  baryPass: {glsl: 'packed(xi.xy)'},
  quantityPass: {
    needs: 'jacobian',
    glsl: 'sigma.y > 0.0 ? packed(vec2(scalePosition(sigma, other), 1.0)) : vec4(0.0)',
  },
};

// The tasks of a picture's programs. picture:
//     view       'surface' or 'layout'
//     name       of colors or passes
//     quantity   of heat maps and their pass
//     other      of differences: degree of the other map, sign of this one
//     straight   of the straight map of the same corners
//     isAtRest   the texture lies on the surface, which is planar, not in the layout
//     isCoarse   the layout is cut less finely than wanted: places in cells are improved
function planOf(map, {view, name, quantity, straight, isAtRest, isCoarse}) {
  const shown = colors[name] ?? passes[name];
  const liesOnSurface = isAtRest && shown.needs === 'value' && !(name in passes);
  const improves = view === 'layout' && isCoarse && !straight;
  const evaluates = improves || shown.needs === 'jacobian' ||
      (shown.needs === 'value' && view === 'surface' && !liesOnSurface);
  const {locals} = pieceOf(map, straight);
  return {
    shown, view, straight, improves, evaluates, liesOnSurface, isPass: name in passes, quantity,
    flat: evaluates && locals.length <= kMostFlat ? locals.length : 0,
  };
}

const flatSize = (count) => Math.ceil(count / 2);
const flatName = (_, l) => `vControl[${l >> 1}].${l % 2 ? 'zw' : 'xy'}`;

export function facesVertex(map, picture) {
  const {view, straight, flat} = planOf(map, picture);
  const points = fetched(map, straight, 'vFace');
  return `${fetches}
${view === 'layout' ? bezierGlsl(map, straight) : ''}
uniform mat4 uCamera;
uniform sampler2D uNormal;
in vec3 position;  // cell, first two barycentric coordinates
flat out int vFace;
${flat ? `flat out vec4 vControl[${flatSize(flat)}];` : ''}
out vec2 vBary;
out ${view === 'layout' ? 'vec2 vUv' : 'vec3 vNormal'};
void main() {
  vFace = int(position.x);
  vBary = position.yz;
  vec3 xi = vec3(vBary, 1.0 - vBary.x - vBary.y);
  ${flat ? points.map((point, l) => `${flatName(point, l)} = ${point};`).join('\n  ') : ''}
  ${view === 'layout' ? `
  mat3x2 d;
  bezier(${(flat ? points.map(flatName) : points).join(', ')}, xi, vUv, d);
  gl_Position = uCamera * vec4(vUv, 0.0, 1.0);` : `
  vNormal = ofCorners(uNormal, vFace, xi);
  gl_Position = uCamera * vec4(ofCorners(uCorner, vFace, xi), 1.0);`}
}`;
}

// The layout is drawn in flat pieces: the fragment is exactly at vUv, but xi is interpolated over a
// piece. A step of Newton's method corrects it.
const improvePlace = (evaluate) => `
  vec2 e = d[0] - d[2], f = d[1] - d[2], off = vUv - uv;
  float det = e.x * f.y - e.y * f.x;
  vec2 step = vec2(off.x * f.y - off.y * f.x, off.y * e.x - off.x * e.y) / det;
  if (abs(det) > 0.0 && max(abs(step.x), abs(step.y)) < 0.25) {
    xi += vec3(step, -step.x - step.y);
    ${evaluate}
  }`;

// Functions for what the program shows; unused ones cost nothing.
const paints = (value) => `
uniform sampler2D uColors;   // the scale, 256 colours
uniform sampler2D uImage;
uniform sampler2D uTints;    // of charts
uniform vec4 uScale;         // 1 for diverging, 2 for linear ones; log s(low), log s(high); neutral
uniform float uUnit;         // of the scale
uniform vec2 uBrush;         // positions on it that are selected
uniform vec3 uChecker;       // cells along the size of uv, phase of u and v
uniform sampler2D uOther;    // uControl of the other map of a comparison
uniform float uOtherFactor;  // of its lengths against those of this one
uniform vec3 uImageFrame;    // likewise of the image
uniform vec3 uRestFrame;     // from the frame of the surface to that of uv, of planar surfaces
uniform vec3 uFlipped;

vec2 singularValues(mat3x2 d, vec4 rest) {
  vec2 e = d[0] - d[2], f = d[1] - d[2];
  vec2 x = e * rest.x + f * rest.z, y = e * rest.y + f * rest.w;
  float alpha = 0.5 * length(vec2(x.x + y.y, x.y - y.x));
  float beta = 0.5 * length(vec2(x.x - y.y, x.y + y.x));
  return vec2(alpha + beta, alpha - beta);
}

float scalePosition(vec2 sigma, vec2 other) {
  float S = sigma.x, s = sigma.y, T = other.x, t = other.y;
  float value = ${value};
  bool diverging = uScale.x > 0.5;
  float far = log(max(diverging ? value / uScale.w : 1.0 + (value - uScale.w) / uUnit, 1e-30));
  if (uScale.x > 1.5) far = value;
  if (diverging) return clamp(0.5 + 0.5 * far / (far < 0.0 ? -uScale.y : uScale.z), 0.0, 1.0);
  return clamp((far - uScale.y) / (uScale.z - uScale.y), 0.0, 1.0);
}

// Grey where the brush has not been.
vec3 heat(vec2 sigma, vec2 other) {
  bool flipped = !(sigma.y > 0.0);
  float position = scalePosition(sigma, other);
  vec3 color = flipped ? uFlipped
                       : texture(uColors, vec2((position * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  bool isLeft = flipped ? uBrush.x > 0.0 : position < uBrush.x || position > uBrush.y;
  return isLeft ? mix(vec3(0.62), vec3(dot(color, vec3(0.3, 0.59, 0.11))), 0.25) : color;
}

// Part of a pixel of width w around x in which the unit square wave is up.
float wave(float x, float w) {
  vec2 t = vec2(x - 0.5 * w, x + 0.5 * w) * 0.5;
  vec2 integral = floor(t) + min(fract(t) * 2.0, 1.0);
  return w < 1e-6 ? step(fract(x * 0.5), 0.4999) : (integral.y - integral.x) / w;
}

vec3 checker(vec2 uv) {
  vec2 x = uv * uChecker.x + uChecker.yz;
  vec2 w = max(fwidth(x), 1e-5);
  vec2 p = vec2(wave(x.x, w.x), wave(x.y, w.y)) * 2.0 - 1.0;
  return mix(vec3(0.31, 0.42, 0.53), vec3(0.95, 0.94, 0.91), 0.5 + 0.5 * p.x * p.y);
}

vec3 grid(vec2 uv) {
  vec2 x = uv * uChecker.x + uChecker.yz;
  vec2 w = max(fwidth(x), 1e-5);
  vec2 far = abs(fract(x + 0.5) - 0.5) / w;
  vec2 line = (1.0 - smoothstep(0.4 * uPixel, 1.1 * uPixel, far)) * (1.0 - smoothstep(0.2, 0.5, w));
  vec3 color = vec3(0.95, 0.94, 0.91);
  color = mix(color, vec3(0.75, 0.33, 0.12), line.x);
  return mix(color, vec3(0.12, 0.37, 0.62), line.y * (1.0 - 0.5 * line.x));
}

vec4 packed(vec2 x) {
  vec2 levels = clamp(floor(x * 65535.0 + 0.5), 0.0, 65535.0);
  vec2 high = floor(levels / 256.0);
  return vec4(high.x, levels.x - 256.0 * high.x, high.y, levels.y - 256.0 * high.y) / 255.0;
}`;

// Adds to the colour: edges, thinner where triangles are small; faults; the place under the mouse;
// light.
const details = (map, view) => {
  const is = (face) => (map.isOfQuads ? `(vFace >> 1) == (${face} >> 1)` : `vFace == ${face}`);
  return `
  vec3 width = fwidth(xi);
  vec3 far = abs(xi) / max(width, 1e-9);
  ${map.isOfQuads ? `// Diagonals of quads are no edges.
  if ((vFace & 1) == 0) far.y = 1e9; else far.z = 1e9;` : ''}
  float small = 1.0 - smoothstep(0.06, 0.35, max(width.x, max(width.y, width.z)) / uPixel);
  float near = min(far.x, min(far.y, far.z));
  color *= 1.0 - uEdges * small * (1.0 - smoothstep(0.1 * uPixel, 0.9 * uPixel, near));
  ${map.faults.length > 0 ? `
  float diagonal = mod(gl_FragCoord.x + gl_FragCoord.y, 9.0 * uPixel);
  if (uFaultsShown && face.y > 0.5 && diagonal < 4.0 * uPixel) color = uFlipped;` : ''}
  if (${is('uHovered')}) color = mix(color, uAccent, 0.28);
  if (${is('uPinned')})
    color = mix(color, uAccent, max(0.4, 1.0 - smoothstep(1.5 * uPixel, 2.5 * uPixel, near)));
  ${view === 'surface'
      ? 'color *= 0.72 + 0.28 * abs(dot(normalize(vNormal), uEye));' : ''}`;
};

export function facesFragment(map, energy, picture) {
  const {shown, view, straight, improves, evaluates, liesOnSurface, isPass, quantity, flat} =
      planOf(map, picture);
  const fetch = fetched(map, straight, 'vFace');
  const points = flat ? fetch.map(flatName) : fetch;
  const evaluate = `bezier(${points.join(', ')}, xi, uv, d);`;
  return `${fetches}
${evaluates ? bezierGlsl(map, straight) : ''}
${picture.other ? bezierGlsl(picture.other, straight, 'bezierOfOther') : ''}
uniform sampler2D uRest;     // inverse of the cell's edges, times the size of uv
uniform int uHovered, uPinned;
uniform vec3 uAccent;
uniform bool uFaultsShown;
uniform float uEdges;        // how dark edges are
uniform vec3 uEye;           // direction to the eye
uniform float uPixel;        // device pixels a CSS pixel
flat in int vFace;
${flat ? `flat in vec4 vControl[${flatSize(flat)}];` : ''}
in vec2 vBary;
in ${view === 'layout' ? 'vec2 vUv' : 'vec3 vNormal'};
out vec4 fragment;
${paints(picture.other ? differenceOf(energy, picture.other.sign)
                       : quantities[quantity]?.(energy) ?? '1.0')}

void main() {
  vec3 xi = vec3(vBary, 1.0 - vBary.x - vBary.y);
  vec4 face = texelFetch(uFace, at(vFace), 0);
  vec2 uv;
  mat3x2 d;
  ${evaluates ? evaluate : ''}
  ${improves ? improvePlace(evaluate) : ''}
  ${view === 'layout' ? 'uv = vUv;' : ''}
  ${liesOnSurface
      ? 'uv = ofCorners(uCorner, vFace, xi).xy * uRestFrame.x + uRestFrame.yz;' : ''}
  ${shown.needs === 'jacobian'
      ? 'vec2 sigma = singularValues(d, texelFetch(uRest, at(vFace), 0)), other = face.zw;' : ''}
  ${picture.other && shown.needs === 'jacobian' ? `
  mat3x2 e;
  bezierOfOther(${fetched(picture.other, straight, 'vFace', 'uOther').join(', ')}, xi, uv, e);
  other = uOtherFactor * singularValues(e, texelFetch(uRest, at(vFace), 0));` : ''}
  ${isPass ? `fragment = ${shown.glsl};` : `
  vec3 color = ${shown.glsl};
  ${details(map, view)}
  fragment = vec4(color, 1.0);`}
}`;
}
