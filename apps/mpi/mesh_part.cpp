#include "apps/mpi/mesh_part.h"

#include <fmt/format.h>
#include <petscmat.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>
#include <numbers>
#include <numeric>
#include <utility>

#include "apps/mpi/internal/collect.h"
#include "apps/mpi/internal/petsc_call.h"
#include "majorant/constraints/local_injectivity.h"

namespace majorant {
namespace {

// A list of numbers, written and read in the same order.
class Writer {
 public:
  template <class T>
  void number(T value) {
    list_.push_back(static_cast<double>(value));
  }
  template <class List>
  void list(const List& values) {
    number(values.size());
    for (const auto v : values) number(v);
  }
  std::vector<double> take() { return std::move(list_); }

 private:
  std::vector<double> list_;
};

class Reader {
 public:
  explicit Reader(const std::vector<double>& list) : next_(list.begin()) {}
  double number() { return *next_++; }
  Index index() { return static_cast<Index>(number()); }
  std::vector<Index> list() {
    std::vector<Index> values(static_cast<std::size_t>(number()));
    for (Index& v : values) v = index();
    return values;
  }

 private:
  std::vector<double>::const_iterator next_;
};

// The arrays that rank 0 makes for one rank.
struct Piece {
  std::vector<Index> faces;     // of the surface
  std::vector<Index> vertices;  // of the cut surface, by vertex of the surface
  std::map<int, MeshPart::Border> borders;
  MeshPart::Border& border(int rank) {
    return borders.try_emplace(rank, MeshPart::Border{rank, {}, {}, {}}).first->second;
  }
};

class Division {
 public:
  Division(const SurfaceMesh& mesh, const std::vector<int>& rank_of_face, int count)
      : mesh_(mesh),
        rank_(rank_of_face),
        is_cut_(to_size(mesh.half_edge_count()), 0),
        cut_([&] {
          for (Index h = 0; h < mesh.half_edge_count(); ++h)
            is_cut_[h] = mesh.opposite(h) >= 0 && rank(h) != rank(mesh.opposite(h));
          return mesh.cut_along(is_cut_, &surface_vertex_);
        }()),
        pieces_(static_cast<std::size_t>(count)),
        local_face_(to_size(mesh.face_count())),
        local_vertex_(to_size(cut_.vertex_count())) {
    number();
    share_vertices();
    share_edges();
  }

  // Returns the rest triangles of a rank's faces: face, corners.
  std::vector<double> rest_triangles(int rank) const {
    std::vector<double> list;
    for (const RestTriangle& t : mesh_.rest_triangles()) {
      if (rank_[t.face] != rank) continue;
      list.push_back(local_face_[t.face]);
      for (const Vector2& corner : t.corners) list.insert(list.end(), {corner.x(), corner.y()});
    }
    return list;
  }

  std::vector<double> message(int rank) {
    const Piece& piece = pieces_[static_cast<std::size_t>(rank)];
    const std::vector<char> on_boundary = mesh_.boundary_flags();
    Writer out;
    out.number(mesh_.topology().vertices);
    out.number(mesh_.topology().edges);
    out.number(mesh_.topology().faces);
    std::vector<Index> vertex, face_vertices, input_vertex, input_face, boundary, half_edges;
    std::vector<double> positions;
    for (std::size_t v = 0; v < piece.vertices.size(); ++v) {
      const Index surface = surface_vertex_[piece.vertices[v]];
      vertex.push_back(surface);
      input_vertex.push_back(mesh_.input_vertex(surface));
      if (on_boundary[surface]) boundary.push_back(static_cast<Index>(v));
      for (const double x : mesh_.positions().row(surface)) positions.push_back(x);
    }
    for (const Index f : piece.faces) {
      input_face.push_back(mesh_.input_face(f));
      for (Index k = 0; k < 3; ++k) {
        face_vertices.push_back(local_vertex_[cut_.faces()(f, k)]);
        if (mesh_.opposite(3 * f + k) < 0) half_edges.push_back(local(3 * f + k));
      }
    }
    out.list(vertex);
    out.list(piece.faces);
    out.list(input_vertex);
    out.list(input_face);
    out.list(boundary);
    out.list(half_edges);
    out.list(face_vertices);
    out.list(positions);
    out.list(mesh_.file());
    out.list(rest_triangles(rank));
    out.number(piece.borders.size());
    for (const auto& [other, border] : piece.borders) {
      out.number(other);
      out.list(border.owned);
      out.list(border.copies);
      out.list(border.half_edges);
    }
    return out.take();
  }

