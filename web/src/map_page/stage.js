// One WebGL canvas with two views, drawn when something changed: scenes, cameras, render passes.

import {
  BufferAttribute, BufferGeometry, Color, DoubleSide, Float32BufferAttribute, GLSL3,
  InstancedBufferAttribute, InstancedBufferGeometry, Mesh, Points, RawShaderMaterial, Scene,
  WebGLRenderer, WebGLRenderTarget,
} from 'three';

import {modes} from './shaders.js';

// Every cell as a triangle cut into k * k: vertices are (cell, first two barycentric coordinates).
// One long list, as renderers in software take instances one by one.
export function latticeGeometry(k, cells) {
  const places = [], triangles = [];
  const number = (i, j) => i * (k + 1) - (i * (i - 1)) / 2 + j;
  for (let i = 0; i <= k; ++i)
    for (let j = 0; j <= k - i; ++j) {
      places.push([i / k, j / k]);
      if (i + j < k) triangles.push(number(i + 1, j), number(i, j + 1), number(i, j));
      if (i + j < k - 1) triangles.push(number(i, j + 1), number(i + 1, j), number(i + 1, j + 1));
    }
  const vertices = new Float32Array(3 * places.length * cells);
  const indices = new Uint32Array(triangles.length * cells);
  for (let cell = 0; cell < cells; ++cell) {
    places.forEach(([a, b], at) => vertices.set([cell, a, b], 3 * (cell * places.length + at)));
    triangles.forEach((vertex, at) => {
      indices[cell * triangles.length + at] = cell * places.length + vertex;
    });
  }
  const geometry = new BufferGeometry();
  geometry.setAttribute('position', new BufferAttribute(vertices, 3));
  geometry.setIndex(new BufferAttribute(indices, 1));
  return geometry;
}

// lines: [{face, edge, width, corner, tint, target}], of `pieces` pieces each.
export function linesGeometry(lines, pieces) {
  const corners = [];
  for (let k = 0; k < pieces; ++k) {
    const [t, s] = [k / pieces, (k + 1) / pieces];
    corners.push(t, -1, 0, s, -1, 0, s, 1, 0, t, -1, 0, s, 1, 0, t, 1, 0);
  }
  const geometry = new InstancedBufferGeometry();
  const add = (name, size, valueOf) => geometry.setAttribute(
      name, new InstancedBufferAttribute(new Float32Array(lines.flatMap(valueOf)), size));
  geometry.setAttribute('position', new Float32BufferAttribute(corners, 3));
  add('line', 4, (l) => [l.face, l.edge, l.width, l.corner ?? 0]);
  add('tint', 3, (l) => l.tint);
  add('target', 2, (l) => l.target ?? [0, 0]);
  geometry.instanceCount = lines.length;
  return geometry;
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

// Of what kind: Mesh or Points; culling is off, as geometry comes from textures.
export function drawable(Kind, geometry, itsMaterial, order) {
  const object = new Kind(geometry, itsMaterial);
  object.frustumCulled = false;
  object.renderOrder = order;
  return object;
}

export {Mesh, Points, Scene};

export class Stage {
  // canvas: covers all views. views: see view.js.
  constructor(canvas) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({canvas, antialias: true, alpha: true,
                                       preserveDrawingBuffer: true});
    this.renderer.info.autoReset = false;
    this.renderer.setClearColor(new Color(0, 0, 0), 0);
    this.views = [];
    this.waiting = false;
    this.drawCalls = 0;
    canvas.addEventListener('webglcontextrestored', () => this.request());
  }

  // Draws before the next frame is shown: one view, or all.
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

  // In CSS pixels from the upper left corner of the canvas.
  rectangleOf(view) {
    const outer = this.canvas.getBoundingClientRect();
    const inner = view.element.getBoundingClientRect();
    return {x: inner.left - outer.left, y: inner.top - outer.top,
            width: inner.width, height: inner.height, total: outer.height};
  }

  render(views = this.views) {
    const {renderer} = this;
    renderer.info.reset();
    renderer.setScissorTest(true);
    for (const view of views) {
      view.isOld = false;
      const {x, y, width, height, total} = this.rectangleOf(view);
      if (width < 1 || height < 1) continue;
      renderer.setViewport(x, total - y - height, width, height);
      renderer.setScissor(x, total - y - height, width, height);
      view.prepare({left: x * renderer.getPixelRatio(), width, height,
                    pixel: renderer.getPixelRatio()});
      renderer.clear();
      renderer.render(view.scene, view.camera);
    }
    this.drawCalls = renderer.info.render.calls;
  }

  // The view drawn in another mode, one texel a CSS pixel, read back: bytes r, g, b, a by rows from
  // below. Only cells are drawn, without antialiasing.
  readPass(view, mode, width, height) {
    const {renderer} = this;
    const target = new WebGLRenderTarget(width, height);
    const marks = view.scene.children.filter((child) => child !== view.faces && child.visible);
    for (const mark of marks) mark.visible = false;
    const {uMode} = view.faces.material.uniforms;
    const shown = uMode.value;
    uMode.value = modes[mode];
    view.prepare({left: 0, width, height, pixel: 1});
    view.faces.material.uniforms.uWipe.value = -1;
    renderer.setScissorTest(false);
    renderer.setRenderTarget(target);
    renderer.clear();
    renderer.render(view.scene, view.camera);
    const bytes = new Uint8Array(4 * width * height);
    renderer.readRenderTargetPixels(target, 0, 0, width, height, bytes);
    renderer.setRenderTarget(null);
    target.dispose();
    uMode.value = shown;
    for (const mark of marks) mark.visible = true;
    this.request();
    return bytes;
  }
}
