// Elements, whole: how geometry becomes the tables that energies contract, and proofs that det J >
// 0.
//
//   Quadrature rule = exact_rule({3}, 5);
//   const ContractionTable table = space->tabulate(rule);
//
// Its headers:
//     element_space.h             ElementSpace: nodes, tables, certificates
//     bernstein_space.h           triangles, quadrilaterals, tetrahedra, hexahedra and wedges, and
//                                 what describes an element of your own (docs/elements.md)
//     quadrature.h                rules on triangles, tetrahedra and products of simplices
//     rest_shapes.h               the shapes that maps are measured against
//     jacobian_net.h              Bernstein coefficients of J, for upper bounds
//
// Not for densities (energies/energies.h), nor for holding det J > 0 while a map is optimized:
// LocalInjectivity (constraints/local_injectivity.h) asks these spaces along every step.
#pragma once

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/element_space.h"
#include "majorant/elements/jacobian_net.h"
#include "majorant/elements/quadrature.h"
#include "majorant/elements/rest_shapes.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
