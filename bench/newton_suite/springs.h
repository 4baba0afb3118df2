// Ropes, nets, trusses and graphs of springs; particles.
#pragma once

#include "suite.h"

namespace majorant::newton_suite {

// A rope of `count` springs between (-1, 0.7) and (1, 0.7), with rest length 3 in all, under a
// load. Starts are compressed. roughness: of the random starts.
SuiteInstance rope(int count, double roughness);
// A rope like rope(), in space.
SuiteInstance rope_in_space(int count);
// A square net in space of n by n cells, held at its corners, with rest lengths 1.1 times its own.
SuiteInstance slack_net(int n);
// A net like slack_net(), held at its border, with rest lengths 0.9 times its own.
SuiteInstance tight_net(int n);
// A triangulated grid in the plane with all springs at rest, held at two points or free.
SuiteInstance springs_at_rest(int n, bool is_held);
// A row of cubes in space with all their diagonals.
SuiteInstance cubes_at_rest();
// A shallow arch of two bars under a load, which makes it snap through if it is large enough.
SuiteInstance two_bar_truss(double load);
// A shallow arch of n bars and torsion springs.
SuiteInstance arch(int n);

// A layout of a ring of n nodes by the distances of all pairs along it, with the weights of [KK89].
SuiteInstance ring_layout(int n);
SuiteInstance grid_layout(int n);
// The positions of sensors from distances of near neighbours and some known positions.
SuiteInstance sensors(double noise);
// n charges on the unit sphere; positions are normalized in the energy.
SuiteInstance thomson(int n);
// n atoms of Lennard and Jones.
SuiteInstance lennard_jones(int n);

}  // namespace majorant::newton_suite

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
