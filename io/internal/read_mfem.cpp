// MFEM mesh v1.0, v1.2 (with an end mark, also of a piece of a parallel mesh), v1.3 (with named
// sets of attributes). They hold elements, their boundary, and vertices, or nodes that are a grid
// function of H1 or L2. Degrees of freedom are numbered as in MFEM: vertices, then edges and faces
// in the order of the cells, then interiors (mesh/mesh.cpp: GetElementToEdgeTable,
// GetElementToFaceTable; fem/fe_coll.cpp: H1_FECollection).
#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <map>
#include <unordered_map>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/cell_collector.h"
#include "majorant/io/internal/cell_readers.h"
#include "majorant/io/internal/source_file.h"
#include "majorant/io/internal/text_cursor.h"
#include "majorant/volumes/node_orders.h"

namespace majorant {
namespace {

// Local vertices of edges and faces, in MFEM's order (fem/geom.cpp).
struct MfemShape {
  CellShape shape;
  std::vector<std::array<int, 2>> edges;
  std::vector<std::vector<int>> faces;  // of 3D cells
};

const MfemShape& mfem_shape(std::int64_t geometry) {
  using enum CellShape;
  static const std::vector<MfemShape> kGeometries{
      {Point, {}, {}},
      {Segment, {{0, 1}}, {}},
      {Triangle, {{0, 1}, {1, 2}, {2, 0}}, {}},
      {Quad, {{0, 1}, {1, 2}, {2, 3}, {3, 0}}, {}},
      {Tetrahedron,
       {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}},
       {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}},
      {Hexahedron,
       {{0, 1},
        {1, 2},
        {3, 2},
        {0, 3},
        {4, 5},
        {5, 6},
        {7, 6},
        {4, 7},
        {0, 4},
        {1, 5},
        {2, 6},
        {3, 7}},
       {{3, 2, 1, 0}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}, {4, 5, 6, 7}}},
      {Wedge,
       {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}},
       {{0, 2, 1}, {3, 4, 5}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}}};
  return kGeometries[static_cast<std::size_t>(geometry)];
}

struct MfemElement {
  std::int64_t attribute;
  const MfemShape* shape;
  std::vector<Index> vertices;
  std::size_t place = 0;  // of the first vertex in the file
};

// Returns the position of the lattice point (i, j), i + j <= n, in a row-by-row order.
int triangle_place(int i, int j, int n) { return j * (n + 1) - j * (j - 1) / 2 + i; }

// The contents of "FiniteElementCollection".
struct NodeSpace {
  bool is_discontinuous = false;
  int degree = 1;
  NodeKind kind = NodeKind::Uniform;
  // True for "Cubic", which orders the inner nodes of a hexahedron counterclockwise in each of two
  // layers (fem/fe, constructor of LagrangeHexFiniteElement). H1 orders them by coordinates.
  bool goes_round = false;
  bool has_quads_alone = false;  // "QuadraticPos" has no other elements

  int inner_place(CellShape shape, const Exponents& e) const;
};

NodeSpace node_space(const std::string& path, const std::string& name) {
  if (name == "Linear") return {};
  if (name == "Quadratic") return {false, 2, NodeKind::Uniform};
  if (name == "Cubic") return {false, 3, NodeKind::Uniform, true};
  if (name == "QuadraticPos") return {false, 2, NodeKind::ControlPoints, false, true};
  const auto unknown = [&] {
    refuse_mesh(path, fmt::format("nodes of the space {}; H1 and L2 at closed uniform or "
                                  "Gauss-Lobatto points or with control points are supported",
                                  name));
  };
  const std::size_t underline = name.find('_'), degree = name.rfind("_P");
  if (underline == std::string::npos || degree == std::string::npos || degree + 2 >= name.size() ||
      !std::all_of(name.begin() + static_cast<std::ptrdiff_t>(degree) + 2, name.end(),
                   [](char c) { return c >= '0' && c <= '9'; }) ||
      name.size() - degree > 4)
    unknown();
  NodeSpace space;
  space.degree = std::stoi(name.substr(degree + 2));
  const std::string family = name.substr(0, underline);
  if (family == "H1" || family == "H1@G" || name.starts_with("L2_T1_"))
    space.kind = NodeKind::GaussLobatto;
  else if (family == "H1Pos" || family == "H1@P" || name.starts_with("L2_T2_"))
    space.kind = NodeKind::ControlPoints;
  else if (family != "H1@U" && !name.starts_with("L2_T4_"))
    unknown();
  space.is_discontinuous = family == "L2";
  // Up to degree 2 the points of both kinds agree.
  if (space.degree <= 2 && space.kind == NodeKind::GaussLobatto) space.kind = NodeKind::Uniform;
  return space;
}

