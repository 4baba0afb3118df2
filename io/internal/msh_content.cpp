// MSH 4.1, ascii. Sections that hold no mesh are passed over; every count is believed only as far
// as lines follow.
#include "majorant/io/internal/msh_content.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "majorant/framework/error.h"
#include "majorant/io/input_file.h"
#include "majorant/io/internal/line_cursor.h"
#include "majorant/io/internal/mesh_readers.h"
#include "majorant/parametrization/maps/bezier_cell.h"

namespace majorant {
namespace {

constexpr Index kLargestIndex = std::numeric_limits<Index>::max();

template <class Value>
using Tagged = std::pair<long long, Value>;  // gmsh's tag, what has it

template <class Value>
void sort_by_tag(std::vector<Tagged<Value>>& list) {
  std::stable_sort(list.begin(), list.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
}

class MshReader {
 public:
  MshReader(const std::string& path, std::string_view text, const StopCheck& stop)
      : path_(path), stop_(stop), cursor_(path, text, Continuation::None, stop) {}

  MshContents read() {
    while (cursor_.next_line()) read_section();
    if (version_.empty()) refuse("no section $MeshFormat; not a gmsh file");
    if (nodes_.empty()) refuse("no nodes; not a mesh, or truncated");
    if (elements_.empty()) refuse("no triangles; a surface mesh is needed");
    number_nodes();
    result_.u = numbered(u_, "u");
    result_.v = numbered(v_, "v");
    result_.input_vertex = numbered(input_vertices_, nodes_, kMshInputVertex);
    result_.input_face = numbered(input_faces_, elements_, kMshInputFace);
    return std::move(result_);
  }

 private:
  using Values = std::vector<Tagged<MshNumber>>;

  [[noreturn]] void refuse(std::string_view problem) const {
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {}", path_, problem));
  }

  void require_line() {
    if (!cursor_.next_line()) refuse("a section does not end; the file is truncated");
  }

  long long count(std::string_view what) {
    const long long value = cursor_.next_integer(what);
    if (value < 0 || value > kLargestIndex) cursor_.fail(fmt::format("{} is out of range", what));
    return value;
  }

  MshNumber number(std::string_view what) {
    MshNumber result;
    result.value = cursor_.next_number(what);
    result.rounding = cursor_.rounding();
    return result;
  }

  void read_section() {
    const std::string name(cursor_.next_token());
    if (name.size() < 2 || name[0] != '$')
      cursor_.fail(fmt::format("{} is no section; not a gmsh file", in_quotes(name)));
    if (version_.empty() && name != "$MeshFormat" && name != "$Comments")
      cursor_.fail("no section $MeshFormat at the top; not a gmsh file");
    if (name == "$MeshFormat") read_format();
    if (name == "$Nodes") read_nodes();
    if (name == "$Elements") read_elements();
    if (name == "$NodeData") read_view();
    const std::string_view what = std::string_view(name).substr(1);
    if (what == kMshInputVertex) read_input_numbers(what, input_vertices_);
    if (what == kMshInputFace) read_input_numbers(what, input_faces_);
    const std::string end = "$End" + name.substr(1);
    const bool is_read = name == "$MeshFormat" || name == "$Nodes" || name == "$Elements" ||
                         name == "$NodeData" || what == kMshInputVertex || what == kMshInputFace;
    do {
      require_line();
      if (is_read && cursor_.whole_line() != end)
        cursor_.fail(fmt::format("{} should follow; correct the counts", end));
    } while (cursor_.whole_line() != end);
  }

  void read_format() {
    require_line();
    version_ = cursor_.next_token();
    if (version_ != "4.1")
      cursor_.fail(fmt::format("version {} is not supported; save the mesh as version 4.1, ascii",
                               in_quotes(version_)));
    if (cursor_.next_integer("file type") != 0)
      cursor_.fail("binary files are not supported; save the mesh as version 4.1, ascii");
  }

  void read_nodes() {
    require_line();
    const long long blocks = count("number of blocks");
    for (long long b = 0; b < blocks; ++b) {
      require_line();
      for (const char* what : {"dimension", "entity", "parametric flag"})
        cursor_.next_integer(what);
      const long long size = count("number of nodes");
      const std::size_t first = nodes_.size();
      for (long long k = 0; k < size; ++k) {
        require_line();
        nodes_.push_back({cursor_.next_integer("node tag"), {}});
      }
      for (long long k = 0; k < size; ++k) {
        require_line();
        auto& node = nodes_[first + static_cast<std::size_t>(k)].second;
        node = {number("x coordinate"), number("y coordinate"), number("z coordinate")};
      }
    }
  }

  void read_elements() {
    require_line();
    const long long blocks = count("number of blocks");
    for (long long b = 0; b < blocks; ++b) {
      require_line();
      const long long dimension = cursor_.next_integer("dimension");
      cursor_.next_integer("entity");
      const long long type = cursor_.next_integer("element type");
      const long long size = count("number of elements");
      if (dimension == 2) require_type(type);
      if (dimension > 2) cursor_.fail("elements of a volume; save the surface mesh alone");
      for (long long k = 0; k < size; ++k) {
        require_line();
        if (dimension == 2) read_triangle();
      }
    }
  }

  void require_type(long long type) {
    const auto found = std::find_if(kMshTriangles.begin(), kMshTriangles.end(),
                                    [&](const auto& known) { return known.first == type; });
    if (found == kMshTriangles.end())
      cursor_.fail(fmt::format("elements of type {}; only complete triangles are supported", type));
    if (!elements_.empty() && found->second != result_.degree)
      cursor_.fail("triangles of several degrees; one is needed");
    result_.degree = found->second;
  }

  void read_triangle() {
    auto& [tag, tags] = elements_.emplace_back();
    tag = cursor_.next_integer("element tag");
    for (Index k = 0; k < bezier_cell_size(result_.degree); ++k)
      tags.push_back(cursor_.next_integer("node tag"));
    cursor_.require_end_of_line();
  }

  void read_view() {
    std::string name;
    require_line();
    const long long strings = count("number of strings");
    for (long long k = 0; k < strings; ++k) {
      require_line();
      if (k == 0) name = cursor_.whole_line();
    }
    require_line();
    const long long reals = count("number of numbers");
    for (long long k = 0; k < reals; ++k) require_line();
    require_line();
    const long long integers = count("number of integers");
    if (integers < 3) cursor_.fail("a view without a number of values; correct the file");
    std::array<long long, 3> numbers{};  // time step, components, nodes
    for (long long k = 0; k < integers; ++k) {
      require_line();
      const long long value = count("integer");
      if (k < 3) numbers[static_cast<std::size_t>(k)] = value;
    }
    Values* view = name == "\"u\"" ? &u_ : name == "\"v\"" ? &v_ : nullptr;
    if (view != nullptr && (!view->empty() || numbers[1] != 1))
      cursor_.fail(fmt::format("the view {} should be there once, with one component", name));
    for (long long k = 0; k < numbers[2]; ++k) {
      require_line();
      if (view == nullptr) continue;
      const long long tag = cursor_.next_integer("node tag");
      view->push_back({tag, number("value")});
    }
  }

  // Lines of a tag and a number of the input, -1 where there is none.
  void read_input_numbers(std::string_view name, std::vector<Tagged<Index>>& numbers) {
    if (!numbers.empty()) cursor_.fail(fmt::format("{} is there twice; correct the file", name));
    require_line();
    const long long size = count(fmt::format("number of lines of {}", name));
    for (long long k = 0; k < size; ++k) {
      require_line();
      const long long tag = cursor_.next_integer("tag");
      const long long number = cursor_.next_integer(name);
      if (number < -1 || number > kLargestIndex)
        cursor_.fail(fmt::format("{} {} is out of range", name, number));
      numbers.push_back({tag, static_cast<Index>(number)});
      cursor_.require_end_of_line();
    }
  }

  // The place of a tag in a list that is sorted by it; -1 if it is not there.
  template <class Value>
  static Index find(const std::vector<Tagged<Value>>& list, long long tag) {
    const auto found = std::lower_bound(list.begin(), list.end(), tag,
                                        [](const auto& a, long long b) { return a.first < b; });
    const bool is_there = found != list.end() && found->first == tag;
    return is_there ? static_cast<Index>(found - list.begin()) : -1;
  }

  template <class Value>
  void sort(std::vector<Tagged<Value>>& list, std::string_view what) const {
    if (list.size() > to_size(kLargestIndex))
      refuse("more than 2^31 nodes or elements; simplify the mesh");
    sort_by_tag(list);
    for (std::size_t k = 1; k < list.size(); ++k)
      if (list[k].first == list[k - 1].first)
        refuse(fmt::format("two {} have the tag {}; correct the file", what, list[k].first));
  }

  void number_nodes() {
    sort(nodes_, "nodes");
    sort(elements_, "elements");
    for (const auto& node : nodes_) result_.nodes.push_back(node.second);
    result_.cells.resize(static_cast<Index>(elements_.size()), bezier_cell_size(result_.degree));
    for (std::size_t c = 0; c < elements_.size(); ++c) {
      stop_.poll_at(c);
      const auto& [tag, tags] = elements_[c];
      for (std::size_t k = 0; k < tags.size(); ++k) {
        const Index node = find(nodes_, tags[k]);
        if (node < 0)
          refuse(fmt::format("element {} has node {}, which is not there; correct the file", tag,
                             tags[k]));
        result_.cells(static_cast<Index>(c), static_cast<Index>(k)) = node;
      }
    }
  }

  MshView numbered(Values& values, std::string_view name) const {
    MshView view;
    if (values.empty()) return view;
    sort(values, fmt::format("values of view {}", name));
    for (const auto& [tag, ignored] : nodes_) {
      const Index place = find(values, tag);
      if (place < 0) refuse(fmt::format("view {} has no value for node {}", name, tag));
      view.values.push_back(values[place].second);
    }
    return view;
  }

  // In the order of the nodes or elements that the tags are of.
  template <class Value>
  Eigen::VectorXi numbered(std::vector<Tagged<Index>>& numbers,
                           const std::vector<Tagged<Value>>& of, std::string_view name) const {
    if (numbers.empty()) return {};
    sort(numbers, fmt::format("lines of {}", name));
    Eigen::VectorXi result(static_cast<Index>(of.size()));
    for (std::size_t k = 0; k < of.size(); ++k) {
      const Index place = find(numbers, of[k].first);
      if (place < 0) refuse(fmt::format("{} has no line for tag {}", name, of[k].first));
      result[static_cast<Index>(k)] = numbers[place].second;
    }
    return result;
  }

  const std::string& path_;
  const StopCheck& stop_;
  LineCursor cursor_;
  std::string version_;
  std::vector<Tagged<std::array<MshNumber, 3>>> nodes_;
  std::vector<Tagged<std::vector<long long>>> elements_;
  Values u_, v_;
  std::vector<Tagged<Index>> input_vertices_, input_faces_;
  MshContents result_;
};

}  // namespace

MshContents read_msh_contents(const std::string& path, std::string content, const StopCheck& stop) {
  require_text(path, content);
  return MshReader(path, content, stop).read();
}

PolygonMesh read_msh_mesh(const std::string& path, std::string content, const StopCheck& stop) {
  const MshContents contents = read_msh_contents(path, std::move(content), stop);
  const bool has_map = !contents.u.values.empty() && !contents.v.values.empty();
  PolygonMesh mesh;
  mesh.file = path;
  std::vector<Index> vertices(contents.nodes.size(), -1);
  for (const Index node : contents.cells.leftCols<3>().reshaped()) vertices[node] = 0;
  for (std::size_t node = 0; node < vertices.size(); ++node) {
    if (vertices[node] < 0) continue;
    vertices[node] = static_cast<Index>(mesh.positions.size());
    const auto& [x, y, z] = contents.nodes[node];
    mesh.positions.emplace_back(x.value, y.value, z.value);
    if (has_map)
      mesh.texcoords.emplace_back(contents.u.values[node].value, contents.v.values[node].value);
  }
  for (Index c = 0; c < contents.cells.rows(); ++c) {
    auto& polygon = mesh.polygons.emplace_back();
    for (Index k = 0; k < 3; ++k) polygon.push_back(vertices[contents.cells(c, k)]);
  }
  if (has_map) mesh.polygon_texcoords = mesh.polygons;
  require_complete(mesh);
  return mesh;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
