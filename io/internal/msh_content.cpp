// MSH 4.1, ascii. Sections that hold no mesh are passed over; every count is believed only as far
// as lines follow.
#include "majorant/io/internal/msh_content.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>

#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/line_cursor.h"
#include "majorant/io/internal/mesh_readers.h"
#include "majorant/maps/bezier_cell.h"

namespace majorant {
namespace {

constexpr Index kLargestIndex = std::numeric_limits<Index>::max();

template <class Value>
using Tagged = std::pair<long long, Value>;  // gmsh's tag, what has it

template <class Value>
void sort_by_tag(std::vector<Tagged<Value>>& list) {
  const auto is_before = [](const auto& a, const auto& b) { return a.first < b.first; };
  if (!std::is_sorted(list.begin(), list.end(), is_before))
    std::stable_sort(list.begin(), list.end(), is_before);
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
  using Triangle = Tagged<std::array<long long, 3>>;

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

  static MshNumber number(LineCursor& cursor, std::string_view what) {
    MshNumber result;
    result.value = cursor.next_number(what);
    result.rounding = cursor.rounding();
    return result;
  }

  // The next `size` lines, read(cursor, entry) for each with an entry that is added to the list.
  template <class Entry, class Read>
  void read_list(long long size, std::vector<Entry>& list, const Read& read) {
    if (ThreadCount::current() > 1 && read_list_in_pieces(size, list, read)) return;
    for (long long k = 0; k < size; ++k) {
      require_line();
      read(cursor_, list.emplace_back());
    }
  }

  // On all threads. False, and nothing is read, where lines are not one an entry, or one of them is
  // broken: then who reads them one after the other says what is wrong.
  template <class Entry, class Read>
  bool read_list_in_pieces(long long size, std::vector<Entry>& list, const Read& read) {
    constexpr long long kPiece = 4096;  // lines a task: some 0.5 ms
    if (size <= kPiece) return false;
    const std::string_view ahead = cursor_.ahead();
    std::vector<std::size_t> begin{0};  // of the pieces, and the end
    std::size_t end = 0;
    for (long long k = 0; k < size; ++k) {
      const std::size_t found = ahead.find('\n', end);
      if (end == ahead.size() || (found == std::string_view::npos && k + 1 < size)) return false;
      end = found == std::string_view::npos ? ahead.size() : found + 1;
      if ((k + 1) % kPiece == 0 || k + 1 == size) begin.push_back(end);
    }
    const std::size_t before = list.size();
    list.resize(before + static_cast<std::size_t>(size));
    std::atomic<bool> is_other = false;
    parallel_tasks(static_cast<Index>(begin.size()) - 1, [&](Index task, int) {
      if (is_other) return;
      LineCursor lines(path_, ahead.substr(begin[task], begin[task + 1] - begin[task]),
                       Continuation::None, stop_);
      const long long last = std::min(size, (task + 1LL) * kPiece);
      try {
        for (long long k = task * kPiece; k < last && !is_other; ++k) {
          if (!lines.next_line()) is_other = true;
          if (!is_other) read(lines, list[before + static_cast<std::size_t>(k)]);
        }
      } catch (const Error&) {
        is_other = true;
      }
    });
    if (is_other) list.resize(before);
    if (!is_other) cursor_.pass(end, static_cast<long>(size));
    return !is_other;
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
      read_list(size, nodes_, [](LineCursor& cursor, auto& node) {
        node = {cursor.next_integer("node tag"), {}};
      });
      std::vector<std::array<MshNumber, 3>> places;
      read_list(size, places, [](LineCursor& cursor, auto& place) {
        place = {number(cursor, "x coordinate"), number(cursor, "y coordinate"),
                 number(cursor, "z coordinate")};
      });
      for (std::size_t k = 0; k < places.size(); ++k) nodes_[first + k].second = places[k];
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
      if (dimension == 2) read_triangles(size);
      for (long long k = 0; k < size && dimension != 2; ++k) require_line();
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

  void read_triangles(long long size) {
    std::vector<Triangle> triangles;
    const Index nodes = bezier_cell_size(result_.degree);
    if (nodes == 3) {
      read_list(size, triangles, [](LineCursor& cursor, Triangle& triangle) {
        triangle.first = cursor.next_integer("element tag");
        for (long long& tag : triangle.second) tag = cursor.next_integer("node tag");
        cursor.require_end_of_line();
      });
    }
    for (const auto& [tag, tags] : triangles) {
      elements_.emplace_back(tag, static_cast<Index>(elements_.size()));
      element_nodes_.insert(element_nodes_.end(), tags.begin(), tags.end());
    }
    for (long long k = 0; k < size && nodes > 3; ++k) {
      require_line();
      elements_.emplace_back(cursor_.next_integer("element tag"),
                             static_cast<Index>(elements_.size()));
      for (Index n = 0; n < nodes; ++n) element_nodes_.push_back(cursor_.next_integer("node tag"));
      cursor_.require_end_of_line();
    }
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
    if (view != nullptr)
      return read_list(numbers[2], *view, [](LineCursor& cursor, auto& entry) {
        entry.first = cursor.next_integer("node tag");
        entry.second = number(cursor, "value");
      });
    for (long long k = 0; k < numbers[2]; ++k) require_line();
  }

  // Lines of a tag and a number of the input, -1 where there is none.
  void read_input_numbers(std::string_view name, std::vector<Tagged<Index>>& numbers) {
    if (!numbers.empty()) cursor_.fail(fmt::format("{} is there twice; correct the file", name));
    require_line();
    const long long size = count(fmt::format("number of lines of {}", name));
    read_list(size, numbers, [name](LineCursor& cursor, auto& entry) {
      const long long tag = cursor.next_integer("tag");
      const long long number = cursor.next_integer(name);
      if (number < -1 || number > kLargestIndex)
        cursor.fail(fmt::format("{} {} is out of range", name, number));
      entry = {tag, static_cast<Index>(number)};
      cursor.require_end_of_line();
    });
  }

  // The place of a tag in a list that is sorted by it; -1 if it is not there.
  template <class Value>
  static Index find(const std::vector<Tagged<Value>>& list, long long tag) {
    // Mostly tags are 1, 2, 3, ...
    if (const long long place = tag - 1; place >= 0 && place < static_cast<long long>(list.size()))
      if (list[static_cast<std::size_t>(place)].first == tag) return static_cast<Index>(place);
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
    result_.nodes.reserve(nodes_.size());
    for (const auto& node : nodes_) result_.nodes.push_back(node.second);
    const auto size = to_size(bezier_cell_size(result_.degree));
    result_.cells.resize(static_cast<Index>(elements_.size()), static_cast<Index>(size));
    for (std::size_t c = 0; c < elements_.size(); ++c) {
      stop_.poll_at(c);
      const auto& [tag, number] = elements_[c];
      for (std::size_t k = 0; k < size; ++k) {
        const long long of_node = element_nodes_[to_size(number) * size + k];
        const Index node = find(nodes_, of_node);
        if (node < 0)
          refuse(fmt::format("element {} has node {}, which is not there; correct the file", tag,
                             of_node));
        result_.cells(static_cast<Index>(c), static_cast<Index>(k)) = node;
      }
    }
  }

  MshView numbered(Values& values, std::string_view name) const {
    MshView view;
    if (values.empty()) return view;
    sort(values, fmt::format("values of view {}", name));
    view.values.reserve(nodes_.size());
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
  std::vector<Tagged<Index>> elements_;   // numbered as they were read
  std::vector<long long> element_nodes_;  // by that number, those of an element together
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
    const auto corner = [&](Index k) { return vertices[contents.cells(c, k)]; };
    mesh.polygons.push_back({corner(0), corner(1), corner(2)});
  }
  if (has_map) mesh.polygon_texcoords = mesh.polygons;
  require_complete(mesh);
  return mesh;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
