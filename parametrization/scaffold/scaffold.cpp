#include "majorant/parametrization/scaffold/scaffold.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "majorant/constraints/constraints.h"
#include "majorant/elements/bernstein.h"
#include "majorant/elements/quadrature.h"
#include "majorant/energies/energy_factory.h"
#include "majorant/framework/newton.h"
#include "majorant/maps/quadrature_hierarchy.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/scaffold/internal/scaffold_triangulation.h"

namespace majorant {
namespace {

// The frame grows if the image is closer to it than this, relative to the frame's smaller extent. A
// new frame begins at 1/3.
constexpr double kClearance = 0.25;
// The total weight of the quadrature points on the edges of a triangle: equal to that of the points
// inside.
constexpr double kEdgeWeight = 0.5;
// The distance of a new frame, in larger extents of what it encloses: the size triples each time,
// so that few frames are needed.
constexpr double kMargin = 1.0;

// Returns `rule` scaled by 1 - kEdgeWeight, with `pieces` + 1 points on every edge sharing that
// weight.
Quadrature with_edges(const Quadrature& rule, int pieces) {
  Quadrature out;
  const Index inside = rule.weights.size(), count = 3 * pieces;
  out.cell = rule.cell;
  out.points.resize(inside + count, rule.points.cols());
  out.weights.resize(inside + count);
  out.points.topRows(inside) = rule.points;
  out.weights.head(inside) = (1 - kEdgeWeight) * rule.weights;
  out.weights.tail(count).setConstant(kEdgeWeight / count * rule.weights.sum());
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < pieces; ++i) {
      Eigen::RowVector3d xi = Eigen::RowVector3d::Zero();
      xi[k] = 1 - static_cast<double>(i) / pieces;
      xi[next(k)] = static_cast<double>(i) / pieces;
      out.points.row(inside + k * pieces + i) = xi;
    }
  return out;
}

// Points on an edge, in units of the degree, by level: each level has four times as many. Chosen,
// not tuned.
constexpr std::array<int, 3> kEdgePoints{8, 32, 128};

// Returns rules with many points on the edges, by level. They need not be accurate but must sample
// where det J falls towards 0, which happens first on edges.
std::vector<Quadrature> scaffold_rules(int degree) {
  if (degree == 1) return {lattice_rule(1)};
  const Quadrature inside = composite_rule(radon_rule(), first_pieces(degree));
  std::vector<Quadrature> rules;
  for (const int points : kEdgePoints) rules.push_back(with_edges(inside, points * degree));
  return rules;
}

// Copies points stored by face to unknowns numbered by `cells`.
void gather(const BezierMesh& mesh, const Cells& cells, Vec& x) {
  for (Index f = 0; f < cells.rows(); ++f)
    for (Index l = 0; l < cells.cols(); ++l)
      x.segment<2>(2 * cells(f, l)) = mesh.points.row(f).segment<2>(2 * l);
}
void scatter(VecIn x, const Cells& cells, BezierMesh& mesh) {
  for (Index f = 0; f < cells.rows(); ++f)
    for (Index l = 0; l < cells.cols(); ++l)
      mesh.points.row(f).segment<2>(2 * l) = x.segment<2>(2 * cells(f, l));
}

// Returns the control points of straight triangles, one row per face.
RowMatrix straight_points(int degree, const Cells& faces, const Points2& vertices) {
  const TriangleIndices& ix = TriangleIndices::of_degree(degree);
  RowMatrix points(faces.rows(), 2 * ix.count());
  for (Index f = 0; f < faces.rows(); ++f)
    for (int l = 0; l < ix.count(); ++l) {
      Eigen::RowVector2d p = Eigen::RowVector2d::Zero();
      for (int k = 0; k < 3; ++k) p += ix.multi(l)[k] * vertices.row(faces(f, k));
      points.row(f).segment<2>(2 * l) = p / degree;
    }
  return points;
}

}  // namespace

Scaffold::Scaffold(std::shared_ptr<const BezierTriangleSpace> image, VecIn x)
    : image_(std::move(image)) {
  std::vector<Points2> polygons;
  std::vector<Index> vertex_of;  // triangulation's vertex -> ours
  const Cells& image_faces = image_->faces();
  const std::vector<Index> image_opposite = opposite_half_edges(image_faces);
  for (const auto& loop : boundary_half_edges(image_faces, image_opposite)) {
    Points2 polygon(static_cast<Index>(loop.size()), 2);
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Index v = from_vertex(image_faces, loop[k]);
      polygon.row(static_cast<Index>(k)) = x.segment<2>(2 * v);
      vertex_of.push_back(v);
      image_sides_.push_back(loop[k]);
    }
    polygons.push_back(std::move(polygon));
  }
  const ScaffoldTriangulation t = triangulate_scaffold(polygons, {});
  const auto shared = static_cast<Index>(vertex_of.size());
  for (Index v = shared; v < t.positions.rows(); ++v)
    vertex_of.push_back(image_->vertex_count() + v - shared);
  mesh_.degree = image_->degree();
  mesh_.faces = t.faces;
  mesh_.points = straight_points(mesh_.degree, t.faces, t.positions);
  for (Index& v : mesh_.faces.reshaped()) v = vertex_of[v];
  mesh_.opposite = opposite_half_edges(mesh_.faces);
  for (const Index v : t.frame) frame_.push_back(vertex_of[v]);
  number();
}

