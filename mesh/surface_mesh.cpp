#include "majorant/mesh/surface_mesh.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <OpenMesh/Core/Mesh/TriConnectivity.hh>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/mesh/internal/length_of.h"
#include "majorant/mesh/internal/mesh_validation.h"

namespace majorant {
namespace {

// Of polygon p of the file.
std::vector<std::array<int, 3>> triangles_of(const PolygonMesh& input, std::size_t p,
                                             const StopCheck& stop) {
  const auto& polygon = input.polygons[p];
  if (polygon.size() == 3) return {{0, 1, 2}};
  std::vector<Vector3> corners;
  for (const Index v : polygon) corners.push_back(input.positions[at(v)]);
  try {
    return triangulate_polygon(corners, stop);
  } catch (const Error& e) {
    throw Error(e.kind(),
                fmt::format("{}: {}", face_place(input, static_cast<Index>(p)), e.what()));
  }
}

TriangleList triangulate(const PolygonMesh& input, const StopCheck& stop) {
  TriangleList list;
  for (std::size_t p = 0; p < input.polygons.size(); ++p) {
    stop.poll_at(p);
    const auto& polygon = input.polygons[p];
    for (const auto& t : triangles_of(input, p, stop)) {
      std::array<Index, 3> f{};
      for (std::size_t k = 0; k < 3; ++k) f[k] = polygon[at(t[k])];
      list.triangles.push_back(f);
      list.polygon.push_back(static_cast<Index>(p));
      list.corners.push_back(t);
    }
  }
  return list;
}

// Every edge has at most two faces that run against each other, every vertex one fan of them.
OpenMesh::TriConnectivity half_edge_structure(const Cells& faces, Index vertex_count,
                                              const StopCheck& stop) {
  OpenMesh::TriConnectivity kernel;
  std::vector<OpenMesh::VertexHandle> handles;
  for (Index v = 0; v < vertex_count; ++v) handles.push_back(kernel.new_vertex());
  for (Index f = 0; f < faces.rows(); ++f) {
    stop.poll_at(at(f));
    const auto corner = [&](int k) { return handles[at(faces(f, k))]; };
    if (!kernel.add_face(corner(0), corner(1), corner(2)).is_valid())
      throw std::logic_error(fmt::format("SurfaceMesh: face {} does not fit the others", f));
  }
  return kernel;
}

// As SurfaceMesh::boundary_loops() has them.
std::vector<std::vector<Index>> boundary_loops_of(const OpenMesh::TriConnectivity& kernel) {
  std::vector<std::vector<Index>> loops;
  std::vector<char> seen(kernel.n_halfedges(), 0);
  for (const auto start : kernel.halfedges()) {
    if (!kernel.is_boundary(start) || seen[at(start.idx())]) continue;
    std::vector<Index> loop;
    for (OpenMesh::HalfedgeHandle h = start; !seen[at(h.idx())];
         h = kernel.next_halfedge_handle(h)) {
      seen[at(h.idx())] = 1;
      loop.push_back(kernel.from_vertex_handle(h).idx());
    }
    std::reverse(loop.begin(), loop.end());  // boundary half-edges run against the faces
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    loops.push_back(std::move(loop));
  }
  std::sort(loops.begin(), loops.end());
  return loops;
}

}  // namespace

SurfaceMesh SurfaceMesh::from_polygons(const PolygonMesh& input, const StopCheck& stop,
                                       Components components) {
  const TriangleList list = triangulate(input, stop);
  require_proper_faces(input, list, stop);
  require_usable_coordinates(input);
  stop.poll();
  require_manifold_edges(input, list);
  stop.poll();
  if (components == Components::One) require_one_component(input, list);
  stop.poll();

  SurfaceMesh mesh;
  mesh.file_ = input.file;
  mesh.input_face_ = list.polygon;
  mesh.vertex_of_input_.assign(input.positions.size(), -1);
  for (const auto& t : list.triangles)
    for (const Index v : t) mesh.vertex_of_input_[at(v)] = 0;
  for (std::size_t v = 0; v < input.positions.size(); ++v) {
    if (mesh.vertex_of_input_[v] < 0) continue;
    mesh.vertex_of_input_[v] = static_cast<Index>(mesh.input_vertex_.size());
    mesh.input_vertex_.push_back(static_cast<Index>(v));
  }
  mesh.positions_.resize(static_cast<Index>(mesh.input_vertex_.size()), 3);
  for (Index v = 0; v < mesh.vertex_count(); ++v)
    mesh.positions_.row(v) = input.positions[at(mesh.input_vertex(v))];
  const bool textured = !input.polygon_texcoords.empty() &&
                        std::none_of(input.polygon_texcoords.begin(), input.polygon_texcoords.end(),
                                     [](const auto& t) { return t.empty(); });
  mesh.faces_.resize(static_cast<Index>(list.triangles.size()), 3);
  if (textured) mesh.corner_texcoords_.resize(mesh.faces_.rows(), 6);
  if (textured) mesh.texcoord_ids_.resize(mesh.faces_.rows(), 3);
  for (Index f = 0; f < mesh.face_count(); ++f)
    for (Index k = 0; k < 3; ++k) {
      const auto t = at(f), c = at(k);
      mesh.faces_(f, k) = mesh.vertex_of_input_[at(list.triangles[t][c])];
      if (!textured) continue;
      const auto& corners = input.polygon_texcoords[at(list.polygon[t])];
      const Index vt = corners[at(list.corners[t][c])];
      mesh.texcoord_ids_(f, k) = vt;
      mesh.corner_texcoords_.row(f).segment<2>(2 * k) = input.texcoords[at(vt)];
    }
  mesh.build_connectivity(stop);
  return mesh;
}

// The faces are edge-manifold and oriented by now. Where OpenMesh refuses a face it says so on a
// stream of the whole process: what it would refuse is found before.
void SurfaceMesh::build_connectivity(const StopCheck& stop) {
  opposite_ = opposite_half_edges(faces_);
  stop.poll();
  if (const Index v = find_touching_vertex(faces_, opposite_); v >= 0)
    throw Error(ErrorKind::Unsupported,
                fmt::format("{}: vertex {}: sheets of the surface touch there (non-manifold); "
                            "duplicate the vertex",
                            file_, input_vertex(v) + 1));
  const OpenMesh::TriConnectivity kernel = half_edge_structure(faces_, vertex_count(), stop);
  boundary_loops_ = boundary_loops_of(kernel);
  const std::vector<Index> component = face_components(opposite_);
  const Index components =
      component.empty() ? 0 : *std::max_element(component.begin(), component.end()) + 1;
  topology_ = {vertex_count(), static_cast<Index>(kernel.n_edges()), face_count(), components,
               static_cast<Index>(boundary_loops_.size())};
  for (Index f = 0; f < face_count(); ++f) {
    const Vector3 a = positions_.row(faces_(f, 1)) - positions_.row(faces_(f, 0));
    const Vector3 b = positions_.row(faces_(f, 2)) - positions_.row(faces_(f, 0));
    area_ += 0.5 * length_of(a.cross(b));
  }
}

std::vector<char> SurfaceMesh::boundary_flags() const {
  std::vector<char> flags(at(vertex_count()), 0);
  for (const auto& loop : boundary_loops_)
    for (const Index v : loop) flags[at(v)] = 1;
  return flags;
}

SurfaceMesh SurfaceMesh::cut_along(const std::vector<char>& is_cut,
                                   std::vector<Index>* surface_vertex) const {
  SurfaceMesh out;
  out.file_ = file_;
  out.input_face_ = input_face_;
  out.corner_texcoords_ = corner_texcoords_;
  out.texcoord_ids_ = texcoord_ids_;
  out.faces_ = Cells::Constant(face_count(), 3, -1);
  out.vertex_of_input_ = vertex_of_input_;
  out.input_vertex_ = input_vertex_;
  std::vector<Index> copy_of(at(vertex_count()));
  std::iota(copy_of.begin(), copy_of.end(), 0);
  std::vector<char> met(copy_of.size(), 0);
  const auto copy = [&](Index h) -> Index& { return out.faces_(face_of(h), corner_of(h)); };
  // The corner of the next face around a vertex, across the half-edge that leaves or enters it.
  const auto crossed = [&](Index h) { return is_cut[at(h)] ? -1 : opposite(h); };
  for (Index c = 0; c < half_edge_count(); ++c) {
    if (copy(c) >= 0) continue;
    const Index v = from_vertex(c);
    Index number = v;
    if (met[at(v)]) {
      number = static_cast<Index>(copy_of.size());
      copy_of.push_back(v);
      out.input_vertex_.push_back(input_vertex(v));
    }
    met[at(v)] = 1;
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
  out.positions_.resize(static_cast<Index>(copy_of.size()), 3);
  for (std::size_t v = 0; v < copy_of.size(); ++v)
    out.positions_.row(static_cast<Index>(v)) = positions_.row(copy_of[v]);
  out.build_connectivity();
  if (surface_vertex) *surface_vertex = std::move(copy_of);
  return out;
}

SurfaceMesh SurfaceMesh::with_faces(const Cells& faces, std::vector<Index> input_face) const {
  SurfaceMesh out;
  out.file_ = file_;
  out.positions_ = positions_;
  out.faces_ = faces;
  out.input_vertex_ = input_vertex_;
  out.input_face_ = std::move(input_face);
  out.vertex_of_input_ = vertex_of_input_;
  out.build_connectivity();
  return out;
}

void SurfaceMesh::require_disk() const {
  const auto refuse = [&](const std::string& what) {
    throw Error(ErrorKind::Unsupported, fmt::format("{}: {}", file_, what));
  };
  const Index genus_twice = 2 - topology_.boundary_loops - topology_.euler_characteristic();
  if (topology_.boundary_loops == 0)
    refuse(fmt::format("the surface is closed (genus {}, no boundary); cut it open to a disk",
                       genus_twice / 2));
  if (topology_.boundary_loops > 1)
    refuse(
        fmt::format("the surface has {} boundary loops (a second one passes vertex {}); close "
                    "the holes or cut it open to a disk",
                    topology_.boundary_loops, input_vertex(boundary_loops_[1].front()) + 1));
  if (topology_.euler_characteristic() != 1)
    refuse(
        fmt::format("the surface has genus {} (one boundary loop, Euler characteristic {}); cut "
                    "it open to a disk",
                    genus_twice / 2, topology_.euler_characteristic()));
}

void SurfaceMesh::require_planar() const {
  const Index loops = topology_.boundary_loops;
  if (loops == 0 || topology_.euler_characteristic() != 2 - loops) require_disk();
}

Index SurfaceMesh::find_input_vertex(Index input) const {
  if (input < 0 || at(input) >= vertex_of_input_.size()) return -1;
  return vertex_of_input_[at(input)];
}

}  // namespace majorant
