// The programs that draw a map, for its degree and energy. Geometry is no attribute: cells are
// numbers, and everything about them is fetched from data textures (textures.js), so that a
// fragment can evaluate the Bezier triangle it lies in.

import {localIndex, multiIndices, multinomial} from './bezier.js';
import {densityGlsl} from './energies.js';
import {kTextureWidth} from './textures.js';

// What fragments show: numbers of uMode.
export const modes = {
  checker: 0, grid: 1, image: 2, heat: 3, chart: 4,
  uvPass: 10, facePass: 11, baryPass: 12, quantityPass: 13,
};
// Numbers of uQuantity.
export const quantityNumbers = {
  'density': 0, 'area': 1, 'angle': 2, 'sigma-max': 3, 'sigma-min': 4,
};

// void bezier(face, xi, value, d0, d1, d2): the map and its derivatives by the barycentric
// coordinates, unrolled: sums over the control points, each with its three Bernstein polynomials of
// degree n - 1.
function bezierGlsl(n, size) {
  const lower = multiIndices(n - 1);
  const power = (name, e) => (e === 0 ? [] : [e === 1 ? name : `${name}${e}`]);
  const lines = [];
  for (const name of ['a', 'b', 'c'])
    for (let e = 2; e < n; ++e)
      lines.push(`float ${name}${e} = ${e === 2 ? name : name + (e - 1)} * ${name};`);
  lower.forEach(([i, j, k], l) => {
    const factors = [`${multinomial(i, j, k)}.0`, ...power('a', i), ...power('b', j),
                     ...power('c', k)];
    lines.push(`float w${l} = ${factors.join(' * ')};`);
  });
  lines.push('vec2 q0 = vec2(0.0), q1 = vec2(0.0), q2 = vec2(0.0), p;');
  multiIndices(n).forEach(([i, j, k], l) => {
    lines.push(`p = texelFetch(uControl, at(face * ${size} + ${l}), 0).xy;`);
    if (i > 0) lines.push(`q0 += w${localIndex(n - 1, i - 1, j)} * p;`);
    if (j > 0) lines.push(`q1 += w${localIndex(n - 1, i, j - 1)} * p;`);
    if (k > 0) lines.push(`q2 += w${localIndex(n - 1, i, j)} * p;`);
  });
  const corners = [0, size - n - 1, size - 1];
  return `
void bezier(int face, vec3 xi, bool straight, out vec2 value, out mat3x2 d) {
  if (straight) {
    ${corners.map((l, c) =>
      `d[${c}] = texelFetch(uControl, at(face * ${size} + ${l}), 0).xy;`).join('\n    ')}
    value = d * xi;
    return;
  }
  float a = xi.x, b = xi.y, c = xi.z;
  ${lines.join('\n  ')}
  value = a * q0 + b * q1 + c * q2;
  d = ${n}.0 * mat3x2(q0, q1, q2);
}`;
}

const common = (map) => `
precision highp float;
precision highp int;
precision highp sampler2D;
uniform sampler2D uControl;  // (uv - center) / size, by cell and local index
uniform sampler2D uCorner;   // positions in the frame of the view, by cell and corner
uniform sampler2D uFace;     // chart, fault (0, 1), edges on a cut
ivec2 at(int i) { return ivec2(i % ${kTextureWidth}, i / ${kTextureWidth}); }
${bezierGlsl(map.degree, map.size)}
vec3 positionAt(int face, vec3 xi) {
  return texelFetch(uCorner, at(3 * face), 0).xyz * xi.x +
         texelFetch(uCorner, at(3 * face + 1), 0).xyz * xi.y +
         texelFetch(uCorner, at(3 * face + 2), 0).xyz * xi.z;
}`;

// A point of a cell in clip space.
const place = (view) => view === 'surface' ? `
uniform mat4 uCamera;
uniform bool uStraight;
vec4 placeAt(int face, vec3 xi) { return uCamera * vec4(positionAt(face, xi), 1.0); }` : `
uniform mat4 uCamera;
uniform bool uStraight;
vec4 placeAt(int face, vec3 xi) {
  vec2 uv;
  mat3x2 d;
  bezier(face, xi, uStraight, uv, d);
  return uCamera * vec4(uv, 0.0, 1.0);
}`;

export const facesVertex = (map, view) => `${common(map)}${place(view)}
uniform sampler2D uNormal;
in vec3 position;  // cell, first two barycentric coordinates
flat out int vFace;
out vec2 vBary, vUv;
out vec3 vNormal;
void main() {
  vFace = int(position.x);
  vBary = position.yz;
  vec3 xi = vec3(vBary, 1.0 - vBary.x - vBary.y);
  mat3x2 d;
  ${view === 'layout' ? 'bezier(vFace, xi, uStraight, vUv, d);' : 'vUv = vec2(0.0);'}
  vNormal = texelFetch(uNormal, at(3 * vFace), 0).xyz * xi.x +
            texelFetch(uNormal, at(3 * vFace + 1), 0).xyz * xi.y +
            texelFetch(uNormal, at(3 * vFace + 2), 0).xyz * xi.z;
  gl_Position = ${view === 'layout' ? 'uCamera * vec4(vUv, 0.0, 1.0)'
                                    : 'placeAt(vFace, xi)'};
}`;

