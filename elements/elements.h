// Elements: the tables that energies contract, computed from geometry, and proofs that det J > 0.
//
//   Quadrature rule = exact_rule({3}, 5);
//   const ContractionTable table = space->tabulate(rule);
//
// The headers:
//     element_space.h             ElementSpace: nodes, tables, certificates
//     bernstein_space.h           triangles, quadrilaterals, tetrahedra, hexahedra and wedges, and
//                                 the description of a custom element (docs/elements.md)
//     quadrature.h                rules on triangles, tetrahedra and products of simplices
//     rest_shapes.h               the shapes that maps are measured against
//     jacobian_net.h              Bernstein coefficients of J, for upper bounds
//
// Densities are in energies/energies.h. LocalInjectivity (constraints/local_injectivity.h) uses
// these spaces to hold det J > 0 along every step of a solve.
#pragma once

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/element_space.h"
#include "majorant/elements/jacobian_net.h"
#include "majorant/elements/quadrature.h"
#include "majorant/elements/rest_shapes.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
