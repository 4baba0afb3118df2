// What both views are made of: cells, lines and dots with their programs, a camera that is dragged,
// and the place on the page that shows it.

import {OrbitControls} from 'three/addons/controls/OrbitControls.js';

import * as shaders from './shaders.js';
import {Mesh, Points, Scene, dotsGeometry, drawable, latticeGeometry, linesGeometry,
        material} from './stage.js';

const kPieces = [1, 2, 3, 4, 6, 8, 12];  // of curved edges
const kChord = 5;            // CSS pixels
const kMostTriangles = 1e6;
const kLinePieces = 8;       // of curved outlines
const kUsualHeight = 600;    // CSS pixels

export class View {
  // kind: 'surface' or 'layout'; scene: what main.js shares between views: map, energy, uniforms.
  constructor(kind, stage, element, camera, shared) {
    Object.assign(this, {kind, stage, element, camera, shared, scene: new Scene()});
    this.uniforms = {
      ...shared.uniforms,
      uCamera: {value: camera.projectionMatrix.clone()},
      uStraight: {value: false},
      uWipe: {value: -1},
      uViewport: {value: [1, 1]},
    };
    this.straight = {...this.uniforms, uStraight: {value: true}};
    const {map, energy} = shared;
    const faces = latticeGeometry(1, map.faceCount);
    const faceMaterial = (uniforms) => material(
        shaders.facesVertex(map, kind), shaders.facesFragment(map, energy, kind), uniforms);
    this.faces = this.add(drawable(Mesh, faces, faceMaterial(this.uniforms), 1));
    if (kind === 'layout')
      this.straightFaces = this.add(drawable(Mesh, faces, faceMaterial(this.straight), 1));
    this.controls = new OrbitControls(camera, element);
    this.controls.addEventListener('change', () => stage.request(this));
    stage.views.push(this);
  }

  // Along the edges of cells, so that chords are a few pixels long: more where the view is closer.
  piecesOf({degree, faceCount}, height = kUsualHeight) {
    if (this.kind === 'surface' || degree === 1) return 1;
    const cell = height * this.camera.zoom / Math.sqrt(faceCount);
    return kPieces.findLast((pieces) => pieces * kChord < 2 * cell &&
                                        pieces * pieces * faceCount < kMostTriangles) ?? 1;
  }

  // Takes finer or coarser geometry where the camera has come closer or gone away.
  refine(height) {
    for (const [plane, objects] of [[this.shared.map, [this.faces, this.straightFaces]],
                                    [this.shared.map.scaffold, [this.scaffold]]]) {
      if (!plane || !objects[0]) continue;
      const pieces = this.piecesOf(plane, height);
      for (const object of objects) {
        if (!object || object.userData.pieces === pieces) continue;
        object.userData.pieces = pieces;
        const geometry = latticeGeometry(pieces, plane.faceCount);
        object.geometry.dispose();
        object.geometry = geometry;
      }
    }
  }

  add(object) {
    this.scene.add(object);
    return object;
  }

  setLines(lines) {
    const {map} = this.shared;
    const pieces = this.kind === 'surface' || map.degree === 1 ? 1 : kLinePieces;
    for (const old of [this.lines, this.straightLines]) if (old) this.scene.remove(old);
    this.lines = this.straightLines = null;
    if (lines.length === 0) return;
    const geometry = linesGeometry(lines, pieces);
    const lineMaterial = (uniforms) => material(
        shaders.linesVertex(map, this.kind), shaders.linesFragment(this.kind), uniforms);
    this.lines = this.add(drawable(Mesh, geometry, lineMaterial(this.uniforms), 2));
    if (this.kind === 'layout')
      this.straightLines = this.add(drawable(Mesh, geometry, lineMaterial(this.straight), 2));
  }

  setDots(dots) {
    if (this.dots) this.scene.remove(this.dots);
    this.dots = null;
    if (dots.length === 0) return;
    const {map} = this.shared;
    this.dots = this.add(drawable(
        Points, dotsGeometry(dots),
        material(shaders.dotsVertex(map, this.kind), shaders.dotsFragment, this.uniforms,
                 {transparent: true}), 3));
  }

  // Before it is drawn into a rectangle that begins `left` device pixels from the target's edge.
  prepare({left, width, height, pixel}) {
    this.fit(width, height);
    this.refine(height);
    this.camera.updateMatrixWorld();
    this.uniforms.uCamera.value.multiplyMatrices(this.camera.projectionMatrix,
                                                 this.camera.matrixWorldInverse);
    const {wipe} = this.shared;
    this.uniforms.uWipe.value = wipe > 0 ? left + wipe * width * pixel : -1;
    this.uniforms.uViewport.value = [width * pixel, height * pixel];
    this.uniforms.uPixel.value = pixel;
    for (const object of [this.straightFaces, this.straightLines])
      if (object) object.visible = wipe > 0;
    const eye = this.camera.position.clone().sub(this.controls.target).normalize();
    this.uniforms.uEye.value = [eye.x, eye.y, eye.z];
  }

  // An orthographic camera whose height at zoom 1 is `extent`, or its width where that is less.
  fit(width, height) {
    const {camera} = this;
    const half = 0.5 * this.extent * Math.max(1, height / width);
    camera.top = half;
    camera.bottom = -half;
    camera.right = half * width / height;
    camera.left = -camera.right;
    camera.updateProjectionMatrix();
  }

  // Where in the element, -1 to 1, y up.
  deviceCoordinates(event) {
    const box = this.element.getBoundingClientRect();
    return [2 * (event.clientX - box.left) / box.width - 1,
            1 - 2 * (event.clientY - box.top) / box.height];
  }

  // Where a place {face, xi} is shown, in halves of the view's height, y up.
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

  // Whether it shows something else than at the beginning.
  wasMoved() { return this.pose().join() !== this.homePose.join(); }
}