// Edges and faces of a mesh with MFEM's numbers.
class MfemTopology {
 public:
  explicit MfemTopology(const std::vector<MfemElement>& elements) {
    for (const MfemElement& e : elements) {
      for (const auto& [a, b] : e.shape->edges)
        edges_.emplace(edge_key(e.vertices[to_size(a)], e.vertices[to_size(b)]),
                       static_cast<Index>(edges_.size()));
      for (const std::vector<int>& face : e.shape->faces) {
        std::vector<Index> base;
        for (const int k : face) base.push_back(e.vertices[to_size(k)]);
        if (faces_.emplace(face_key(base), static_cast<Index>(bases_.size())).second)
          bases_.push_back(base);
      }
    }
  }

  Index edge_count() const { return static_cast<Index>(edges_.size()); }
  Index edge(Index a, Index b) const {  // -1: none
    const auto found = edges_.find(edge_key(a, b));
    return found == edges_.end() ? -1 : found->second;
  }
  Index face(const std::vector<Index>& vertices) const {
    const auto found = faces_.find(face_key(vertices));
    return found == faces_.end() ? -1 : found->second;
  }
  // returns the vertices of faces
  const std::vector<std::vector<Index>>& bases() const { return bases_; }

 private:
  static std::uint64_t edge_key(Index a, Index b) {
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) |
           static_cast<std::uint64_t>(std::max(a, b));
  }
  static std::vector<Index> face_key(std::vector<Index> vertices) {
    std::sort(vertices.begin(), vertices.end());
    return vertices;
  }
  std::unordered_map<std::uint64_t, Index> edges_;
  std::map<std::vector<Index>, Index> faces_;
  std::vector<std::vector<Index>> bases_;
};

// These return the number of inner nodes of a triangle and of a square.
int triangle_interior(int n) { return (n - 1) * (n - 2) / 2; }
int square_interior(int n) { return (n - 1) * (n - 1); }
int cell_interior(CellShape shape, int n) {
  switch (shape) {
    case CellShape::Triangle:
      return triangle_interior(n);
    case CellShape::Quad:
      return square_interior(n);
    case CellShape::Tetrahedron:
      return (n - 1) * (n - 2) * (n - 3) / 6;
    case CellShape::Hexahedron:
      return square_interior(n) * (n - 1);
    case CellShape::Wedge:
      return triangle_interior(n) * (n - 1);
    default:
      return 0;  // the inner nodes of a segment belong to its edge
  }
}

// Returns the place of an inner node among those of the cell.
int NodeSpace::inner_place(CellShape shape, const Exponents& e) const {
  const int n = degree, m = n - 1;
  switch (shape) {
    case CellShape::Triangle:
      return triangle_place(e[1] - 1, e[2] - 1, n - 3);
    case CellShape::Quad:
      return e[1] - 1 + m * (e[3] - 1);
    case CellShape::Hexahedron: {
      const int i = e[1] - 1, j = e[3] - 1, k = e[5] - 1;
      if (goes_round) return (j == 0 ? i : 3 - i) + 4 * k;
      return i + m * (j + m * k);
    }
    case CellShape::Wedge:
      return triangle_place(e[1] - 1, e[2] - 1, n - 3) + triangle_interior(n) * (e[4] - 1);
    default:
      return 0;  // tetrahedra up to degree 4 have one inner node, segments none
  }
}

