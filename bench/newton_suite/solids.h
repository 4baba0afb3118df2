// Elastic bars of triangles and tetrahedra (linear elements), rods, and contact.
#pragma once

#include "suite.h"

namespace majorant::newton_suite {

enum class Material {
  StableNeoHookean,  // [SGK18]
  NeoHookean,        // mu (|F|^2 / 2 - log J) + lambda log^2 J / 2 [BW08]
  SaintVenantKirchhoff,
  Corotated,  // only in the plane
};

struct BarLoad {
  double stretch = 1;  // ratio of the distance of the ends to that at rest
  double twist = 0;    // degrees of one end about the axis; in the plane a rotation of the end
  double shear = 0;    // displacement of one end across the bar
  double gravity = 0;  // a load across the bar; unless it is 0, one end is free
  bool jumps = false;  // the natural start has the bar at rest, its ends moved
};

// A bar of 4 by 1 with 12 by 3 cells of two triangles; Young's modulus 1, plane strain.
SuiteInstance plane_bar(Material material, double nu, const BarLoad& load);
// A bar of 3 by 1 by 1 with 6 by 2 by 2 cubes of six tetrahedra; Young's modulus 1.
SuiteInstance space_bar(Material material, double nu, const BarLoad& load);
// A free plate without constraints, whose energy at rest is 0.
SuiteInstance free_plate(Material material, double nu);

// A column with one end clamped and one free [LL86]. Unknowns: angles. load: relative to Euler's
// critical load. Starts are nearly straight.
SuiteInstance column(int n, double load);
// A discrete elastica: a clamped rod whose ends are pushed together.
SuiteInstance elastica(int n, double gap);
// A closed rod in the plane, whose minimum is a circle.
SuiteInstance closed_rod(int n);
// The wrinkles of a rod on an elastic foundation, pushed together.
SuiteInstance wrinkles(int n);

// A rope over a disk, kept outside by a logarithmic barrier.
SuiteInstance rope_over_disk(int n, double barrier);
// A plane block that falls on the floor, with a cubic penalty.
SuiteInstance block_on_floor(double nu);
// A membrane over an obstacle, with a logarithmic barrier of this weight.
SuiteInstance obstacle(int n, double barrier);
// Disks in a box under gravity, kept apart by the barrier of [LFS20].
SuiteInstance disks_in_box(int count);

}  // namespace majorant::newton_suite

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
