// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// The surface in 3D: an orbit around it, and the face that a ray meets.

import {OrthographicCamera, TOUCH, Vector3} from 'three';

import {cornersOf, positionOf} from './map_data.js';
import {meet} from './ray.js';
import {View} from './view.js';

const kExtent = 2.15;  // extent of the view at zoom 1, in radii
const kMargin = 1.05;  // margin around the initially visible part
const kDistance = 4;   // distance of the camera, in radii
const kSteep = 0.9986;  // cosine of 3 degrees

export class SurfaceView extends View {
  constructor(stage, element, shared) {
    const camera = new OrthographicCamera(-1, 1, 1, -1, -10, 20);
    const {eye} = shared.map;
    // before OrbitControls reads it
    camera.up.set(...(Math.abs(eye[1]) > kSteep ? [0, 0, 1] : [0, 1, 0]));
    camera.position.set(...eye).setLength(kDistance);
    super('surface', stage, element, camera, TOUCH.DOLLY_ROTATE, shared);
    this.extent = kExtent;
    Object.assign(this.controls, {minZoom: 0.2, maxZoom: 500, zoomToCursor: true});
    const {middle, size} = this.shownFrom(eye);
    this.setPose([...eye, ...middle, kExtent / (kMargin * size)]);
    this.homePose = this.pose();
  }

  // Returns the middle of the visible part from there, in the frame of the view, and its larger
  // side.
  shownFrom(eye) {
    const back = new Vector3(...eye).normalize();
    const right = this.camera.up.clone().cross(back).normalize();
    const {map, surfaceFrame: {center, radius}} = this.shared;
    const middle = new Vector3();
    let size = 0;
    for (const axis of [right, back.clone().cross(right)]) {
      let [low, high] = [Infinity, -Infinity];
      const {positions} = map;
      for (let k = 0; k < positions.length; k += 3) {
        const along = axis.x * (positions[k] - center[0]) + axis.y * (positions[k + 1] - center[1]) +
            axis.z * (positions[k + 2] - center[2]);
        low = Math.min(low, along);
        high = Math.max(high, along);
      }
      middle.addScaledVector(axis, (low + high) / (2 * radius));
      size = Math.max(size, (high - low) / radius);
    }
    return {middle, size: size || 2};
  }

  // Returns the direction to the eye, the target (in the frame of the view), and the zoom.
  pose() {
    const {camera, controls: {target}} = this;
    const eye = camera.position.clone().sub(target).normalize();
    return [eye.x, eye.y, eye.z, target.x, target.y, target.z, camera.zoom];
  }

  setPose([x, y, z, tx, ty, tz, zoom]) {
    this.controls.target.set(tx, ty, tz);
    this.camera.position.set(x, y, z).setLength(kDistance).add(this.controls.target);
    this.camera.zoom = zoom;
    this.controls.update();
    this.stage.request(this);
  }

  pointAt({face, xi}) {
    const {map, surfaceFrame: {center, radius}} = this.shared;
    const corners = cornersOf(map, face).map((corner) => positionOf(map, corner));
    return new Vector3(...[0, 1, 2].map((d) =>
        (xi[0] * corners[0][d] + xi[1] * corners[1][d] + xi[2] * corners[2][d] - center[d]) /
        radius));
  }

