// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// One WebGL canvas with two views, drawn after changes: scenes, cameras, render passes.

import {
  AlwaysStencilFunc, BufferAttribute, BufferGeometry, Color, DoubleSide, Float32BufferAttribute,
  GLSL3, IncrementStencilOp, LessStencilFunc, Mesh, Points, RawShaderMaterial, Scene, WebGLRenderer,
  WebGLRenderTarget,
} from 'three';

// Everything is one long list, since software renderers draw instances one by one.
function indexedGeometry(attributes, indices) {
  const geometry = new BufferGeometry();
  for (const [name, [values, size]] of Object.entries(attributes))
    geometry.setAttribute(name, new BufferAttribute(values, size));
  geometry.setIndex(new BufferAttribute(indices, 1));
  return geometry;
}

// Divides a triangle into k * k: barycentric coordinates of vertices, and triangles. Vertices on
// edges 01, 12, 20 move to the next of `ends` pieces there, fewer than k if the other side has
// fewer.
function lattice(k, ends) {
  const places = [], triangles = [];
  const number = (i, j) => i * (k + 1) - (i * (i - 1)) / 2 + j;
  const next = (x, edge) => Math.round(x * ends[edge] / k) / ends[edge];
  for (let i = 0; i <= k; ++i)
    for (let j = 0; j <= k - i; ++j) {
      let place = [i / k, j / k];
      if (i + j === k) place = [next(i, 0), 1 - next(i, 0)];
      else if (i === 0) place = [0, next(j, 1)];
      else if (j === 0) place = [next(i, 2), 0];
      places.push(...place);
      if (i + j < k) triangles.push(number(i + 1, j), number(i, j + 1), number(i, j));
      if (i + j < k - 1) triangles.push(number(i, j + 1), number(i + 1, j), number(i + 1, j + 1));
    }
  return {places, triangles};
}

// Returns cells as triangles divided into pieces (chords.js): vertices are (cell, first two
// barycentric coordinates). Cells of `top` are drawn over others.
export function cellsGeometry({pieces, edges}, top) {
  const lattices = new Map();
  const ofCells = Array.from(pieces, (k, cell) => {
    const [a, b, c] = [edges[3 * cell], edges[3 * cell + 1], edges[3 * cell + 2]];
    const key = k + 2 ** 8 * a + 2 ** 16 * b + 2 ** 24 * c;
    if (!lattices.has(key)) lattices.set(key, lattice(k, [a, b, c]));
    return lattices.get(key);
  });
  const sum = (sizeOf) => ofCells.reduce((total, one) => total + sizeOf(one), 0);
  const vertices = new Float32Array(sum(({places}) => 1.5 * places.length));
  const indices = new Uint32Array(sum(({triangles}) => triangles.length));
  let vertex = 0, index = 0;
  const add = (cell) => {
    const {places, triangles} = ofCells[cell];
    for (let k = 0; k < triangles.length; ++k) indices[index++] = vertex + triangles[k];
    for (let at = 0; at < places.length; at += 2, ++vertex) {
      vertices[3 * vertex] = cell;
      vertices[3 * vertex + 1] = places[at];
      vertices[3 * vertex + 2] = places[at + 1];
    }
  };
  for (let cell = 0; cell < pieces.length; ++cell) if (!top.has(cell)) add(cell);
  top.forEach(add);
  return indexedGeometry({position: [vertices, 3]}, indices);
}

// Returns every cell as one triangle.
export const flatGeometry = (count, top = new Set()) => cellsGeometry(
    {pieces: new Uint8Array(count).fill(1), edges: new Uint8Array(3 * count).fill(1)}, top);

// lines: [{face, edge, width, corner, tint, target}] as in mark_shaders.js, drawn as bands of
// piecesOf(face) pieces each.
export function linesGeometry(lines, piecesOf) {
  const positions = [], targets = [], tints = [], places = [], indices = [];
  for (const {face, edge, width, corner, tint, target} of lines) {
    const pieces = piecesOf(face);
    const first = positions.length / 3;
    for (let k = 0; k <= pieces; ++k)
      for (const side of [-1, 1]) {
        positions.push(k / pieces, side, width);
        places.push(face, edge, corner ?? 0);
        tints.push(...tint);
        targets.push(...[0, 1, 2, 3].map((d) => target?.[d] ?? 0));
      }
    for (let k = first; k < first + 2 * pieces; k += 2)
      indices.push(k, k + 2, k + 3, k, k + 3, k + 1);
  }
  const floats = (values, size) => [Float32Array.from(values), size];
  return indexedGeometry({
    position: floats(positions, 3), line: floats(places, 3), tint: floats(tints, 3),
    target: floats(targets, 4),
  }, Uint32Array.from(indices));
}

