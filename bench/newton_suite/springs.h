// Ropes, nets, trusses and graphs of springs; particles.
#pragma once

#include "suite.h"

namespace majorant::newton_suite {

// `count` springs between (-1, 0.7) and (1, 0.7), rest length 3 in all, under a load; starts are
// compressed. roughness: of the random starts.
SuiteInstance rope(int count, double roughness);
// Makes that rope in space.
SuiteInstance rope_in_space(int count);
// n by n cells of a square net in space, held at its corners, rest lengths 1.1 times its own.
SuiteInstance slack_net(int n);
// Makes that net, held at its border, with rest lengths 0.9 times its own.
SuiteInstance tight_net(int n);
// A triangulated grid in the plane, all springs at rest, held at two points or nowhere.
SuiteInstance springs_at_rest(int n, bool is_held);
// Makes a row of cubes in space, with all their diagonals.
SuiteInstance cubes_at_rest();
// A shallow arch of two bars under a load that does not snap it through, and under one that does.
SuiteInstance two_bar_truss(double load);
// A shallow arch of n bars and torsion springs.
SuiteInstance arch(int n);

// All pairs of a ring of n, at their distances along it, weighted as [KK89] does.
SuiteInstance ring_layout(int n);
SuiteInstance grid_layout(int n);
// A network of sensors: distances of near neighbours, some positions known.
SuiteInstance sensors(double noise);
// n charges on the unit sphere; positions are normalized in the energy.
SuiteInstance thomson(int n);
// n atoms of Lennard and Jones.
SuiteInstance lennard_jones(int n);

}  // namespace majorant::newton_suite

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