  // Returns the normal of a face, and the length of its longest edge.
  shapeOf(face) {
    const [p, q, r] = [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map((xi) => this.pointAt({face, xi}));
    const normal = q.clone().sub(p).cross(r.clone().sub(p));
    if (normal.length() === 0) normal.set(0, 0, 1);
    return {normal: normal.normalize(),
            size: Math.max(p.distanceTo(q), q.distanceTo(r), r.distanceTo(p), 1e-6)};
  }

  // Turns the view to a face that faces away.
  turnTo({face}) {
    const {normal} = this.shapeOf(face);
    const pose = this.pose();
    if (normal.dot(new Vector3(...pose)) < 0.2) this.setPose([...normal, ...pose.slice(3)]);
  }

  // Turns the view to a face in the middle, large enough to be seen.
  focusOn(place) {
    const {normal, size} = this.shapeOf(place.face);
    const zoom = Math.min(400, Math.max(1, 0.2 / size));
    this.setPose([...normal, ...this.pointAt(place), zoom]);
  }

  // Turns the view to faces in the middle, as large as they fit.
  showFaces(faces) {
    const sum = new Vector3(), middle = new Vector3();
    const corners = faces.flatMap((face) => [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(
        (xi) => this.pointAt({face, xi})));
    for (let k = 0; k < corners.length; k += 3) {
      const [p, q, r] = corners.slice(k, k + 3);
      sum.add(q.clone().sub(p).cross(r.clone().sub(p)));
    }
    for (const corner of corners) middle.addScaledVector(corner, 1 / corners.length);
    const far = corners.reduce((most, corner) => Math.max(most, corner.distanceTo(middle)), 1e-6);
    const normal = sum.length() > 0 ? sum.normalize() : new Vector3(0, 0, 1);
    this.setPose([...normal, ...middle, Math.min(400, 0.5 * kExtent / far)]);
  }

  // Turns the camera around its target by radians.
  turn(right, up) {
    const arm = this.camera.position.clone().sub(this.controls.target);
    const across = new Vector3().crossVectors(this.camera.up, arm).normalize();
    arm.applyAxisAngle(this.camera.up, -right);
    const steep = arm.clone().applyAxisAngle(across, up);
    if (new Vector3().crossVectors(this.camera.up, steep).dot(across) > 0.02) arm.copy(steep);
    this.camera.position.copy(this.controls.target).add(arm);
    this.controls.update();
    this.stage.request(this);
  }

  // Returns a test of faces that fails only for those that the ray misses: the ray is not in the
  // bounding box of the face, both seen along it.
  near([ox, oy, oz], way) {
    const {map: {positions, cells, degree, size}, surfaceFrame: {radius}} = this.shared;
    const back = new Vector3(...way).normalize();
    const steep = Math.abs(back.x) < 0.5 ? new Vector3(1, 0, 0) : new Vector3(0, 1, 0);
    const right = steep.cross(back).normalize();
    const up = back.clone().cross(right);
    const slack = 1e-9 * radius;
    const count = positions.length / 3;
    this.across ??= [new Float64Array(count), new Float64Array(count)];
    [right, up].forEach(({x, y, z}, axis) => {
      const along = this.across[axis];
      for (let k = 0; k < count; ++k)
        along[k] = x * (positions[3 * k] - ox) + y * (positions[3 * k + 1] - oy) +
            z * (positions[3 * k + 2] - oz);
    });
    const isBetween = (along, a, b, c) =>
        Math.min(along[a], along[b], along[c]) <= slack &&
        Math.max(along[a], along[b], along[c]) >= -slack;
    return (face) => {
      const last = face * size + size - 1;
      const a = cells[face * size], b = cells[last - degree], c = cells[last];
      return this.across.every((along) => isBetween(along, a, b, c));
    };
  }

  // Returns {face, xi} under the mouse, or null.
  pick(event) {
    const [x, y] = this.deviceCoordinates(event);
    const {map, surfaceFrame: {center, radius}} = this.shared;
    const inModel = (p) => [p.x, p.y, p.z].map((t, d) => t * radius + center[d]);
    const from = inModel(new Vector3(x, y, -1).unproject(this.camera));
    const to = inModel(new Vector3(x, y, 1).unproject(this.camera));
    const way = to.map((t, d) => t - from[d]);
    let best = null;
    const isNear = this.near(from, way);
    for (let face = 0; face < map.faceCount; ++face) {
      if (!isNear(face)) continue;
      const found = meet(from, way, ...cornersOf(map, face).map((c) => positionOf(map, c)));
      if (found && (!best || found[0] < best.distance))
        best = {face, xi: [1 - found[1] - found[2], found[1], found[2]], distance: found[0]};
    }
    return best && {face: best.face, xi: best.xi};
  }
}