// dots: [{face, xi, radius, tint}].
export function dotsGeometry(dots) {
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new Float32BufferAttribute(
      dots.flatMap((dot) => [dot.face, dot.xi[0], dot.xi[1]]), 3));
  geometry.setAttribute('disc', new Float32BufferAttribute(
      dots.flatMap((dot) => [dot.radius, ...dot.tint]), 4));
  return geometry;
}

export function material(vertexShader, fragmentShader, uniforms, options = {}) {
  return new RawShaderMaterial({
    glslVersion: GLSL3, vertexShader, fragmentShader, uniforms, side: DoubleSide, ...options,
  });
}

// Makes a Mesh or Points. Culling is off, since geometry comes from textures.
export function drawable(Kind, geometry, itsMaterial, order) {
  const object = new Kind(geometry, itsMaterial);
  object.frustumCulled = false;
  object.renderOrder = order;
  return object;
}

// Options of materials that count how often each sample is covered, and that draw where this is
// more than once.
export const counted = {
  stencilWrite: true, stencilFunc: AlwaysStencilFunc, stencilZPass: IncrementStencilOp,
};
export const whereCoveredTwice = {
  stencilWrite: true, stencilFunc: LessStencilFunc, stencilRef: 1, transparent: true,
  depthTest: false, depthWrite: false,
};
// A triangle that covers the window.
export const windowGeometry = () => indexedGeometry(
    {position: [Float32Array.of(-1, -1, 0, 3, -1, 0, -1, 3, 0), 3]}, Uint32Array.of(0, 1, 2));

export {Mesh, Points, Scene};

export class Stage {
  // canvas: covers all views. views: see view.js.
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({canvas, antialias: true, alpha: true, stencil: true,
                                       preserveDrawingBuffer: true});
    this.renderer.info.autoReset = false;
    this.renderer.setClearColor(new Color(0, 0, 0), 0);
    this.views = [];
    this.waiting = false;
    this.drawCalls = 0;
    canvas.addEventListener('webglcontextrestored', () => this.request());
  }

  // Draws one view, or all, before the next frame.
  request(view = null) {
    for (const other of this.views) other.isOld ||= !view || other === view;
    if (this.waiting) return;
    this.waiting = true;
    requestAnimationFrame(() => {
      this.waiting = false;
      this.render(this.views.filter((other) => other.isOld));
    });
  }

  resize() {
    const {width, height} = this.canvas.parentElement.getBoundingClientRect();
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio || 1, 2));
    this.renderer.setSize(width, height, false);
    this.request();
  }

  // Returns the rectangle in CSS pixels from the lower left corner of the canvas.
  rectangleOf(view) {
    const outer = this.canvas.getBoundingClientRect();
    const inner = view.element.getBoundingClientRect();
    return {x: inner.left - outer.left, y: outer.bottom - inner.bottom, width: inner.width,
            height: inner.height, pixel: this.renderer.getPixelRatio()};
  }

  render(views = this.views) {
    const {renderer} = this;
    renderer.info.reset();
    renderer.setScissorTest(true);
    for (const view of views) {
      view.isOld = false;
      const rectangle = this.rectangleOf(view);
      const {x, y, width, height} = rectangle;
      if (width < 1 || height < 1) continue;
      renderer.setViewport(x, y, width, height);
      renderer.setScissor(x, y, width, height);
      renderer.clear();
      view.prepare(rectangle);
      renderer.render(view.scene, view.camera);
    }
    this.drawCalls = renderer.info.render.calls;
  }

  // Returns the result of act() while all views are drawn with this number of device pixels per CSS
  // pixel, or the largest that the graphics card allows.
  drawnAt(pixelRatio, act) {
    const {renderer} = this;
    const {width, height} = this.canvas.parentElement.getBoundingClientRect();
    const most = renderer.capabilities.maxTextureSize / Math.max(width, height);
    const usual = renderer.getPixelRatio();
    const setRatio = (ratio) => {
      renderer.setPixelRatio(ratio);
      renderer.setSize(width, height, false);
      this.render();
    };
    setRatio(Math.min(pixelRatio, most));
    try {
      return act();
    } finally {
      setRatio(usual);
    }
  }

  // Draws the view with another picture (shaders.js), one texel a CSS pixel, and reads it back:
  // bytes r, g, b, a by rows from below. Only cells are drawn, without antialiasing.
  readPass(view, picture, width, height) {
    const {renderer} = this;
    const target = new WebGLRenderTarget(width, height);
    view.prepare({x: 0, y: 0, width, height, pixel: 1}, picture);
    renderer.setScissorTest(false);
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(view.scene, view.camera);
    const bytes = new Uint8Array(4 * width * height);
    renderer.readRenderTargetPixels(target, 0, 0, width, height, bytes);
    renderer.setRenderTarget(null);
    target.dispose();
    this.request();
    return bytes;
  }
}