// Degrees of freedom of H1: vertices, edges, faces, interiors.
class ContinuousNodes {
 public:
  ContinuousNodes(const std::vector<MfemElement>& elements, Index vertices, const NodeSpace& space)
      : topology_(elements), vertices_(vertices), space_(space), n_(space.degree) {
    Index next = vertices_ + topology_.edge_count() * (n_ - 1);
    for (const auto& base : topology_.bases()) {
      face_begin_.push_back(next);
      next += base.size() == 3 ? triangle_interior(n_) : square_interior(n_);
    }
    for (const MfemElement& e : elements) {
      interior_begin_.push_back(next);
      next += cell_interior(e.shape->shape, n_);
    }
    count_ = next;
  }

  Index count() const { return count_; }

  // Returns the nodes of an element, in VTK's order. cell: its number; -1 for a boundary element.
  // Empty if a boundary element is on no element.
  std::vector<Index> of(const MfemElement& element, Index cell) const {
    const CellShape shape = element.shape->shape;
    if (nodes_.count(shape) == 0) nodes_[shape] = {vtk_order(shape, n_), corner_weights(shape, n_)};
    const auto& [lattice, weights] = nodes_.at(shape);
    std::vector<Index> out;
    for (std::size_t k = 0; k < lattice.size(); ++k) {
      out.push_back(node(element, cell, lattice[k], weights[k]));
      if (out.back() < 0) return {};
    }
    return out;
  }

 private:
  Index node(const MfemElement& element, Index cell, const Exponents& e,
             const std::array<int, 8>& weights) const {
    std::vector<Index> on;
    std::vector<int> weight;
    for (std::size_t c = 0; c < element.vertices.size(); ++c)
      if (weights[c] != 0) {
        on.push_back(element.vertices[c]);
        weight.push_back(weights[c]);
      }
    if (on.size() == 1) return on[0];
    if (on.size() == 2) {  // from the smaller vertex to the larger
      const Index edge = topology_.edge(on[0], on[1]);
      if (edge < 0) return -1;
      const int at = on[0] < on[1] ? weight[1] : weight[0], all = weight[0] + weight[1];
      return vertices_ + edge * (n_ - 1) + at * n_ / all - 1;
    }
    const bool is_interior = cell >= 0 && on.size() == element.vertices.size();
    // Control points inside the lower triangle of a wedge follow the order of the triangle, which
    // is opposite to that of the face (fem/fe: H1Pos_WedgeElement).
    if (space_.kind == NodeKind::ControlPoints && element.shape->shape == CellShape::Wedge &&
        weights[3] == 0 && weights[4] == 0 && weights[5] == 0)
      std::swap(weight[1], weight[2]);
    if (is_interior)
      return interior_begin_[to_size(cell)] + space_.inner_place(element.shape->shape, e);
    const Index face = topology_.face(on);
    if (face < 0) return -1;
    const std::vector<Index>& base = topology_.bases()[to_size(face)];
    std::vector<int> w;
    int all = 0;
    for (const Index v : base) {
      w.push_back(
          weight[static_cast<std::size_t>(std::find(on.begin(), on.end(), v) - on.begin())]);
      all += w.back();
    }
    if (base.size() == 3)
      return face_begin_[to_size(face)] +
             triangle_place(w[1] * n_ / all - 1, w[2] * n_ / all - 1, n_ - 3);
    const int i = (w[1] + w[2]) * n_ / all - 1, j = (w[2] + w[3]) * n_ / all - 1;
    return face_begin_[to_size(face)] + i + j * (n_ - 1);
  }

  MfemTopology topology_;
  Index vertices_;
  NodeSpace space_;
  int n_;
  std::vector<Index> face_begin_, interior_begin_;
  Index count_ = 0;
  mutable std::map<CellShape, std::pair<std::vector<Exponents>, std::vector<std::array<int, 8>>>>
      nodes_;
};

