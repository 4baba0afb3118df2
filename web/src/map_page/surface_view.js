// The surface in 3D: an orbit around it, and which face a ray meets.

import {OrthographicCamera, Vector3} from 'three';

import {cornersOf, positionOf} from './map_data.js';
import {View} from './view.js';

// Where a ray meets the triangle p, q, r: [distance, b, c] of Moeller and Trumbore, or null.
export function meet(origin, way, p, q, r) {
  const ax = q[0] - p[0], ay = q[1] - p[1], az = q[2] - p[2];
  const bx = r[0] - p[0], by = r[1] - p[1], bz = r[2] - p[2];
  const hx = way[1] * bz - way[2] * by, hy = way[2] * bx - way[0] * bz,
        hz = way[0] * by - way[1] * bx;
  const det = ax * hx + ay * hy + az * hz;
  if (det === 0) return null;
  const sx = origin[0] - p[0], sy = origin[1] - p[1], sz = origin[2] - p[2];
  const b = (sx * hx + sy * hy + sz * hz) / det;
  if (!(b >= 0 && b <= 1)) return null;
  const kx = sy * az - sz * ay, ky = sz * ax - sx * az, kz = sx * ay - sy * ax;
  const c = (way[0] * kx + way[1] * ky + way[2] * kz) / det;
  if (!(c >= 0 && b + c <= 1)) return null;
  return [(bx * kx + by * ky + bz * kz) / det, b, c];
}

export class SurfaceView extends View {
  constructor(stage, element, shared) {
    const camera = new OrthographicCamera(-1, 1, 1, -1, -10, 20);
    camera.position.set(0, 0, 4);
    super('surface', stage, element, camera, shared);
    this.extent = 2.15;
    this.controls.enablePan = true;
    this.controls.minZoom = 0.2;
    this.controls.maxZoom = 500;
    this.controls.zoomToCursor = true;
  }

  // From a direction, the target in the middle.
  lookFrom(way, up = [0, 1, 0]) {
    this.controls.target.set(0, 0, 0);
    this.camera.up.set(...up);
    this.camera.position.copy(new Vector3(...way).normalize().multiplyScalar(4));
    this.controls.update();
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
    this.stage.request();
  }

  // {face, xi} under the mouse, or null.
  pick(event) {
    const [x, y] = this.deviceCoordinates(event);
    const {map, surfaceFrame: {center, radius}} = this.shared;
    const inModel = (p) => [p.x, p.y, p.z].map((t, d) => t * radius + center[d]);
    const from = inModel(new Vector3(x, y, -1).unproject(this.camera));
    const to = inModel(new Vector3(x, y, 1).unproject(this.camera));
    const way = to.map((t, d) => t - from[d]);
    let best = null;
    for (let face = 0; face < map.faceCount; ++face) {
      const found = meet(from, way, ...cornersOf(map, face).map((c) => positionOf(map, c)));
      if (found && (!best || found[0] < best.distance))
        best = {face, xi: [1 - found[1] - found[2], found[1], found[2]], distance: found[0]};
    }
    return best && {face: best.face, xi: best.xi};
  }
}
