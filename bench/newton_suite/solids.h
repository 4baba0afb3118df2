// Elastic bars of triangles and tetrahedra (linear elements), rods, and contact.
#pragma once

#include "suite.h"

namespace majorant::newton_suite {

enum class Material {
  StableNeoHookean,  // [SGK18]
  NeoHookean,        // mu (|F|^2 / 2 - log J) + lambda log^2 J / 2 [BW08]
  SaintVenantKirchhoff,
  Corotated,  // in the plane alone
};

struct BarLoad {
  double stretch = 1;  // of the distance of its ends
  double twist = 0;    // of one end about the axis, degrees; in the plane a turn of the end
  double shear = 0;    // of one end, across
  double gravity = 0;  // a load across; 0 also: one end is free
  bool jumps = false;  // the natural start has the bar at rest, its ends moved
};

// length 4 by 1, 12 by 3 cells of two triangles; Young's modulus 1, plane strain.
SuiteInstance plane_bar(Material material, double nu, const BarLoad& load);
// length 3 by 1 by 1, 6 by 2 by 2 cubes of six tetrahedra; Young's modulus 1.
SuiteInstance space_bar(Material material, double nu, const BarLoad& load);
// A free plate at rest: nothing holds it, the energy vanishes.
SuiteInstance free_plate(Material material, double nu);

// The angles of a column that a load of so many times Euler's presses down, one end clamped, the
// other free [LL86]; starts are nearly straight.
SuiteInstance column(int n, double load);
// A clamped rod whose ends are pushed together: elastica of points.
SuiteInstance elastica(int n, double gap);
// A closed rod in the plane: a circle is the minimum.
SuiteInstance closed_rod(int n);
// A rod on an elastic foundation, pushed together: wrinkles.
SuiteInstance wrinkles(int n);

// The rope over a disk, held off by a logarithmic barrier.
SuiteInstance rope_over_disk(int n, double barrier);
// A plane block that falls on the floor: a penalty of the third power.
SuiteInstance block_on_floor(double nu);
// A membrane over an obstacle, by a logarithmic barrier of this weight.
SuiteInstance obstacle(int n, double barrier);
// Disks in a box under gravity, kept apart by the barrier of [LFS20].
SuiteInstance disks_in_box(int count);

}  // namespace majorant::newton_suite

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