 private:
  int rank(Index half_edge) const { return rank_[half_edge / 3]; }
  Piece& piece(int rank) { return pieces_[static_cast<std::size_t>(rank)]; }
  Index local(Index half_edge) const { return 3 * local_face_[half_edge / 3] + half_edge % 3; }

  void number() {
    rank_of_vertex_.assign(local_vertex_.size(), 0);
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      Piece& p = piece(rank_[f]);
      local_face_[f] = static_cast<Index>(p.faces.size());
      p.faces.push_back(f);
      for (Index k = 0; k < 3; ++k) rank_of_vertex_[cut_.faces()(f, k)] = rank_[f];
    }
    order_.resize(local_vertex_.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [&](Index a, Index b) {
      return std::make_tuple(surface_vertex_[a], rank_of_vertex_[a], a) <
             std::make_tuple(surface_vertex_[b], rank_of_vertex_[b], b);
    });
    for (const Index v : order_) {
      Piece& p = piece(rank_of_vertex_[v]);
      local_vertex_[v] = static_cast<Index>(p.vertices.size());
      p.vertices.push_back(v);
    }
  }

  // order_ lists the copies of a vertex of the surface next to each other, the owner's first.
  void share_vertices() {
    Index owner = -1;
    for (const Index v : order_) {
      if (owner < 0 || surface_vertex_[v] != surface_vertex_[owner]) {
        owner = v;
        continue;
      }
      const int mine = rank_of_vertex_[owner], other = rank_of_vertex_[v];
      piece(mine).border(other).owned.push_back(local_vertex_[owner]);
      piece(other).border(mine).copies.push_back(local_vertex_[v]);
    }
  }

  void share_edges() {
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      const Index o = mesh_.opposite(h);
      if (!is_cut_[h] || o < h) continue;
      piece(rank(h)).border(rank(o)).half_edges.push_back(local(h));
      piece(rank(o)).border(rank(h)).half_edges.push_back(local(o));
    }
  }

  const SurfaceMesh& mesh_;
  const std::vector<int>& rank_;
  std::vector<char> is_cut_;
  std::vector<Index> surface_vertex_;  // by vertex of the cut surface
  SurfaceMesh cut_;
  std::vector<Piece> pieces_;
  std::vector<Index> local_face_, local_vertex_;  // both by vertex of the cut surface
  std::vector<int> rank_of_vertex_;               // by vertex of the cut surface
  std::vector<Index> order_;
};

SurfaceParts surface_parts(Reader& in, MeshPart& part) {
  SurfaceParts parts;
  parts.input_vertex = in.list();
  parts.input_face = in.list();
  part.boundary_vertices = in.list();
  part.boundary_half_edges = in.list();
  const std::vector<Index> corners = in.list();
  parts.faces = Eigen::Map<const Cells>(corners.data(), static_cast<Index>(corners.size() / 3), 3);
  parts.positions.resize(static_cast<Index>(part.vertex.size()), 3);
  in.number();  // their number
  for (double& x : parts.positions.reshaped<Eigen::RowMajor>()) x = in.number();
  for (const Index letter : in.list()) parts.file.push_back(static_cast<char>(letter));
  const auto numbers = static_cast<int>(in.number());
  for (int k = 0; k < numbers; k += 7) {
    RestTriangle& triangle = parts.rest_triangles.emplace_back();
    triangle.face = in.index();
    for (Vector2& corner : triangle.corners)
      for (double& x : corner) x = in.number();
  }
  return parts;
}

// Returns two unknowns for every node.
std::vector<Index> pairs(const std::vector<Index>& nodes) {
  std::vector<Index> unknowns;
  unknowns.reserve(2 * nodes.size());
  for (const Index node : nodes) {
    unknowns.push_back(2 * node);
    unknowns.push_back(2 * node + 1);
  }
  return unknowns;
}

// Counts of angle sums over the faces of all ranks; the owner of a vertex counts it.
struct AngleCounts {
  Index off = 0;             // inner vertices whose sum is not a full turn
  Index over_full_turn = 0;  // boundary vertices above a full turn
  double largest = 0;        // largest sum on the boundary, radians
};

