#include "majorant/mesh/surface_mesh.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "majorant/framework/argument_check.h"
#include "majorant/framework/error.h"
#include "majorant/framework/side_task.h"
#include "majorant/mesh/connectivity.h"
#include "majorant/mesh/geometry.h"
#include "majorant/mesh/mesh_messages.h"
#include "majorant/mesh/mesh_validation.h"
#include "majorant/mesh/refusal.h"
#include "majorant/mesh/triangle_list.h"

namespace majorant {
namespace {

// Returns one more than the largest vertex. Throws InvalidArgument for a negative one.
Index vertex_bound(const Cells& faces) {
  if (faces.size() == 0) return 0;
  if (const Index v = faces.minCoeff(); v < 0)
    throw InvalidArgument(fmt::format("opposite_half_edges: there is no vertex {}", v));
  return faces.maxCoeff() + 1;
}

}  // namespace

std::vector<Index> opposite_half_edges(const Cells& faces) {
  if (faces.rows() > 0 && faces.cols() != 3)
    throw InvalidArgument(
        fmt::format("opposite_half_edges: faces have {} columns, 3 are needed", faces.cols()));
  PairedSides sides =
      pair_sides(vertex_bound(faces), 3 * static_cast<Index>(faces.rows()),
                 [&](Index h) { return std::pair(from_vertex(faces, h), to_vertex(faces, h)); });
  if (sides.is_manifold()) return std::move(sides.opposite);
  std::vector<std::pair<Index, Index>> wrong;  // the first edge of each kind
  for (const Index h : {sides.crowded.empty() ? Index{-1} : sides.crowded[0][0],
                        sides.same_way.empty() ? Index{-1} : sides.same_way[0]})
    if (h >= 0) wrong.push_back(std::minmax({from_vertex(faces, h), to_vertex(faces, h)}));
  const auto [low, high] = *std::min_element(wrong.begin(), wrong.end());
  throw InvalidArgument(
      fmt::format("opposite_half_edges: edge ({}, {}) has more than two faces, or two that run "
                  "the same way",
                  low, high));
}

std::vector<std::vector<Index>> boundary_half_edges(const Cells& faces,
                                                    const std::vector<Index>& opposite) {
  const auto from = [&](Index h) { return from_vertex(faces, h); };
  std::vector<std::vector<Index>> loops = border_loops<3>(opposite);
  for (std::vector<Index>& loop : loops)
    std::ranges::rotate(loop, std::ranges::min_element(loop, {}, from));
  std::ranges::sort(loops, {}, [&](const std::vector<Index>& loop) { return from(loop.front()); });
  return loops;
}

std::vector<Index> face_components(const std::vector<Index>& opposite) {
  return components_of_faces<3>(opposite);
}

Index find_touching_vertex(const Cells& faces, const std::vector<Index>& opposite) {
  const std::vector<Index> touching =
      touching_vertices<3>(opposite, [&](Index h) { return from_vertex(faces, h); });
  return touching.empty() ? -1 : touching.front();
}

namespace {

void require_sound(const SurfaceParts& parts) {
  const Index vertices = static_cast<Index>(parts.positions.rows());
  const Index count = static_cast<Index>(parts.faces.rows());
  if (parts.faces.cols() != 3)
    throw InvalidArgument(
        fmt::format("SurfaceMesh: faces have {} columns, 3 are needed", parts.faces.cols()));
  for (Index f = 0; f < count; ++f)
    for (const Index v : parts.faces.row(f))
      if (v < 0 || v >= vertices)
        throw InvalidArgument(
            fmt::format("SurfaceMesh: face {} has vertex {}, there are {}", f, v, vertices));
  require_finite_rows("the positions of a SurfaceMesh", parts.positions);
  require_size("SurfaceMesh: input_vertex", static_cast<Index>(parts.input_vertex.size()),
               vertices);
  require_size("SurfaceMesh: input_face", static_cast<Index>(parts.input_face.size()), count);
  if (parts.corner_texcoords.rows() > 0 || parts.texcoord_ids.rows() > 0) {
    require_size("SurfaceMesh: corner_texcoords", parts.corner_texcoords.rows(), count);
    require_size("SurfaceMesh: texcoord_ids", parts.texcoord_ids.rows(), count);
  }
  for (const RestTriangle& t : parts.rest_triangles)
    require_index("SurfaceMesh: the face of a rest triangle", t.face, count);
}

}  // namespace

SurfaceMesh SurfaceMesh::from_polygons(const PolygonMesh& input, const StopCheck& stop,
                                       Components components, Shapes shapes) {
  require_sound_lists(input);
  const TriangleList list = triangulate(input, Crossing::Refused, stop);
  both(
      [&] {
        require_proper_faces(input, list, shapes, stop);
        if (shapes == Shapes::Proper) require_usable_coordinates(input);
        stop.poll();
      },
      [&] {
        require_manifold_edges(input, list);
        stop.poll();
        if (components == Components::One) require_one_component(input, list);
        stop.poll();
      });

  SurfaceParts parts;
  parts.file = input.file;
  parts.input_face = list.polygon;
  std::vector<Index> number(input.positions.size(), -1);
  for (const auto& t : list.triangles)
    for (const Index v : t) number[v] = 0;
  for (std::size_t v = 0; v < input.positions.size(); ++v) {
    if (number[v] < 0) continue;
    number[v] = static_cast<Index>(parts.input_vertex.size());
    parts.input_vertex.push_back(static_cast<Index>(v));
  }
  parts.positions.resize(static_cast<Index>(parts.input_vertex.size()), 3);
  for (Index v = 0; v < parts.positions.rows(); ++v)
    parts.positions.row(v) = input.positions[parts.input_vertex[v]];
  parts.faces.resize(static_cast<Index>(list.triangles.size()), 3);
  for (Index f = 0; f < parts.faces.rows(); ++f)
    for (Index k = 0; k < 3; ++k) parts.faces(f, k) = number[list.triangles[f][k]];
  place_texcoords(input, list, parts);
  return from_parts(std::move(parts), stop);
}

SurfaceMesh SurfaceMesh::from_arrays(const Eigen::Ref<const RowMatrix>& positions,
                                     const Eigen::Ref<const Cells>& faces, const StopCheck& stop) {
  if (positions.cols() != 3)
    throw InvalidArgument(
        fmt::format("SurfaceMesh::from_arrays: positions have {} columns, 3 are "
                    "needed",
                    positions.cols()));
  PolygonMesh input;
  for (const auto& p : positions.rowwise()) input.positions.push_back(p.transpose());
  for (const auto& f : faces.rowwise())
    input.polygons.push_back(std::vector<Index>(f.begin(), f.end()));
  return from_polygons(input, stop);
}

SurfaceMesh SurfaceMesh::from_parts(SurfaceParts parts, const StopCheck& stop) {
  require_sound(parts);
  SurfaceMesh mesh;
  mesh.file_ = std::move(parts.file);
  mesh.origin_ = parts.origin;
  mesh.positions_ = std::move(parts.positions);
  mesh.faces_ = std::move(parts.faces);
  mesh.input_vertex_ = std::move(parts.input_vertex);
  mesh.input_face_ = std::move(parts.input_face);
  mesh.corner_texcoords_ = std::move(parts.corner_texcoords);
  mesh.texcoord_ids_ = std::move(parts.texcoord_ids);
  mesh.rest_triangles_ = std::move(parts.rest_triangles);
  mesh.build_connectivity(stop);
  return mesh;
}

SurfaceParts SurfaceMesh::parts() const {
  return {.file = file_,
          .origin = origin_,
          .positions = positions_,
          .faces = faces_,
          .input_vertex = input_vertex_,
          .input_face = input_face_,
          .corner_texcoords = corner_texcoords_,
          .texcoord_ids = texcoord_ids_,
          .rest_triangles = rest_triangles_};
}

// The faces must be edge-manifold and oriented.
void SurfaceMesh::build_connectivity(const StopCheck& stop) {
  vertex_of_input_.reserve(to_size(vertex_count()));
  for (Index v = 0; v < vertex_count(); ++v) vertex_of_input_.emplace_back(input_vertex(v), v);
  if (!std::is_sorted(vertex_of_input_.begin(), vertex_of_input_.end()))
    std::sort(vertex_of_input_.begin(), vertex_of_input_.end());
  opposite_ = opposite_half_edges(faces_);
  stop.poll();
  const auto refuse_touching = [this] {
    if (const Index v = find_touching_vertex(faces_, opposite_); v >= 0)
      throw Refusal(ErrorKind::Unsupported, file_,
                    fmt::format("{}vertex {}: sheets of the surface touch there (non-manifold); ",
                                message_prefix(file_), shown_number(file_, input_vertex(v))),
                    Hint::Repair, " duplicates the vertex");
  };
  std::vector<Index> component;
  both([&] { refuse_touching(); }, [&] { component = face_components(opposite_); });
  stop.poll();
  Index boundary_edges = 0;
  for (const std::vector<Index>& half_edges : boundary_half_edges(faces_, opposite_)) {
    boundary_edges += static_cast<Index>(half_edges.size());
    std::vector<Index>& loop = boundary_loops_.emplace_back();
    for (const Index h : half_edges) loop.push_back(from_vertex(h));
  }
  stop.poll();
  topology_ = {vertex_count(), (half_edge_count() + boundary_edges) / 2, face_count(),
               component_count(component), static_cast<Index>(boundary_loops_.size())};
  auto rest = rest_triangles_.begin();
  for (Index f = 0; f < face_count(); ++f) {
    if (rest != rest_triangles_.end() && rest->face == f) {
      const auto& c = rest++->corners;
      area_ += 0.5 * cross(c[1] - c[0], c[2] - c[0]);
      continue;
    }
    const Vector3 a = positions_.row(faces_(f, 1)) - positions_.row(faces_(f, 0));
    const Vector3 b = positions_.row(faces_(f, 2)) - positions_.row(faces_(f, 0));
    area_ += 0.5 * length_of(a.cross(b));
  }
}

std::vector<char> SurfaceMesh::boundary_flags() const {
  std::vector<char> flags(to_size(vertex_count()), 0);
  for (const auto& loop : boundary_loops_)
    for (const Index v : loop) flags[v] = 1;
  return flags;
}

SurfaceMesh SurfaceMesh::cut_along(const std::vector<char>& is_cut,
                                   std::vector<Index>* surface_vertex) const {
  require_size("SurfaceMesh::cut_along: is_cut", static_cast<Index>(is_cut.size()),
               half_edge_count());
  for (Index h = 0; h < half_edge_count(); ++h)
    if (const Index o = opposite(h); o >= 0 && !is_cut[h] != !is_cut[o])
      throw InvalidArgument(
          fmt::format("SurfaceMesh::cut_along: half-edge {} is cut, its opposite "
                      "{} is not",
                      is_cut[h] ? h : o, is_cut[h] ? o : h));
  SurfaceParts out = parts();
  out.faces.setConstant(-1);
  std::vector<Index> copy_of(to_size(vertex_count()));
  std::iota(copy_of.begin(), copy_of.end(), 0);
  std::vector<char> met(copy_of.size(), 0);
  const auto copy = [&](Index h) -> Index& { return out.faces(face_of(h), corner_of(h)); };
  // Returns the corner of the next face around a vertex, across the half-edge that leaves or enters
  // it.
  const auto crossed = [&](Index h) { return is_cut[h] ? -1 : opposite(h); };
  for (Index c = 0; c < half_edge_count(); ++c) {
    if (copy(c) >= 0) continue;
    const Index v = from_vertex(c);
    Index number = v;
    if (met[v]) {
      number = static_cast<Index>(copy_of.size());
      copy_of.push_back(v);
      out.input_vertex.push_back(input_vertex(v));
    }
    met[v] = 1;
    for (Index h = c; h >= 0 && copy(h) < 0;) {
      copy(h) = number;
      h = crossed(previous(h));
    }
    for (Index h = crossed(c); h >= 0;) {
      const Index corner = next(h);
      if (copy(corner) >= 0) break;
      copy(corner) = number;
      h = crossed(corner);
    }
  }
  out.positions.resize(static_cast<Index>(copy_of.size()), 3);
  for (std::size_t v = 0; v < copy_of.size(); ++v)
    out.positions.row(static_cast<Index>(v)) = positions_.row(copy_of[v]);
  if (surface_vertex) *surface_vertex = std::move(copy_of);
  return from_parts(std::move(out));
}

std::vector<SurfacePiece> SurfaceMesh::split(const StopCheck& stop) const {
  const std::vector<Index> component = face_components(opposite_);
  std::vector<SurfacePiece> pieces(to_size(topology_.components));
  std::vector<Index> number(to_size(vertex_count()), -1);  // within its only piece
  for (Index f = 0; f < face_count(); ++f) pieces[component[f]].face.push_back(f);
  auto rest = rest_triangles_;
  std::stable_sort(rest.begin(), rest.end(), [&](const RestTriangle& a, const RestTriangle& b) {
    return component[a.face] < component[b.face];
  });
  auto next_rest = rest.begin();
  for (SurfacePiece& piece : pieces) {
    stop.poll();
    const auto count = static_cast<Index>(piece.face.size());
    for (const Index f : piece.face)
      for (Index k = 0; k < 3; ++k) piece.vertex.push_back(faces_(f, k));
    std::sort(piece.vertex.begin(), piece.vertex.end());
    piece.vertex.erase(std::unique(piece.vertex.begin(), piece.vertex.end()), piece.vertex.end());
    SurfaceParts parts;
    parts.file = file_;
    parts.origin = origin_;
    for (std::size_t v = 0; v < piece.vertex.size(); ++v) {
      number[piece.vertex[v]] = static_cast<Index>(v);
      parts.input_vertex.push_back(input_vertex(piece.vertex[v]));
    }
    parts.positions = positions_(piece.vertex, Eigen::all);
    parts.faces = faces_(piece.face, Eigen::all);
    for (Index& v : parts.faces.reshaped()) v = number[v];
    for (const Index f : piece.face) parts.input_face.push_back(input_face(f));
    if (corner_texcoords_.rows() > 0) {
      parts.corner_texcoords = corner_texcoords_(piece.face, Eigen::all);
      parts.texcoord_ids = texcoord_ids_(piece.face, Eigen::all);
    }
    for (Index f = 0; f < count && next_rest != rest.end(); ++f)
      if (next_rest->face == piece.face[f])
        parts.rest_triangles.push_back({f, next_rest++->corners});
    piece.mesh = std::make_shared<const SurfaceMesh>(from_parts(std::move(parts)));
  }
  return pieces;
}

SurfaceMesh SurfaceMesh::with_faces(const Cells& faces, std::vector<Index> input_face) const {
  SurfaceParts out;
  out.file = file_;
  out.origin = origin_;
  out.positions = positions_;
  out.faces = faces;
  out.input_vertex = input_vertex_;
  out.input_face = std::move(input_face);
  return from_parts(std::move(out));
}

Vector3 SurfaceMesh::input_position(Index v) const {
  const Vector3 here = positions_.row(v);
  return origin_.isZero(0) ? here : Vector3(here + origin_);
}

void SurfaceMesh::require_disk() const {
  const auto refuse = [&](const std::string& what, Hint hint) {
    throw Refusal(ErrorKind::Unsupported, file_, message_prefix(file_) + what + "; ", hint);
  };
  if (topology_.boundary_loops == 0)
    refuse(fmt::format("the surface is closed (genus {}, no boundary)", genus(*this)),
           Hint::CutOpen);
  if (topology_.boundary_loops > 1)
    refuse(fmt::format("the surface has {} boundary loops (a second one passes vertex {})",
                       topology_.boundary_loops,
                       shown_number(file_, input_vertex(boundary_loops_[1].front()))),
           Hint::MapWithHoles);
  if (topology_.euler_characteristic() != 1)
    refuse(fmt::format("the surface has genus {} (one boundary loop, Euler characteristic {})",
                       genus(*this), topology_.euler_characteristic()),
           Hint::CutOpen);
}

void SurfaceMesh::require_planar() const {
  if (!is_planar(*this)) require_disk();
}

Index SurfaceMesh::find_input_vertex(Index input) const {
  const auto found = std::lower_bound(vertex_of_input_.begin(), vertex_of_input_.end(),
                                      std::pair<Index, Index>(input, -1));
  return found != vertex_of_input_.end() && found->first == input ? found->second : -1;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