// The layout is drawn in flat pieces: the fragment is exactly at vUv, but xi is interpolated over
// a piece. A step of Newton's method makes it that of vUv.
const improvePlace = `
  vec2 e = d[0] - d[2], f = d[1] - d[2], off = vUv - uv;
  float det = e.x * f.y - e.y * f.x;
  vec2 step = vec2(off.x * f.y - off.y * f.x, off.y * e.x - off.x * e.y) / det;
  if (abs(det) > 0.0 && max(abs(step.x), abs(step.y)) < 0.25) {
    xi += vec3(step, -step.x - step.y);
    bezier(vFace, xi, straight, uv, d);
  }
  uv = vUv;`;

export const facesFragment = (map, energy, view) => `${common(map)}
uniform sampler2D uRest;     // inverse of the cell's edges, times the size of uv
uniform sampler2D uColors;   // the scale, 256 colours
uniform sampler2D uImage;
uniform sampler2D uTints;    // of charts
uniform bool uStraight;
uniform int uMode, uQuantity, uHovered, uPinned;
uniform float uWipe;         // left of it, in pixels: the straight map
uniform vec4 uScale;         // 1 for diverging; log s(low), log s(high); neutral
uniform float uUnit;         // of the scale
uniform vec2 uBrush;         // positions on the scale that are selected
uniform vec3 uChecker;       // cells along the size of uv, phase of u and v
uniform vec3 uImageFrame;    // likewise of the image
uniform vec3 uAccent, uFlipped;
uniform bool uFaultsShown;
uniform float uEdges;        // how dark edges are
uniform vec3 uEye;           // direction to the eye
uniform float uPixel;        // device pixels a CSS pixel
flat in int vFace;
in vec2 vBary, vUv;
in vec3 vNormal;
out vec4 fragment;

vec2 singularValues(mat3x2 d, vec4 rest) {
  vec2 e = d[0] - d[2], f = d[1] - d[2];
  vec2 x = e * rest.x + f * rest.z, y = e * rest.y + f * rest.w;
  float alpha = 0.5 * length(vec2(x.x + y.y, x.y - y.x));
  float beta = 0.5 * length(vec2(x.x - y.y, x.y + y.x));
  return vec2(alpha + beta, alpha - beta);
}

float quantity(float S, float s) {
  if (uQuantity == 1) return S * s;
  if (uQuantity == 2) return S / s;
  if (uQuantity == 3) return S;
  if (uQuantity == 4) return s;
  return ${energy ? densityGlsl(energy) : 'S * s'};
}

float scalePosition(float value) {
  if (uScale.x < 0.5) {
    float t = log(max(1.0 + (value - uScale.w) / uUnit, 1e-30));
    return clamp((t - uScale.y) / (uScale.z - uScale.y), 0.0, 1.0);
  }
  float t = log(max(value / uScale.w, 1e-30));
  return clamp(t < 0.0 ? 0.5 - 0.5 * t / uScale.y : 0.5 + 0.5 * t / uScale.z, 0.0, 1.0);
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
}

void main() {
  bool straight = gl_FragCoord.x < uWipe;
  ${view === 'layout' ? 'if (straight != uStraight) discard;' : ''}
  vec3 xi = vec3(vBary, 1.0 - vBary.x - vBary.y);
  vec2 uv;
  mat3x2 d;
  bezier(vFace, xi, straight, uv, d);
  ${view === 'layout' && map.degree > 1 ? improvePlace : ''}
  vec2 sigma = singularValues(d, texelFetch(uRest, at(vFace), 0));
  bool flipped = !(sigma.y > 0.0);
  float value = quantity(sigma.x, sigma.y);
  float position = scalePosition(value);
  // Passes that are read back.
  if (uMode == ${modes.uvPass}) { fragment = packed(uv + 0.5); return; }
  if (uMode == ${modes.baryPass}) { fragment = packed(xi.xy); return; }
  if (uMode == ${modes.facePass}) {
    int id = vFace + 1;
    fragment = vec4(vec3(id >> 16 & 255, id >> 8 & 255, id & 255) / 255.0, 1.0);
    return;
  }
  if (uMode == ${modes.quantityPass}) {
    fragment = flipped ? vec4(0.0) : packed(vec2(position, 1.0));
    return;
  }
  vec4 face = texelFetch(uFace, at(vFace), 0);
  vec3 color = vec3(0.86);
  if (uMode == ${modes.checker}) color = checker(uv);
  if (uMode == ${modes.grid}) color = grid(uv);
  if (uMode == ${modes.image}) color = texture(uImage, uv * uImageFrame.x + uImageFrame.yz).rgb;
  if (uMode == ${modes.chart})
    color = mix(vec3(1.0), texelFetch(uTints, ivec2(int(face.x), 0), 0).rgb, 0.55);
  if (uMode == ${modes.heat})
    color = flipped ? uFlipped : texture(uColors, vec2((position * 255.0 + 0.5) / 256.0, 0.5)).rgb;
  if (flipped ? uBrush.x > 0.0 : position < uBrush.x || position > uBrush.y)
    color = mix(vec3(0.62), vec3(dot(color, vec3(0.3, 0.59, 0.11))), 0.25);
  // Edges, thinner where triangles are small.
  vec3 width = fwidth(xi);
  vec3 far = abs(xi) / max(width, 1e-9);
  float small = 1.0 - smoothstep(0.06, 0.35, max(width.x, max(width.y, width.z)) / uPixel);
  float near = min(far.x, min(far.y, far.z));
  color *= 1.0 - uEdges * small * (1.0 - smoothstep(0.1 * uPixel, 0.9 * uPixel, near));
  float diagonal = mod(gl_FragCoord.x + gl_FragCoord.y, 9.0 * uPixel);
  if (uFaultsShown && face.y > 0.5 && diagonal < 4.0 * uPixel) color = uFlipped;
  if (vFace == uHovered) color = mix(color, uAccent, 0.28);
  if (vFace == uPinned)
    color = mix(color, uAccent, max(0.4, 1.0 - smoothstep(1.5 * uPixel, 2.5 * uPixel, near)));
  ${view === 'surface'
      ? 'color *= 0.72 + 0.28 * abs(dot(normalize(vNormal), uEye));' : ''}
  fragment = vec4(color, 1.0);
}`;