// Collective.
AngleCounts count_angles(const MeshPart& part, const BezierMap& map) {
  Vec sums = vertex_angle_sums(map.space(), map.control_points());
  const Partition vertices = part.vertices();
  vertices.add_to_owners(sums);
  std::vector<char> on_boundary(to_size(part.mesh->vertex_count()), 0);
  for (const Index v : part.boundary_vertices) on_boundary[v] = 1;
  std::array<double, 2> counts{};
  double largest = 0;
  for (Index v = 0; v < sums.size(); ++v) {
    if (!vertices.owns(v)) continue;
    const double beyond = sums[v] - 2 * std::numbers::pi;
    if (on_boundary[v]) {
      largest = std::max(largest, sums[v]);
      counts[1] += beyond > AngleSums::kTolerance;
    } else {
      counts[0] += !(std::abs(beyond) <= AngleSums::kTolerance);
    }
  }
  part.ranks().sum(counts);
  return {static_cast<Index>(counts[0]), static_cast<Index>(counts[1]), part.ranks().max(largest)};
}

// PTScotch partitions with as many threads as the machine has, and its result then differs from run
// to run.
void divide_on_one_thread() { setenv("SCOTCH_PTHREAD_NUMBER", "1", 1); }

}  // namespace

std::shared_ptr<const Partition> MeshPart::unknowns(const BezierTriangleSpace& space) const {
  std::vector<Partition::Neighbour> neighbours;
  for (const Border& border : borders) {
    std::vector<Index> owned = border.owned, copies = border.copies;
    const bool mine = shared_ranks->rank() < border.rank;
    for (const Index h : border.half_edges) {
      std::vector<Index> nodes = edge_nodes(space, h);
      if (!mine)
        std::reverse(nodes.begin(), nodes.end());  // the direction of the edge on its
                                                   // owner
      std::vector<Index>& list = mine ? owned : copies;
      list.insert(list.end(), nodes.begin() + 1, nodes.end() - 1);
    }
    neighbours.push_back({border.rank, pairs(owned), pairs(copies)});
  }
  return std::make_shared<const Partition>(shared_ranks, 2 * space.node_count(),
                                           std::move(neighbours));
}

Partition MeshPart::vertices() const {
  std::vector<Partition::Neighbour> neighbours;
  for (const Border& b : borders) neighbours.push_back({b.rank, b.owned, b.copies});
  return {shared_ranks, mesh->vertex_count(), std::move(neighbours)};
}