// Numbers the nodes: those on the image's boundary have its numbers, the others follow.
void Scaffold::number() {
  own_vertex_.assign(to_size(mesh_.faces.maxCoeff()) + 1, -1);
  for (const Index v : mesh_.faces.reshaped()) own_vertex_[v] = 0;
  Index count = 0;
  for (Index& v : own_vertex_)
    if (v == 0) v = count++;
  own_ = std::make_shared<const BezierTriangleSpace>(own_faces(), count, mesh_.degree);

  std::vector<Index>& joint = joint_node_;
  joint.assign(to_size(own_->node_count()), -1);
  std::vector<Index> side_from(own_vertex_.size(), -1);  // of the scaffold's boundary, by its start
  for (Index h = 0; h < 3 * face_count(); ++h)
    if (mesh_.opposite[h] < 0) side_from[mesh_.from_vertex(h)] = h;
  for (const Index h : image_sides_) {
    const std::vector<Index> of_image = edge_nodes(*image_, h);
    const std::vector<Index> mine = edge_nodes(*own_, side_from[to_vertex(image_->faces(), h)]);
    for (std::size_t i = 0; i < mine.size(); ++i) joint[mine[i]] = of_image[mine.size() - 1 - i];
  }
  joint_node_count_ = image_->node_count();
  for (Index& node : joint)
    if (node < 0) node = joint_node_count_++;
  number_jointly();
  levels_.resize(to_size(face_count()), 0);
  frame_nodes_.clear();
  for (std::size_t k = 0; k < frame_.size(); ++k)
    for (const Index node : edge_nodes(*space_, side_from[frame_[k]])) frame_nodes_.push_back(node);
  std::sort(frame_nodes_.begin(), frame_nodes_.end());
  frame_nodes_.erase(std::unique(frame_nodes_.begin(), frame_nodes_.end()), frame_nodes_.end());
}

Cells Scaffold::own_faces() const {
  Cells faces = mesh_.faces;
  for (Index& v : faces.reshaped()) v = own_vertex_[v];
  return faces;
}

void Scaffold::number_jointly() {
  NodeNumbering numbering{own_->cells(), joint_node_count_, {}};
  for (Index& node : numbering.cells.reshaped()) node = joint_node_[node];
  space_ = std::make_shared<const BezierTriangleSpace>(std::move(numbering), mesh_.degree);
}

// Renumbers after flips. At degree 1 nodes are vertices, so flips change neither their numbers nor
// the boundary.
void Scaffold::number_flipped() {
  if (mesh_.degree > 1) return number();
  NodeNumbering numbering{own_faces(), own_->node_count(), own_->boundary_nodes()};
  own_ = std::make_shared<const BezierTriangleSpace>(std::move(numbering), mesh_.degree);
  number_jointly();
}

RestShapes Scaffold::rest() const {
  Points3 corners(3, 3);
  corners << 0, 0, 0, 1, 0, 0, 0.5, std::sqrt(0.75), 0;
  Cells triangle(1, 3);
  triangle << 0, 1, 2;
  const RestShapes one = flat_triangles(corners, triangle);
  RestShapes rest;
  rest.inverse = one.inverse.replicate(face_count(), 1);
  rest.measure = Vec::Constant(face_count(), one.measure[0]);
  return rest;
}

std::shared_ptr<const DensityTerm> Scaffold::term_on(
    std::shared_ptr<const BezierTriangleSpace> space) const {
  return mips()(std::move(space), rest(), scaffold_rules(mesh_.degree));
}

std::shared_ptr<const DensityTerm> Scaffold::energy_term() const { return term_on(space_); }

void Scaffold::refine(const std::vector<Index>& faces) {
  const auto top = static_cast<RuleId>(scaffold_rules(mesh_.degree).size()) - 1;
  for (const Index f : faces) levels_[f] = std::min(levels_[f] + 1, top);
}

Vec Scaffold::joined(VecIn image) const {
  Vec joint(2 * joint_node_count_);
  gather(mesh_, space_->cells(), joint);
  joint.head(2 * image_->node_count()) = image.head(2 * image_->node_count());
  return joint;
}

void Scaffold::take(VecIn joint) { scatter(joint, space_->cells(), mesh_); }

FlipCounts Scaffold::flip() {
  std::vector<char> none;
  const FlipCounts counts = make_delaunay(mesh_, none);
  if (counts.performed > 0) number_flipped();
  return counts;
}

