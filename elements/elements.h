// Elements, whole: how geometry becomes the tables that energies contract, and proofs that det J >
// 0. For programs that put problems on meshes together; what maps surfaces is majorant.h.
//
//   Quadrature rule = exact_rule({3}, 5);
//   const ContractionTable table = space->tabulate(rule);
//
// Its headers:
//     element_space.h             ElementSpace: nodes, tables, certificates
//     bezier_triangle_space.h     triangles of any degree
//     bezier_quad_space.h         quadrilaterals
//     bezier_tetrahedron_space.h  tetrahedra
//     bernstein_space.h           to describe an element of your own (docs/elements.md)
//     quadrature.h                rules on triangles, tetrahedra and products of simplices
//     rest_shapes.h               the shapes that maps are measured against
//     jacobian_net.h              Bernstein coefficients of J, for upper bounds
#pragma once

#include "majorant/elements/bernstein_space.h"
#include "majorant/elements/bezier_quad_space.h"
#include "majorant/elements/bezier_tetrahedron_space.h"
#include "majorant/elements/bezier_triangle_space.h"
#include "majorant/elements/element_space.h"
#include "majorant/elements/jacobian_net.h"
#include "majorant/elements/quadrature.h"
#include "majorant/elements/rest_shapes.h"

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