// Bands of constant width in pixels along edges of cells, or from a point to its target.
export const linesVertex = (map, view) => `${common(map)}${place(view)}
uniform vec2 uViewport;  // in pixels
uniform float uPixel;
in vec3 position;  // t along the line, side -1 or 1
in vec4 line;      // cell; edge 0 (01), 1 (12), 2 (20), or 3: corner to target; width; corner
in vec3 tint;
in vec2 target;
out vec3 vTint;
vec3 along(float t, int edge) {
  if (edge == 0) return vec3(1.0 - t, t, 0.0);
  return edge == 1 ? vec3(0.0, 1.0 - t, t) : vec3(t, 0.0, 1.0 - t);
}
vec4 pointAt(float t) {
  int face = int(line.x), edge = int(line.y), corner = int(line.w);
  if (edge < 3) return placeAt(face, along(t, edge));
  vec4 from = placeAt(face, vec3(corner == 0, corner == 1, corner == 2));
  return ${view === 'surface' ? 'from' : 'mix(from, uCamera * vec4(target, 0.0, 1.0), t)'};
}
void main() {
  vTint = tint;
  vec4 here = pointAt(position.x);
  vec4 before = pointAt(position.x - 0.02), after = pointAt(position.x + 0.02);
  vec2 way = (after.xy / after.w - before.xy / before.w) * uViewport;
  vec2 across = length(way) > 0.0 ? normalize(vec2(-way.y, way.x)) : vec2(0.0);
  here.xy += across * position.y * line.z * uPixel / uViewport * here.w;
  ${view === 'surface' ? 'here.z -= 2e-3 * here.w;' : ''}
  gl_Position = here;
}`;

export const linesFragment = (view) => `
precision highp float;
uniform float uWipe;
uniform bool uStraight;
in vec3 vTint;
out vec4 fragment;
void main() {
  ${view === 'layout' ? 'if ((gl_FragCoord.x < uWipe) != uStraight) discard;' : ''}
  fragment = vec4(vTint, 1.0);
}`;

// Discs at points of cells.
export const dotsVertex = (map, view) => `${common(map)}${place(view)}
uniform float uPixel;
in vec3 position;  // cell, first two barycentric coordinates
in vec4 disc;      // radius in pixels, tint; radius 0 hides
out vec3 vTint;
out float vRadius;
void main() {
  vTint = disc.yzw;
  vRadius = disc.x * uPixel;
  vec3 xi = vec3(position.yz, 1.0 - position.y - position.z);
  gl_Position = placeAt(int(position.x), xi);
  ${view === 'surface' ? 'gl_Position.z -= 4e-3 * gl_Position.w;' : ''}
  gl_PointSize = 2.0 * vRadius + 2.0;
  if (disc.x == 0.0) gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
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

// The space around the image.
export const scaffoldVertex = (scaffold) => `${common(scaffold)}${place('layout')}
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
