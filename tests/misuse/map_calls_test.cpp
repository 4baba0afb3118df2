// Wrong calls of maps and of functions that make them.
#include <limits>
#include <memory>

#include "majorant/energies/make_energy.h"
#include "majorant/maps/distortion.h"
#include "majorant/maps/map_problem.h"
#include "majorant/maps/rest_shapes_of.h"
#include "majorant/parametrization/atlas/unwrap.h"
#include "majorant/parametrization/fields/cross_field.h"
#include "majorant/parametrization/initialization/start.h"
#include "majorant/parametrization/packing/pack.h"
#include "majorant/parametrization/seams/choose_cuts.h"
#include "majorant/parametrization/solve/parametrize.h"
#include "misuse/outcome.h"

namespace majorant::misuse {
namespace map_calls {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

// A bent sheet of 3 by 3 vertices; vertex 4 is the inner one.
std::shared_ptr<const SurfaceMesh> sheet() {
  RowMatrix v(9, 3);
  Cells f(8, 3);
  for (Index j = 0, t = 0; j < 3; ++j)
    for (Index i = 0; i < 3; ++i) {
      v.row(3 * j + i) << i, j, i == 1 && j == 1 ? 0.5 : 0;
      if (i == 2 || j == 2) continue;
      const Index a = 3 * j + i;
      f.row(t++) << a, a + 1, a + 4;
      f.row(t++) << a, a + 4, a + 3;
    }
  return std::make_shared<const SurfaceMesh>(SurfaceMesh::from_arrays(v, f));
}
std::shared_ptr<const SurfaceMesh> tetrahedron() {
  RowMatrix v(4, 3);
  v << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  Cells f(4, 3);
  f << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  return std::make_shared<const SurfaceMesh>(SurfaceMesh::from_arrays(v, f));
}
BezierMap start() { return BezierMap::linear(sheet(), tutte_map(*sheet())); }

ParametrizationResult run(const std::function<void(ParametrizationOptions&)>& change) {
  ParametrizationOptions options;
  options.map.degree = 1;
  change(options);
  return parametrize(sheet(), options);
}
void cut(const std::function<void(CutOptions&)>& change) {
  CutOptions options;
  change(options);
  choose_cuts(*sheet(), options);
}
void problem(const std::function<void(MapSpecification&, Vec&)>& change) {
  MapSpecification spec;
  spec.rest = std::make_shared<const RestShapes>(rest_shapes(*sheet()));
  Vec x = start().control_points();
  change(spec, x);
  const auto space = start().shared_space();
  map_problem(spec, space, x, energy_terms(spec, space, {radon_rule()}), nullptr);
}

const std::vector<Call> kCalls{
    {"null_mesh", "InvalidArgument: parametrize: the mesh is null",
     [] { return parametrize(std::shared_ptr<const SurfaceMesh>(), {}); }},
    {"degree_zero", "InvalidArgument: degree 0 is not one of 1..8",
     [] { return run([](auto& o) { o.map.degree = 0; }); }},
    {"degree_nine", "InvalidArgument: degree 9 is not one of 1..8",
     [] { return run([](auto& o) { o.map.degree = 9; }); }},
    {"no_energy", "InvalidArgument: no energy is given",
     [] { return run([](auto& o) { o.map.energy.clear(); }); }},
    {"negative_energy_weight", "InvalidArgument: the weight -1 of an energy is not in",
     [] { return run([](auto& o) { o.map.energy[0].weight = -1; }); }},
    {"nan_energy_weight", "InvalidArgument: the weight nan of an energy is not in",
     [] { return run([](auto& o) { o.map.energy[0].weight = kNan; }); }},
    {"zero_handle_weight", "InvalidArgument: the weight 0 of soft handles",
     [] { return run([](auto& o) { o.map.handle_weight = 0; }); }},
    {"few_face_weights", "InvalidArgument: 3 face weights for 8 faces: one each is needed",
     [] { return run([](auto& o) { o.map.face_weight = Vec::Ones(3); }); }},
    {"nan_face_weight", "InvalidArgument: face weight [0] is nan, ",
     [] { return run([](auto& o) { o.map.face_weight = Vec::Constant(8, kNan); }); }},
    {"nan_pin", "InvalidArgument: the target of vertex 4 is (nan, 0)",
     [] { return run([](auto& o) {
            o.map.pins = {{4, Vector2(kNan, 0)}};
          }); }},
    {"infinite_handle", "InvalidArgument: the target of vertex 4 is (0, inf)",
     [] { return run([](auto& o) {
            o.map.handles = {{4, Vector2(0, 1 / 0.0)}};
          }); }},
    {"pin_missing", "InvalidArgument: pinned vertex 9 does not exist",
     [] { return run([](auto& o) {
            o.map.pins = {{9, Vector2(0, 0)}};
          }); }},
    {"pin_negative", "InvalidArgument: pinned vertex -5 does not exist",
     [] { return run([](auto& o) {
            o.map.pins = {{-5, {}}};
          }); }},
    {"handle_missing", "InvalidArgument: pinned vertex 12 does not exist",
     [] { return run([](auto& o) {
            o.map.handles = {{12, {}}};
          }); }},
    {"pinned_twice", "Error Unsupported: vertex 4 is pinned twice; pin it once",
     [] { return run([](auto& o) {
            o.map.pins = {{4, {}}, {4, {}}};
          }); }},
    {"pin_and_handle", "Error Unsupported: vertex 4 has two handles, or a pin and a handle",
     [] {
       return run([](auto& o) {
         o.map.pins = {{4, {}}};
         o.map.handles = {{4, {}}};
       });
     }},
    {"aligned_missing", "InvalidArgument: aligned half-edge 24 does not exist",
     [] { return run([](auto& o) { o.map.aligned = {24}; }); }},
    {"short_initial",
     "InvalidArgument: the initial map has 4 numbers, it needs 2 numbers per vertex, 18",
     [] { return run([](auto& o) { o.map.initial = Vec::Zero(4); }); }},
    {"nan_initial", "InvalidArgument: the initial map[0] is nan",
     [] { return run([](auto& o) { o.map.initial = Vec::Constant(18, kNan); }); }},
    {"flat_initial", "Error Infeasible: the initial map is not injective: face 0 (8 in all)",
     [] { return run([](auto& o) { o.map.initial = Vec::Zero(18); }); }},
    {"no_tolerance", "InvalidArgument: the tolerance must be a positive number",
     [] { return run([](auto& o) { o.solve.tolerance = 0; }); }},
    {"nan_tolerance", "InvalidArgument: the tolerance must be a positive number",
     [] { return run([](auto& o) { o.solve.tolerance = kNan; }); }},
    {"nan_elevation_tolerance", "InvalidArgument: the elevation tolerance must not be negative",
     [] { return run([](auto& o) { o.solve.elevation_tolerance = kNan; }); }},
    {"negative_depth", "InvalidArgument: the depth of certificates must not be negative",
     [] { return run([](auto& o) { o.solve.injectivity_depth = -1; }); }},
    {"negative_threads", "InvalidArgument: the number of threads must not be negative",
     [] { return run([](auto& o) { o.solve.threads = -1; }); }},
    {"negative_quadrature", "InvalidArgument: the number of quadrature points must not be negative",
     [] { return run([](auto& o) { o.solve.quadrature_points = -3; }); }},
    {"missing_curvature", "InvalidArgument: energy 'quartic' has no curvature model 'majorizer'",
     [] {
       return run([](auto& o) {
         o.map.energy = {{energy_factory(density<2, 2>("quartic",
                                                       [](const auto& J) {
                                                         const auto d = J.determinant();
                                                         return J.squaredNorm() * J.squaredNorm() +
                                                                1.0 / (d * d);
                                                       })),
                          1.0}};
         o.solve.curvature = Curvature::Majorizer;
       });
     }},
    {"closed_surface", "Error Unsupported: the surface is closed (genus 0, no boundary); unwrap()",
     [] { return parametrize(tetrahedron(), {}); }},
    {"tutte_of_closed", "Error Unsupported: the surface is closed (genus 0, no boundary)",
     [] { tutte_map(*tetrahedron()); }},
    {"start_of_degree_two", "InvalidArgument: a start must have degree 1, this one has 2",
     [] {
       RunRecord record;
       return parametrize(start().elevated(), {}, record);
     }},
    {"nan_start", "InvalidArgument: the start[0] is nan",
     [] {
       RunRecord record;
       return parametrize(BezierMap::linear(sheet(), Vec::Constant(18, kNan)), {}, record);
     }},
    {"nan_time_limit", "InvalidArgument: RunRecord: the time limit is nan",
     [] { RunRecord record(kNan); }},
    {"negative_iterations", "InvalidArgument: RunRecord: the iteration limit is negative",
     [] { RunRecord record(1, -1); }},
    {"deform_bent", "Error Unsupported: vertex 4 is off the plane z = 0",
     [] { planar_map(sheet()); }},
    {"deform_null", "InvalidArgument: planar_map: the mesh is null", [] { planar_map(nullptr); }},
    {"map_null_mesh", "InvalidArgument: BezierMap: the mesh is null",
     [] { BezierMap::linear(nullptr, Vec()); }},
    {"map_null_space", "InvalidArgument: BezierMap: the space is null",
     [] { BezierMap(sheet(), nullptr, Vec()); }},
    {"map_short_points", "InvalidArgument: BezierMap: the control points has 2 numbers, 18",
     [] { BezierMap::linear(sheet(), Vec::Zero(2)); }},
    {"map_of_other_faces", "InvalidArgument: BezierMap: a space over 8 faces for a mesh of 4",
     [] { BezierMap(tetrahedron(), start().shared_space(), start().control_points()); }},
    {"evaluate_missing_face", "InvalidArgument: BezierMap: face 8 does not exist, there are 8",
     [] {
       start().evaluate(8, {1, 0, 0});
     }},
    {"evaluate_negative_face", "InvalidArgument: BezierMap: face -1 does not exist",
     [] {
       start().evaluate(-1, {1, 0, 0});
     }},
    {"jacobian_missing_face", "InvalidArgument: BezierMap: face 100 does not exist",
     [] {
       start().jacobian(100, {1, 0, 0});
     }},
    {"singular_values_missing_face", "InvalidArgument: BezierMap: face 9 does not exist",
     [] {
       start().singular_values(9, {1, 0, 0});
     }},
    {"refine_by_nothing", "InvalidArgument: BezierMap::refine: K is 0", [] { start().refine(0); }},
    {"problem_short_start", "InvalidArgument: add_map: the start has 4 numbers, 18",
     [] { problem([](MapSpecification&, Vec& x) { x = Vec::Zero(4); }); }},
    {"problem_pin_missing", "InvalidArgument: ",
     [] { problem([](MapSpecification& s, Vec&) {
            s.pins = {{30, {0, 0}}};
          }); }},
    {"problem_few_shapes", "...rest shapes of 2 elements do not fit the space, which has 8",
     [] {
       problem([](MapSpecification& s, Vec&) {
         RestShapes rest = *s.rest;
         rest.measure = Vec::Ones(2);
         s.rest = std::make_shared<const RestShapes>(std::move(rest));
       });
     }},
    {"problem_no_shapes", "InvalidArgument: DensityTerm: the rest shapes",
     [] { problem([](MapSpecification& s, Vec&) { s.rest = nullptr; }); }},
    {"problem_few_face_weights", "...3 weights of elements for 8 elements",
     [] { problem([](MapSpecification& s, Vec&) { s.face_weight = Vec::Ones(3); }); }},
    {"distortion_of_other_cells", "InvalidArgument: measure_distortion: degree 2, cells of 3 nodes",
     [] {
       measure_distortion(2, sheet()->faces(), start().control_points(), rest_shapes(*sheet()), 1);
     }},
    {"distortion_short_x", "InvalidArgument: measure_distortion: node 3 does not exist",
     [] { measure_distortion(1, sheet()->faces(), Vec::Zero(6), rest_shapes(*sheet()), 1); }},
    {"distortion_of_no_scale", "InvalidArgument: measure_distortion: the scale is 0",
     [] { measure_distortion(start(), 0); }},
    {"cut_stretch", "InvalidArgument: the largest stretch of a chart, 0.5, must be above 1",
     [] { cut([](CutOptions& o) { o.max_stretch = 0.5; }); }},
    {"cut_angle", "InvalidArgument: the angle of sharp edges must lie between 0 and 180",
     [] { cut([](CutOptions& o) { o.sharp_angle = kNan; }); }},
    {"cut_whole_missing", "InvalidArgument: vertex 9, to be left whole, does not exist",
     [] { cut([](CutOptions& o) { o.whole = {9}; }); }},
    {"cut_few_flags", "InvalidArgument: choose_cuts: 2 flags for 24 half-edges",
     [] { cut([](CutOptions& o) {
            o.given = {1, 0};
          }); }},
    {"cut_without_texture",
     "Error Unsupported: no face has texture coordinates, along which it could be cut; use "
     "CutMethod::Automatic",
     [] { cut([](CutOptions& o) { o.method = CutMethod::Texture; }); }},
    {"cut_no_edge", "Error Usage: vertices 0 and 8 (counting from 0) are joined by no edge of the",
     [] {
       cut([](CutOptions& o) {
         o.method = CutMethod::Given;
         o.edges = {{0, 8}};
       });
     }},
    {"unwrap_null", "InvalidArgument: unwrap: the surface is null",
     [] {
       RunRecord record;
       unwrap(nullptr, {}, record);
     }},
    {"pack_negative_padding", "InvalidArgument: pack: padding_pixels is -1",
     [] { pack({start()}, {.padding_pixels = -1}); }},
    {"pack_few_flags", "InvalidArgument: pack: 2 flags for 1 charts",
     [] {
       pack({start()}, {.fixed = {1, 0}});
     }},
    {"field_few_flags", "InvalidArgument: smoothest_cross_field: aligned must have 3 #F entries",
     [] { smoothest_cross_field(*sheet(), {.aligned = {1}}); }},
    {"field_negative_cost", "InvalidArgument: smoothest_cross_field: cone_cost must be >= 0",
     [] { smoothest_cross_field(*sheet(), {.cone_cost = -1}); }},
    {"field_no_turns", "InvalidArgument: smoothest_cross_field: least_quarter_turns must be 1 to 4",
     [] { smoothest_cross_field(*sheet(), {.least_quarter_turns = 0}); }},
    {"cone_missing", "Error Usage: cones: there is no vertex 11 (counting from 0)",
     [] {
       cross_field_with_cones(*sheet(), {{11, 3}});
     }},
};

}  // namespace map_calls

class MapCalls : public Misuse {};
TEST_P(MapCalls, IsRefused) { expect_refusal(GetParam()); }
INSTANTIATE_TEST_SUITE_P(Table, MapCalls, testing::ValuesIn(map_calls::kCalls), name_of);

}  // namespace majorant::misuse

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
