// CGAL's constrained Delaunay triangulation of points in the plane, with what its users note on
// vertices and faces. Constraints that cross throw Intersection_of_constraints_exception.
//
//     using Delaunay = internal::ConstrainedDelaunay<Index, FaceMark>;
//
// For .cpp files that are compiled with -frounding-math only; not installed.
#pragma once

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_face_base_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace majorant::internal {

using ExactPredicates = CGAL::Exact_predicates_inexact_constructions_kernel;

template <class VertexInfo, class FaceInfo>
using ConstrainedDelaunay = CGAL::Constrained_Delaunay_triangulation_2<
    ExactPredicates,
    CGAL::Triangulation_data_structure_2<
        CGAL::Triangulation_vertex_base_with_info_2<VertexInfo, ExactPredicates>,
        CGAL::Triangulation_face_base_with_info_2<
            FaceInfo, ExactPredicates,
            CGAL::Constrained_triangulation_face_base_2<ExactPredicates>>>,
    CGAL::No_constraint_intersection_tag>;

}  // namespace majorant::internal

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