// Returns the place of a node among those of an L2 element: by coordinates, the first one fastest.
int discontinuous_place(CellShape shape, const Exponents& e, int n) {
  const int layer = (n + 1) * (n + 2) / 2;
  switch (shape) {
    case CellShape::Triangle:
      return triangle_place(e[1], e[2], n);
    case CellShape::Quad:
      return e[1] + (n + 1) * e[3];
    case CellShape::Tetrahedron: {
      int before = 0;
      for (int k = 0; k < e[3]; ++k) before += (n - k + 1) * (n - k + 2) / 2;
      return before + triangle_place(e[1], e[2], n - e[3]);
    }
    case CellShape::Hexahedron:
      return e[1] + (n + 1) * (e[3] + (n + 1) * e[5]);
    case CellShape::Wedge:
      return triangle_place(e[1], e[2], n) + layer * e[4];
    default:
      return shape == CellShape::Segment ? e[1] : 0;
  }
}

class MfemReader {
 public:
  MfemReader(const std::string& path, std::string content, const StopCheck& stop)
      : path_(path), content_(std::move(content)), in_(path_, content_, TextLines::Space, stop) {}

  VolumeMesh read() {
    read_version();
    for (;;) {
      const std::string_view section = in_.next_token();
      if (section == "mfem_mesh_end" || section == "mfem_serial_mesh_end") break;
      if (section.empty() && has_end_) in_.fail("mfem_mesh_end is missing; the file is truncated");
      if (section.empty()) break;
      if (section == "dimension")
        in_.next_integer("the dimension");
      else if (section == "elements")
        elements_ = read_elements();
      else if (section == "boundary")
        boundary_ = read_elements();
      else if (section == "attribute_sets" || section == "bdr_attribute_sets")
        skip_attribute_sets();
      else if (section == "vertices")
        read_vertices();
      else if (section == "nodes")
        read_nodes();
      else if (section == "vertex_parents" || section == "root_state" || section == "knotvectors")
        refuse_mesh(
            path_,
            fmt::format("a section {}; conforming meshes without NURBS are supported", section));
      else
        in_.fail(fmt::format("{} where a section begins", in_quotes(section)));
    }
    if (elements_.empty()) in_.fail("no elements; not a mesh, or truncated");
    if (points_.empty()) in_.fail("neither coordinates of vertices nor nodes; truncated");
    return finish();
  }

 private:
  void read_version() {
    if (in_.next_token() != "MFEM") in_.fail("not a mesh of MFEM");
    const std::string line(in_.rest_of_line());
    has_end_ = line == "mesh v1.2" || line == "mesh v1.3";
    if (line != "mesh v1.0" && !has_end_)
      refuse_mesh(path_, fmt::format("MFEM {}; v1.0, v1.2 and v1.3, without NURBS and hanging "
                                     "nodes, are supported",
                                     in_quotes(line)));
  }

  // Skips named sets of attributes; they are written back unchanged.
  void skip_attribute_sets() {
    const std::int64_t sets = in_.next_count("the number of attribute sets");
    for (std::int64_t set = 0; set < sets; ++set) {
      skip_name();
      const std::int64_t size = in_.next_count("the size of an attribute set");
      for (std::int64_t k = 0; k < size; ++k) in_.next_integer("an attribute");
    }
  }

  // Skips a word, or a quoted text in which backslashes escape quotes and backslashes.
  void skip_name() {
    const std::string_view word = in_.next_token();
    if (word.empty()) in_.fail("the name of an attribute set is missing; the file is truncated");
    if (word.front() != '"') return;
    const std::string_view text = in_.text();
    std::size_t at = in_.begin() + 1;
    while (at < text.size() && text[at] != '"') at += text[at] == '\\' ? 2 : 1;
    if (at >= text.size()) in_.fail("the name of an attribute set has no end");
    in_.go_to(at + 1);
  }

