// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// The common parts of both views: cells, lines and dots with their programs, a camera that is
// dragged, and their place on the page.

import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

import * as markShaders from './mark_shaders.js';
import * as shaders from './shaders.js';
import {
  Mesh, Points, Scene, counted, dotsGeometry, drawable, linesGeometry, material,
} from './stage.js';

export class View {
  // kind: 'surface' or 'layout'; shared: data that main.js shares between views: map, energy,
  // uniforms, shown quantity. touches: the gesture of two fingers.
  constructor(kind, stage, element, camera, touches, shared) {
    Object.assign(this, {kind, stage, element, camera, shared, scene: new Scene()});
    this.uniforms = {
      ...shared.uniforms,
      uCamera: {value: camera.projectionMatrix.clone()},
      uViewport: {value: [1, 1]},
    };
    this.programs = new Map();
    this.lineList = [];
    this.addObjects();
    this.controls = new OrbitControls(camera, element);
    this.controls.touches = {ONE: null, TWO: touches};
    this.controls.addEventListener('change', () => stage.request(this));
    stage.views.push(this);
  }

  addObjects() {
    const {shared: {map, flatCells}, kind} = this;
    const lineMaterial = (straight) => material(
        markShaders.linesVertex(map, kind, straight), markShaders.linesFragment, this.uniforms);
    this.faces = this.add(Mesh, flatCells, undefined, 1, 'right');
    this.straightFaces = this.add(Mesh, flatCells, undefined, 1, 'left');
    const noLines = linesGeometry([]);
    if (kind === 'surface') {
      this.lines = [this.add(Mesh, noLines, lineMaterial(false), 2)];
    } else {
      this.lines = [this.add(Mesh, noLines, lineMaterial(false), 2, 'right'),
                    this.add(Mesh, noLines, lineMaterial(true), 2, 'left')];
    }
    this.dots = this.add(Points, dotsGeometry([]),
                         material(markShaders.dotsVertex(map, kind), markShaders.dotsFragment,
                                  this.uniforms, {transparent: true}), 3);
  }

  // part: `left` or `right` of the slider's line, or everywhere.
  add(Kind, geometry, itsMaterial, order, part = 'whole') {
    const object = drawable(Kind, geometry, itsMaterial, order);
    object.userData.part = part;
    object.onBeforeRender = (renderer) => renderer.setScissor(...this.clips[part]);
    this.scene.add(object);
    return object;
  }

  // Returns the program of the cells for a picture (shaders.js), made when it is first shown.
  programOf(picture) {
    const {map, energy} = this.shared;
    const key = JSON.stringify(picture);
    if (!this.programs.has(key)) {
      const ofView = {...picture, view: this.kind};
      this.programs.set(key, material(shaders.facesVertex(map, ofView),
                                      shaders.facesFragment(map, energy, ofView), this.uniforms,
                                      this.kind === 'layout' ? counted : {}));
    }
    return this.programs.get(key);
  }

  setLines(lines) {
    this.lineList = lines;
    const geometry = linesGeometry(lines, (face) => this.cut?.pieces[face] ?? 1);
    this.lines[0].geometry.dispose();
    for (const object of this.lines) object.geometry = geometry;
  }

  setDots(dots) {
    this.dots.geometry.dispose();
    this.dots.geometry = dotsGeometry(dots);
  }

  // Takes finer or coarser geometry after the camera has moved; the surface always has flat
  // triangles. height: in device pixels.
  refine() {}

  // Prepares drawing into a rectangle of the target. pass: draws only cells (shaders.js), instead
  // of the page's picture.
  prepare({x, y, width, height, pixel}, pass = null) {
    this.fit(width, height);
    this.refine(height * pixel);
    this.camera.updateMatrixWorld();
    this.uniforms.uCamera.value.multiplyMatrices(this.camera.projectionMatrix,
                                                 this.camera.matrixWorldInverse);
    this.uniforms.uViewport.value = [width * pixel, height * pixel];
    this.uniforms.uPixel.value = pixel;
    const eye = this.camera.position.clone().sub(this.controls.target).normalize();
    this.uniforms.uEye.value = [eye.x, eye.y, eye.z];
    const line = pass ? 0 : Math.round(this.shared.state.wipe * width * pixel) / pixel;
    this.clips = {
      whole: [x, y, width, height],
      left: [x, y, line, height],
      right: [x + line, y, width - line, height],
    };
    this.choose(pass);
  }

  // Chooses the objects to draw, and the picture of the cells.
  choose(pass) {
    const {state, picture} = this.shared;
    const shown = pass ? {...picture, name: pass} : picture;
    const isCoarse = this.cut?.areCoarse ?? false;
    this.faces.material = this.programOf({...shown, straight: false, isCoarse});
    for (const object of this.scene.children)
      object.visible = (!pass || object === this.faces) && this.clips[object.userData.part][2] > 0;
    if (this.straightFaces.visible)
      this.straightFaces.material = this.programOf({...shown, straight: true});
    for (const object of this.lines) object.visible &&= this.lineList.length > 0;
    this.dots.visible &&= this.dots.geometry.attributes.position.count > 0;
    if (this.scaffold) this.scaffold.visible &&= state.scaffold;
    if (this.hatch) this.hatch.visible &&= state.overlaps;
  }

  // Returns the part of the height without captions, above or as much below.
  get openShare() {
    const caption = this.element.querySelector('.caption');
    if (!caption) return 1;
    const covered = caption.offsetTop + caption.offsetHeight;
    return Math.max(0.5, 1 - 2 * covered / this.element.offsetHeight);
  }

  // Makes an orthographic camera whose open height at zoom 1 is `extent`, or its width if that is
  // less.
  fit(width, height) {
    const {camera} = this;
    const half = 0.5 * this.extent * Math.max(1 / this.openShare, height / width);
    camera.top = half;
    camera.bottom = -half;
    camera.right = half * width / height;
    camera.left = -camera.right;
    camera.updateProjectionMatrix();
  }

  // Returns the position in the element, -1 to 1, y up.
  deviceCoordinates(event) {
    const box = this.element.getBoundingClientRect();
    return [2 * (event.clientX - box.left) / box.width - 1,
            1 - 2 * (event.clientY - box.top) / box.height];
  }

  // Returns where a place {face, xi} is shown, in halves of the view's height, y up.
  onScreen(place) {
    const p = this.pointAt(place).project(this.camera);
    return [p.x * this.camera.right / this.camera.top, p.y];
  }

  pickMiddle() {
    const box = this.element.getBoundingClientRect();
    return this.pick({clientX: box.left + box.width / 2, clientY: box.top + box.height / 2});
  }

  zoomBy(factor) {
    const {minZoom, maxZoom} = this.controls;
    this.camera.zoom = Math.min(maxZoom, Math.max(minZoom, this.camera.zoom * factor));
    this.controls.update();
    this.controls.dispatchEvent({type: 'change'});
  }

  // Returns whether the view has changed since the beginning.
  wasMoved() { return this.pose().join() !== this.homePose.join(); }
}
