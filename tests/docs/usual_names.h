// Names that the examples in headers use without declaring them (tests/docs/code_test.py). At least
// two headers use each name; an example declares a name that no other header uses.
#pragma once

#include <CLI/App.hpp>
#include <atomic>
#include <iostream>
#include <memory>
#include <string>
#include <vector>

#include "apps/command.h"
#include "majorant/energies/make_energy.h"
#include "majorant/maps/map_file.h"
#include "majorant/maps/map_problem.h"
#include "majorant/maps/rest_shapes_of.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "majorant/quads/internal/min_cost_flow.h"
#include "majorant/quads/internal/movable_quads.h"

namespace usual_names {
using namespace majorant;

extern std::string path, text;
extern PolygonMesh polygons;
extern std::shared_ptr<const SurfaceMesh> mesh;
extern std::vector<char> is_cut;  // flags by half-edge
extern MapFile file;
extern BezierMap map;

extern std::shared_ptr<const BezierTriangleSpace> space;  // the space on the mesh
extern RestShapes rest;
extern Quadrature rule;
extern double area;  // area of the surface
extern std::shared_ptr<const DensityTerm> energy;

extern ProblemBuilder builder;
extern Problem problem;
extern MapSpecification spec;
extern Vec x, y0, start;  // full, reduced, full unknowns
extern ParametrizationOptions options;
extern RunRecord record;
extern StopCheck stop;
extern RunObserver* observer;

extern Points3 directions;  // one vector per face
inline const auto shear = density<2, 2>("shear", [](const auto& J) { return J(0, 0) * J(0, 1); });

extern SeamlessLattice lattice;
extern TMesh t_mesh;
extern FlowNetwork network;
extern TwoSidedSearch search;
extern HeldVertices held;

extern CLI::App verb;
extern app::CommonOptions common;
}  // namespace usual_names

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