std::vector<Index> MeshPart::boundary_nodes(const BezierTriangleSpace& space) const {
  std::vector<Index> nodes = boundary_vertices;
  for (const Index h : boundary_half_edges) {
    const std::vector<Index> along = edge_nodes(space, h);
    nodes.insert(nodes.end(), along.begin(), along.end());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

std::vector<Index> MeshPart::gauge_vertex() const {
  std::vector<Index> found;  // copies of vertex 0 of the surface, the first vertices here
  for (std::size_t v = 0; v < vertex.size() && vertex[v] == 0; ++v)
    found.push_back(static_cast<Index>(v));
  return found;
}

MeshPart distributed(const SurfaceMesh* mesh, const std::vector<int>& rank_of_face,
                     std::shared_ptr<const Ranks> ranks) {
  std::vector<std::vector<double>> messages;
  if (ranks->rank() == 0) {
    Division division(*mesh, rank_of_face, ranks->count());
    for (int r = 0; r < ranks->count(); ++r) messages.push_back(division.message(r));
  }
  const std::vector<double> message = scattered(*ranks, std::move(messages));
  Reader in(message);
  MeshPart part;
  part.shared_ranks = std::move(ranks);
  for (GlobalIndex* count : {&part.whole.vertices, &part.whole.edges, &part.whole.faces})
    *count = static_cast<GlobalIndex>(in.number());
  part.vertex = in.list();
  part.face = in.list();
  part.mesh = std::make_shared<const SurfaceMesh>(SurfaceMesh::from_parts(surface_parts(in, part)));
  part.borders.resize(static_cast<std::size_t>(in.number()));
  for (MeshPart::Border& border : part.borders) {
    border.rank = static_cast<int>(in.number());
    border.owned = in.list();
    border.copies = in.list();
    border.half_edges = in.list();
  }
  return part;
}

std::string MeshPart::obstacle(const BezierMap& map, const Vec& rest_det, int depth) const {
  Verdict faces;
  if (mesh->face_count() > 0)
    faces = LocalInjectivity(map.shared_space(), rest_det, depth).check(map.control_points());
  const double wrong = ranks().sum(static_cast<double>(faces.blocking.size()));
  if (wrong > 0) return fmt::format("{:.0f} faces are not positively oriented", wrong);
  const AngleCounts angles = count_angles(*this, map);
  if (angles.off == 0) return {};
  return fmt::format("it covers the neighbourhoods of {} vertices more than once", angles.off);
}

MapMeasures MeshPart::measure(const BezierMap& map, const EnergySum& energy,
                              std::string& unproven) const {
  constexpr double kNone = std::numeric_limits<double>::infinity();
  MapMeasures m;
  std::array<double, 4> extremes{kNone, kNone, kNone, kNone};  // the least of these
  std::array<double, 3> sums{};
  if (map.mesh().face_count() > 0) {
    MapMeasures here = measure_map(map, energy);
    const double area = map.mesh().area();
    extremes = {here.sigma_min, -here.sigma_max, -here.max_density, here.min_det.minCoeff()};
    sums = {here.value * area, area, static_cast<double>((here.min_det.array() <= 0).count())};
    m.face_value = std::move(here.face_value);
    m.min_det = std::move(here.min_det);
  }
  ranks().min(extremes);
  ranks().sum(sums);
  m.sigma_min = extremes[0];
  m.sigma_max = -extremes[1];
  m.max_density = -extremes[2];
  m.value = sums[0] / sums[1];
  const AngleCounts angles = count_angles(*this, map);
  m.boundary_over_full_turn = angles.over_full_turn;
  m.max_boundary_angle = angles.largest;
  m.locally_injective = extremes[3] > 0 && angles.off == 0;
  if (!m.locally_injective)
    unproven = fmt::format(
        "{:.0f} faces are not proven to be positively oriented, angle sums at {} vertices are not "
        "full turns",
        sums[2], angles.off);
  return m;
}

// The dual graph on rank 0: a row for each face, an entry for each neighbour across an edge.
std::vector<int> face_ranks(const SurfaceMesh& mesh, int count) {
  std::vector<int> ranks(to_size(mesh.face_count()), 0);
  if (count == 1) return ranks;
  if (mesh.face_count() <= count) {  // one face for each of the first ranks
    for (std::size_t f = 0; f < ranks.size(); ++f) ranks[f] = static_cast<int>(f);
    return ranks;
  }
  const PetscInt faces = mesh.face_count();
  PetscInt *starts = nullptr, *neighbours = nullptr;  // freed by the matrix
  require_petsc(PetscMalloc1(faces + 1, &starts));
  require_petsc(PetscMalloc1(3 * faces, &neighbours));
  PetscInt filled = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    starts[f] = filled;
    for (Index k = 0; k < 3; ++k)
      if (const Index o = mesh.opposite(3 * f + k); o >= 0) neighbours[filled++] = o / 3;
  }
  starts[faces] = filled;
  Mat graph = nullptr;
  MatPartitioning partitioning = nullptr;
  IS of_faces = nullptr;
  divide_on_one_thread();
  require_petsc(
      MatCreateMPIAdj(PETSC_COMM_SELF, faces, faces, starts, neighbours, nullptr, &graph));
  require_petsc(MatPartitioningCreate(PETSC_COMM_SELF, &partitioning));
  require_petsc(MatPartitioningSetAdjacency(partitioning, graph));
  require_petsc(MatPartitioningSetType(partitioning, MATPARTITIONINGPTSCOTCH));
  require_petsc(MatPartitioningSetNParts(partitioning, count));
  require_petsc(MatPartitioningApply(partitioning, &of_faces));
  const PetscInt* parts = nullptr;
  require_petsc(ISGetIndices(of_faces, &parts));
  for (std::size_t f = 0; f < ranks.size(); ++f) ranks[f] = static_cast<int>(parts[f]);
  require_petsc(ISRestoreIndices(of_faces, &parts));
  ISDestroy(&of_faces);
  MatPartitioningDestroy(&partitioning);
  MatDestroy(&graph);
  return ranks;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