  std::vector<MfemElement> read_elements() {
    const std::int64_t count = in_.next_count("the number of elements");
    std::vector<MfemElement> out;
    for (std::int64_t k = 0; k < count; ++k) {
      const std::int64_t attribute = in_.next_integer("an attribute"),
                         geometry = in_.next_integer("a geometry");
      if (geometry == 7)
        refuse_mesh(path_,
                    "pyramids; tetrahedra, hexahedra, wedges, triangles and quads are "
                    "supported");
      if (geometry < 0 || geometry > 7)
        refuse_mesh(path_, fmt::format("elements of geometry {}", geometry));
      MfemElement& element = out.emplace_back(MfemElement{attribute, &mfem_shape(geometry), {}, 0});
      for (int c = 0; c < corner_count(element.shape->shape); ++c) {
        const std::int64_t vertex = in_.next_integer("a vertex");
        if (c == 0) element.place = in_.begin();
        if (vertex < 0 || vertex > std::numeric_limits<Index>::max() / 4)
          in_.fail(fmt::format("vertex {} is out of range", vertex));
        element.vertices.push_back(static_cast<Index>(vertex));
      }
    }
    return out;
  }

  void add_coordinate(std::vector<double>& points, std::size_t at) {
    points[at] = in_.next_number("a coordinate");
    places_[at] = {in_.begin(), static_cast<std::uint32_t>(in_.place() - in_.begin())};
  }

  std::size_t space_dimension(std::int64_t value) const {
    if (value < 1 || value > 3) in_.fail(fmt::format("{} coordinates", value));
    return static_cast<std::size_t>(value);
  }

  void read_vertices() {
    vertices_ = static_cast<Index>(std::min<std::int64_t>(in_.next_count("the number of vertices"),
                                                          std::numeric_limits<Index>::max() / 4));
    const std::size_t place = in_.place();
    const std::string_view next = in_.next_token();
    in_.go_to(place);
    if (next == "nodes" || next.empty()) return;
    const std::size_t dim = space_dimension(in_.next_integer("the number of coordinates"));
    const auto count = to_size(vertices_);
    points_.assign(3 * count, 0);
    places_.assign(3 * count, {});
    for (std::size_t v = 0; v < count; ++v)
      for (std::size_t c = 0; c < dim; ++c) add_coordinate(points_, 3 * v + c);
  }

  void expect(std::string_view word) {
    if (in_.next_token() != word) in_.fail(fmt::format("{} is missing", word));
  }

  void read_nodes() {
    expect("FiniteElementSpace");
    expect("FiniteElementCollection:");
    space_ = node_space(path_, std::string(in_.next_token()));
    expect("VDim:");
    const std::size_t dim = space_dimension(in_.next_integer("the number of coordinates"));
    expect("Ordering:");
    const std::int64_t ordering = in_.next_integer("the ordering");
    if (ordering != 0 && ordering != 1) in_.fail(fmt::format("ordering {}", ordering));
    if (space_.degree < 1 || space_.degree > CellType::kMaxDegree)
      refuse_mesh(path_, fmt::format("nodes of degree {}; degrees 1 to {} are supported",
                                     space_.degree, CellType::kMaxDegree));
    require_vertices();
    require_elements();
    const std::size_t count = node_count();
    if (count * dim > in_.remaining()) in_.fail("the nodes end too early; the file is truncated");
    points_.assign(3 * count, 0);
    places_.assign(3 * count, {});
    for (std::size_t k = 0; k < count * dim; ++k)
      add_coordinate(points_,
                     ordering == 0 ? 3 * (k % count) + k / count : 3 * (k / dim) + k % dim);
    has_nodes_ = true;
  }

  void require_vertices() const {
    for (const auto* list : {&elements_, &boundary_})
      for (const MfemElement& e : *list)
        for (const Index v : e.vertices)
          if (v >= vertices_)
            throw Error(
                ErrorKind::Unreadable,
                fmt::format("{}: an element has vertex {}, there are {}", path_, v, vertices_));
  }

  void require_elements() const {
    for (const auto* list : {&elements_, &boundary_})
      for (const MfemElement& e : *list)
        if (space_.has_quads_alone && e.shape->shape != CellShape::Quad &&
            e.shape->shape != CellShape::Segment)
          refuse_mesh(path_, fmt::format("nodes of the space QuadraticPos, which has quads and "
                                         "segments, with {}",
                                         plural_of(e.shape->shape)));
  }

