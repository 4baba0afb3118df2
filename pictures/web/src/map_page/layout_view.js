// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// The layout in the plane: it is moved and scaled, and the cell at a point is found.

import {MOUSE, OrthographicCamera, TOUCH, Vector3} from 'three';

import {combine} from './bezier.js';
import {CellFinder} from './cell_finder.js';
import {Chords} from './chords.js';
import {evaluate} from './map_data.js';
import * as markShaders from './mark_shaders.js';
import {
  Mesh, cellsGeometry, flatGeometry, material, whereCoveredTwice, windowGeometry,
} from './stage.js';
import {View} from './view.js';

export class LayoutView extends View {
  constructor(stage, element, shared) {
    const camera = new OrthographicCamera(-1, 1, 1, -1, -1, 3);
    const [c, s] = shared.map.direction;
    camera.position.set(0, 0, 1);
    camera.up.set(-s, c, 0);
    super('layout', stage, element, camera, TOUCH.DOLLY_PAN, shared);
    const {uvBounds, shownBounds} = shared.map;
    this.extent = 1.08 * shownBounds.size / uvBounds.size;
    this.cells = new CellFinder(shared.map);
    if (shared.map.degree > 1) this.chords = new Chords(shared.map);
    Object.assign(this.controls, {
      enableRotate: false, zoomToCursor: true, minZoom: 0.2, maxZoom: 2000,
      mouseButtons: {LEFT: MOUSE.PAN, MIDDLE: MOUSE.DOLLY, RIGHT: MOUSE.PAN},
    });
    const [x, y] = this.upright(shownBounds.center);
    this.setPose([(x - uvBounds.center[0]) / uvBounds.size,
                  (y - uvBounds.center[1]) / uvBounds.size, 1]);
    this.homePose = this.pose();
    if (shared.map.scaffold) this.addScaffold(shared.map.scaffold);
    if (shared.map.facts.result?.globally_injective !== true)
      this.hatch = this.add(Mesh, windowGeometry(),
                            material(markShaders.hatchVertex, markShaders.hatchFragment,
                                     this.uniforms, whereCoveredTwice), 1.5);
  }

  // Converts the axes of the view to those of uv.
  upright([right, up]) {
    const [c, s] = this.shared.map.direction;
    return [c * right - s * up, s * right + c * up];
  }

  // Returns the middle of the view, relative to the layout's size, and the zoom.
  pose() { return [this.controls.target.x, this.controls.target.y, this.camera.zoom]; }

  setPose([x, y, zoom]) {
    this.controls.target.set(x, y, 0);
    this.camera.position.set(x, y, 1);
    this.camera.zoom = zoom;
    this.controls.update();
    this.stage.request(this);
  }

  // Moves by tenths of the visible width.
  move(right, up) {
    const [x, y, zoom] = this.pose();
    const [u, v] = this.upright([right, up]);
    const step = 0.1 * this.extent / zoom;
    this.setPose([x + step * u, y + step * v, zoom]);
    this.controls.dispatchEvent({type: 'change'});
  }

  pointAt({face, xi}) {
    const {map, uv} = this.shared;
    const {center, size} = map.uvBounds;
    const [u, v] = combine(evaluate(map, face, xi, uv), xi);
    return new Vector3((u - center[0]) / size, (v - center[1]) / size, 0);
  }

  // Centres a place, large enough to be seen.
  focusOn(place) {
    const {map} = this.shared;
    const box = this.cells.boxes(this.shared.uv).subarray(4 * place.face, 4 * place.face + 4);
    const size = Math.max(box[2] - box[0], box[3] - box[1]) / map.uvBounds.size;
    const {x, y} = this.pointAt(place);
    this.setPose([x, y, Math.min(1500, Math.max(1, 0.1 / Math.max(size, 1e-6)))]);
  }

  // Centres faces, as large as they fit.
  showFaces(faces) {
    const {map: {uvBounds}, uv} = this.shared;
    const boxes = this.cells.boxes(uv);
    const [low, high] = [[0, 1], [2, 3]].map((part, which) => part.map((d) => faces.reduce(
        (end, face) => (which ? Math.max : Math.min)(end, boxes[4 * face + d]),
        which ? -Infinity : Infinity)));
    const size = Math.max(high[0] - low[0], high[1] - low[1], 1e-6 * uvBounds.size);
    this.setPose([...[0, 1].map((d) => (0.5 * (low[d] + high[d]) - uvBounds.center[d]) / uvBounds.size),
                  Math.min(1500, uvBounds.size * this.extent / (1.2 * size))]);
  }

  addScaffold(scaffold) {
    const uniforms = {...this.uniforms, uControl: {value: this.shared.scaffoldControl}};
    this.scaffold = this.add(
        Mesh, flatGeometry(scaffold.faceCount),
        material(markShaders.scaffoldVertex(scaffold), markShaders.scaffoldFragment, uniforms), 0);
    if (this.chords) this.scaffoldChords = new Chords(scaffold);
  }

  refine(height) {
    if (!this.chords) return;  // straight cells are flat at any scale
    const {map: {uvBounds, scaffold}, uv} = this.shared;
    const {top, bottom, zoom} = this.camera;
    const scale = height * zoom / ((top - bottom) * uvBounds.size);
    const cut = this.chords.of(uv, scale);
    if (this.cut !== cut) {
      this.cut = cut;
      this.setCells(this.faces, cut, this.shared.faulty);
      this.setLines(this.lineList);
    }
    if (!scaffold) return;
    const around = this.scaffoldChords.of(scaffold.uv, scale);
    if (this.scaffoldCut === around) return;
    this.scaffoldCut = around;
    this.setCells(this.scaffold, around, new Set());
  }

  setCells(object, cut, top) {
    if (object.geometry !== this.shared.flatCells) object.geometry.dispose();
    object.geometry = cellsGeometry(cut, top);
  }

  // Returns {face, xi} under the mouse, or null.
  pick(event) {
    const [x, y] = this.deviceCoordinates(event);
    const p = new Vector3(x, y, 0).unproject(this.camera);
    const {map, uv} = this.shared;
    const {center, size} = map.uvBounds;
    return this.cells.find(uv, [p.x * size + center[0], p.y * size + center[1]]);
  }
}
