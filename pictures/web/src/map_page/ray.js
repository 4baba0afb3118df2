// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause

// Intersects a ray with the triangle p, q, r: [distance, b, c] of Moeller and Trumbore, or null.
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