  std::size_t node_count() const {
    if (!space_.is_discontinuous)
      return to_size(ContinuousNodes(elements_, vertices_, space_).count());
    std::size_t count = 0;
    for (const MfemElement& e : elements_)
      count += to_size(CellType{e.shape->shape, space_.degree}.node_count());
    return count;
  }

  VolumeMesh finish() {
    require_vertices();
    VolumeMesh mesh;
    mesh.file = path_;
    mesh.points =
        Eigen::Map<const Points3>(points_.data(), static_cast<Index>(points_.size() / 3), 3);
    CellCollector cells;
    space_.is_discontinuous ? add_discontinuous(cells) : add_continuous(cells);
    // The file lists vertices, which are the corners.
    NodeLists lists{.coding = NodeLists::Coding::Words, .blocks = cells.lists()};
    mesh.blocks = cells.take();
    for (std::size_t b = 0; b < mesh.blocks.size(); ++b)
      lists.blocks[b].order.resize(to_size(corner_count(mesh.blocks[b].type.shape)));
    mesh.source = std::make_shared<const PlacedCoordinates>(path_, std::move(content_), mesh.points,
                                                            std::move(lists), std::move(places_),
                                                            PlacedCoordinates::Coding::Words);
    return mesh;
  }

  CellType type_of(const MfemElement& e) const {
    return {e.shape->shape, has_nodes_ ? space_.degree : 1, space_.kind, NodeSet::Full};
  }

  static std::vector<int> as_they_are(std::size_t count) {
    std::vector<int> out(count);
    for (std::size_t k = 0; k < count; ++k) out[k] = static_cast<int>(k);
    return out;
  }

  void add_continuous(CellCollector& cells) const {
    const ContinuousNodes nodes(elements_, vertices_, space_);
    const auto add = [&](const MfemElement& e, Index cell, std::int64_t number) {
      const std::vector<Index> of_cell = nodes.of(e, cell);
      if (of_cell.empty())
        throw Error(ErrorKind::Unreadable,
                    fmt::format("{}: element {} of the boundary is on no element", path_, number));
      cells.add(type_of(e), as_they_are(of_cell.size()), of_cell, number,
                static_cast<int>(e.attribute), e.place);
    };
    for (std::size_t k = 0; k < elements_.size(); ++k)
      add(elements_[k], static_cast<Index>(k), static_cast<std::int64_t>(k));
    for (std::size_t k = 0; k < boundary_.size(); ++k)
      add(boundary_[k], -1, static_cast<std::int64_t>(k));
  }

  // Boundary elements have no nodes of their own in L2.
  void add_discontinuous(CellCollector& cells) const {
    Index begin = 0;
    for (std::size_t k = 0; k < elements_.size(); ++k) {
      const MfemElement& e = elements_[k];
      std::vector<Index> of_cell;
      for (const Exponents& at : vtk_order(e.shape->shape, space_.degree))
        of_cell.push_back(begin + discontinuous_place(e.shape->shape, at, space_.degree));
      begin += static_cast<Index>(of_cell.size());
      cells.add(type_of(e), as_they_are(of_cell.size()), of_cell, static_cast<std::int64_t>(k),
                static_cast<int>(e.attribute), e.place, e.vertices);
    }
  }

  const std::string& path_;
  std::string content_;
  TextCursor in_;
  std::vector<MfemElement> elements_, boundary_;
  Index vertices_ = 0;
  NodeSpace space_;
  bool has_nodes_ = false;
  bool has_end_ = false;  // the version requires mfem_mesh_end
  std::vector<double> points_;
  std::vector<PlacedCoordinates::Place> places_;
};

}  // namespace

VolumeMesh read_mfem_mesh(const std::string& path, std::string content, const StopCheck& stop) {
  return MfemReader(path, std::move(content), stop).read();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