void Scaffold::relax(int steps, int depth, const NewtonOptions& options) {
  if (options.stop() != Directive::Continue) return;
  Vec x(2 * own_->node_count());
  gather(mesh_, own_->cells(), x);
  ProblemBuilder builder(x.size());
  TermState state;
  state.element_rule = levels_;
  builder.add(term_on(own_), state);
  builder.add(std::make_shared<const LocalInjectivity>(own_, Vec::Ones(face_count()), depth));
  builder.add(FixedPoints::at(own_->boundary_nodes(), x));
  const Problem problem = builder.build();
  NewtonStepper stepper(problem, options);
  const Vec y = problem.reduce(x);
  const double energy = stepper.evaluator().value(y);
  if (!std::isfinite(energy)) return;
  // Any decrease counts, however small: it makes room for the image's next step.
  const SolveResult relaxed = stepper.descend_from(y, energy, brief_rules(steps, kAnyDecrease));
  scatter(problem.expand(relaxed.y), own_->cells(), mesh_);
}

Points2 Scaffold::frame_points() const {
  std::map<Index, Index> place;
  for (std::size_t k = 0; k < frame_.size(); ++k) place[frame_[k]] = static_cast<Index>(k);
  Points2 points(static_cast<Index>(frame_.size()), 2);
  for (Index h = 0; h < 3 * face_count(); ++h)
    if (const auto it = place.find(mesh_.from_vertex(h)); it != place.end())
      points.row(it->second) = mesh_.point(face_of(h), corner_of(h));
  return points;
}

bool Scaffold::grow() {
  const Points2 frame = frame_points();
  Points2 image(3 * face_count(), 2);  // corners on the image's boundary
  Index count = 0;
  for (Index h = 0; h < 3 * face_count(); ++h)
    if (mesh_.from_vertex(h) < image_->vertex_count())
      image.row(count++) = mesh_.point(face_of(h), corner_of(h));
  if (!frame_is_tight(frame, image.topRows(count), kClearance)) return false;
  const ScaffoldTriangulation ring = enlarge_frame(frame, kMargin);
  Index next = mesh_.faces.maxCoeff() + 1;
  std::vector<Index> vertex_of = frame_;
  while (static_cast<Index>(vertex_of.size()) < ring.positions.rows()) vertex_of.push_back(next++);
  Cells faces(face_count() + ring.faces.rows(), 3);
  faces.topRows(face_count()) = mesh_.faces;
  for (Index f = 0; f < ring.faces.rows(); ++f)
    for (int k = 0; k < 3; ++k) faces(face_count() + f, k) = vertex_of[ring.faces(f, k)];
  RowMatrix points(faces.rows(), mesh_.points.cols());
  points << mesh_.points, straight_points(mesh_.degree, ring.faces, ring.positions);
  mesh_.faces = faces;
  mesh_.points = points;
  mesh_.opposite = opposite_half_edges(faces);
  frame_.clear();
  for (const Index v : ring.frame) frame_.push_back(vertex_of[v]);
  number();
  // The points of the old frame are computed twice and made equal to the last bit.
  Vec x(2 * own_->node_count());
  gather(mesh_, own_->cells(), x);
  scatter(x, own_->cells(), mesh_);
  return true;
}

Scaffold Scaffold::elevated(std::shared_ptr<const BezierTriangleSpace> image) const {
  Scaffold out;
  out.image_ = std::move(image);
  out.image_sides_ = image_sides_;
  out.mesh_ = mesh_;
  out.mesh_.degree = mesh_.degree + 1;
  out.frame_ = frame_;
  const Eigen::MatrixXd e = elevation_matrix(mesh_.degree);
  out.mesh_.points.resize(face_count(), 2 * e.rows());
  for (Index f = 0; f < face_count(); ++f) {
    const Eigen::Map<const RowMatrix> low(mesh_.points.row(f).data(), e.cols(), 2);
    const RowMatrix high = e * low;
    out.mesh_.points.row(f) = Eigen::Map<const Eigen::RowVectorXd>(high.data(), high.size());
  }
  out.number();
  return out;
}

ScaffoldInjectivity::ScaffoldInjectivity(std::shared_ptr<const LocalInjectivity> image,
                                         Index image_faces,
                                         std::shared_ptr<const LocalInjectivity> scaffold)
    : image_(std::move(image)), scaffold_(std::move(scaffold)), image_faces_(image_faces) {}

Verdict ScaffoldInjectivity::check(VecIn x) const {
  Verdict verdict = image_->check(x);
  const Verdict around = scaffold_->check(x);
  verdict.feasible = verdict.feasible && around.feasible;
  verdict.margin = std::min(verdict.margin, around.margin);
  for (const Index e : around.blocking) verdict.blocking.push_back(image_faces_ + e);
  return verdict;
}

StepBound ScaffoldInjectivity::max_step(VecIn x, VecIn d, double s) const {
  StepBound bound = image_->max_step(x, d, s);
  StepBound around = scaffold_->max_step(x, d, bound.step);
  if (around.step < bound.step) {
    bound.step = around.step;
    bound.blocking.clear();
    for (const Index e : around.blocking) bound.blocking.push_back(image_faces_ + e);
  }
  return bound;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
