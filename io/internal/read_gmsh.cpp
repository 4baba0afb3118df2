// gmsh files, 2.2 and 4.1, text and binary. Sections that are not needed are skipped; counts are
// checked against the size of the file.
#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <limits>
#include <unordered_map>

#include "majorant/framework/error.h"
#include "majorant/framework/parallel.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/cell_collector.h"
#include "majorant/io/internal/cell_readers.h"
#include "majorant/io/internal/gmsh_document.h"
#include "majorant/io/internal/gmsh_numbers.h"
#include "majorant/io/internal/gmsh_types.h"
#include "majorant/io/internal/text_cursor.h"
#include "majorant/io/written_mark.h"

namespace majorant {
namespace {

// Refuses binary bytes in a file that does not declare itself as binary.
std::string checked(const std::string& path, std::string content, const StopCheck& stop) {
  TextCursor words(path, content, TextLines::Space, stop, TextComments::None);
  if (words.next_token() == "$MeshFormat") {
    words.next_token();
    if (words.next_token() == "1") return content;
  }
  require_text(path, content);
  return content;
}

void read_entities(GmshNumbers& in, GmshDocument& document) {
  std::array<Index, 4> counts{};
  for (Index& count : counts) count = in.count(in.large("the number of entities"), 4, "entities");
  const auto read_tags = [&](std::vector<int>& out) {
    const Index count = in.count(in.large("the number of tags"), 2, "tags");
    for (Index k = 0; k < count; ++k) out.push_back(static_cast<int>(in.small("a tag")));
  };
  for (int dim = 0; dim < 4; ++dim)
    for (Index k = 0; k < counts[to_size(dim)]; ++k) {
      GmshDocument::Entity& entity = document.entities[{dim, static_cast<int>(in.small("a tag"))}];
      for (std::size_t c = 0; c < (dim == 0 ? 3u : 6u); ++c) entity.box[c] = in.real("a bound");
      read_tags(entity.physicals);
      if (dim > 0) read_tags(entity.bounding);
    }
}

// The header of a section $NodeData.
struct GmshViewHead {
  std::string name;                    // with quotes
  std::array<long long, 3> numbers{};  // time step, components, nodes
};

GmshViewHead read_view_head(GmshNumbers& in) {
  TextCursor& words = in.words();
  GmshViewHead head;
  const long long strings = words.next_count("the number of strings");
  for (long long k = 0; k < strings; ++k) {
    if (!words.next_line()) words.fail("a string is missing; the file is truncated");
    if (k == 0) head.name = words.whole_line();
    words.rest_of_line();
  }
  const long long reals = words.next_count("the number of numbers");
  for (long long k = 0; k < reals; ++k) words.next_number("a number");
  const long long integers = words.next_count("the number of integers");
  if (integers < 3) words.fail("a view without a number of values; correct the file");
  for (long long k = 0; k < integers; ++k) {
    const long long value = words.next_integer("an integer");
    if (k < 3) head.numbers[static_cast<std::size_t>(k)] = value;
  }
  return head;
}

// Reads lines with a tag and a number of the input, -1 for none.
void read_input_numbers(GmshNumbers& in, std::string_view name, GmshDocument::Tagged<Index>& out) {
  if (!out.tags.empty()) in.fail(fmt::format("{} is there twice; correct the file", name));
  const Index count =
      in.count(in.words().next_count(fmt::format("the number of lines of {}", name)), 4, "lines");
  out.tags.resize(to_size(count));
  out.numbers.resize(to_size(count));
  read_entries(in, count, [&](GmshNumbers& line, Index k) {
    out.tags[to_size(k)] = line.small("a tag");
    const std::int64_t number = line.small(name);
    if (number < -1 || number > std::numeric_limits<Index>::max())
      line.fail(fmt::format("{} {} is out of range", name, number));
    out.numbers[to_size(k)] = static_cast<Index>(number);
  });
}

// Returns the content of a section.
std::string_view pass_section(TextCursor& words, const std::string& end) {
  const std::size_t begin = words.place(), found = words.text().find("\n" + end, begin);
  if (found == std::string_view::npos) words.fail(end + " is missing; the file is truncated");
  words.go_to(found + 1 + end.size());
  return words.text().substr(begin, found - begin);
}

// Returns whether the text of a section is majorant's mark, which writers add again.
bool is_mark(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  return begin != std::string_view::npos && is_written_mark(text.substr(begin));
}

class GmshReader {
 public:
  GmshReader(const std::string& path, std::string content, GmshParts parts, const StopCheck& stop)
      : file_(path, checked(path, std::move(content), stop)),
        document_(file_.document),
        parts_(parts),
        stop_(stop),
        in_(file_.path, file_.content, stop) {}

  GmshFormat format() {
    read_format();
    return document_.format;
  }

  GmshFile read() && {
    read_format();
    while (read_section()) {
    }
    if (document_.node_tags.empty()) in_.words().fail("no nodes; not a mesh, or truncated");
    file_.order = in_.order();
    return std::move(file_);
  }

 private:
  bool is_old() const { return document_.format.version == GmshVersion::Old; }
  bool is_surface() const { return parts_ == GmshParts::Surface; }

  // Refuses contents that are known but not supported. For surfaces the message names the line.
  [[noreturn]] void refuse(const std::string& what) {
    if (is_surface()) in_.words().fail(what);
    refuse_mesh(file_.path, what);
  }

  void read_format() {
    TextCursor& words = in_.words();
    std::string_view name = words.next_token();
    while (name == "$Comments") {
      pass_section(words, "$EndComments");
      name = words.next_token();
    }
    if (name != "$MeshFormat") words.fail("no section $MeshFormat; not a gmsh file");
    const std::string version(words.next_token());
    const std::int64_t is_binary = words.next_integer("the file type"),
                       size = words.next_integer("the data size");
    const bool is_old = version == "2.2" || version == "2.1" || version == "2" || version == "2.0";
    if (!is_old && version != "4.1")
      refuse(
          fmt::format("MSH {}; 2.2 and 4.1 are supported, gmsh writes them by "
                      "-format msh22 and msh41",
                      version));
    if (size != 8) refuse(fmt::format("numbers of {} bytes; 8 are supported", size));
    document_.format = {is_old ? GmshVersion::Old : GmshVersion::New,
                        is_binary != 0 ? GmshEncoding::Binary : GmshEncoding::Text};
    if (is_binary != 0) {
      const std::size_t line_end = words.text().find('\n', words.place());
      const bool is_big = line_end + 1 < words.text().size() && words.text()[line_end + 1] == 0;
      in_.begin_binary(is_big ? ByteOrder::Big : ByteOrder::Little);
      in_.begin_section();
      if (in_.small("the number 1") != 1) in_.fail("the byte order is not known; damaged file");
    }
    if (in_.words().next_token() != "$EndMeshFormat") words.fail("$EndMeshFormat is missing");
  }

  bool read_section() {
    TextCursor& words = in_.words();
    const std::string name(words.next_token());
    if (name.empty()) return false;
    if (name[0] != '$') words.fail(fmt::format("{} where a section begins", in_quotes(name)));
    const std::string end = "$End" + name.substr(1);
    const std::string_view what = std::string_view(name).substr(1);
    if (name == "$Nodes" || name == "$Elements" || (name == "$Entities" && !is_old())) {
      in_.begin_section();
      if (name == "$Nodes")
        is_old() ? read_old_nodes() : read_nodes();
      else if (name == "$Elements")
        is_old() ? read_old_elements() : read_elements();
      else
        read_entities(in_, document_);
      require_end(end);
    } else if (is_surface() && name == "$NodeData") {
      read_view(end);
    } else if (is_surface() && !in_.is_binary() && what == kGmshInputVertex) {
      read_input_numbers(in_, what, document_.input_vertex);
      require_end(end);
    } else if (is_surface() && !in_.is_binary() && what == kGmshInputFace) {
      read_input_numbers(in_, what, document_.input_face);
      require_end(end);
    } else {
      read_other(name, end);
    }
    return true;
  }

  void require_end(const std::string& end) {
    if (in_.words().next_token() != end)
      in_.words().fail(end + " is missing; the counts are wrong, or the file is truncated");
  }

  void read_other(const std::string& name, const std::string& end) {
    const bool is_partitioned = name == "$PartitionedEntities" && !is_surface();
    if (name == "$ParametricNodes" || name == "$NOD" || is_partitioned)
      refuse(fmt::format("a section {}; save the mesh without it", name));
    const std::string_view content = pass_section(in_.words(), end);
    if (name == "$PhysicalNames")
      document_.physical_names = fmt::format("{}{}\n{}\n", name, content, end);
    else if (!is_mark(content))
      document_.others.push_back("section " + name);
  }

  // Records each kind once.
  void note_other(const char* what) {
    std::vector<std::string>& others = document_.others;
    if (std::find(others.begin(), others.end(), what) == others.end()) others.push_back(what);
  }

  void require_first_nodes() {
    if (!document_.node_tags.empty()) in_.fail("a second section $Nodes");
  }

  // Makes room for nodes and returns the number of the first one.
  std::size_t add_nodes(Index count, GmshDocument::EntityName entity) {
    const std::size_t first = document_.node_tags.size(), all = first + to_size(count);
    document_.node_tags.resize(all);
    document_.node_entities.resize(all, entity);
    document_.coordinates.resize(3 * all);
    file_.coordinates.resize(3 * all);
    return first;
  }

  void read_coordinates(GmshNumbers& in, std::size_t node) {
    std::size_t at = 3 * node;
    for (const char* const what : {"x coordinate", "y coordinate", "z coordinate"}) {
      document_.coordinates[at] = in.real(what);
      file_.coordinates[at++] = in.last_place();
    }
  }

  void read_old_nodes() {
    require_first_nodes();
    const Index count = in_.count(in_.words().next_count("the number of nodes"), 7, "nodes");
    in_.begin_section();
    const std::size_t first = add_nodes(count, {-1, 0});
    read_entries(in_, count, [&](GmshNumbers& in, Index k) {
      document_.node_tags[first + to_size(k)] = in.small("a node");
      read_coordinates(in, first + to_size(k));
    });
  }

  void read_nodes() {
    require_first_nodes();
    const Index blocks = in_.count(in_.large("the number of blocks"), 7, "blocks");
    in_.count(in_.large("the number of nodes"), 7, "nodes");
    in_.large("the smallest tag");
    in_.large("the largest tag");
    for (Index b = 0; b < blocks; ++b) {
      const std::int64_t dim = in_.small("a dimension"), entity = in_.small("a tag");
      const std::int64_t is_parametric = in_.small("whether nodes are parametric");
      if (is_parametric != 0) note_other("parameters of nodes");
      const Index count = in_.count(in_.large("the number of nodes"), 7, "nodes");
      const std::size_t first = add_nodes(count, {static_cast<int>(dim), static_cast<int>(entity)});
      read_entries(in_, count, [&](GmshNumbers& in, Index k) {
        document_.node_tags[first + to_size(k)] = in.large("a node");
      });
      read_entries(in_, count, [&](GmshNumbers& in, Index k) {
        read_coordinates(in, first + to_size(k));
        for (std::int64_t c = 0; is_parametric != 0 && c < dim; ++c) in.real("a parameter");
      });
    }
  }

  // Returns the number of nodes of a supported type.
  int node_count_of(std::int64_t number) {
    const std::optional<CellType> type = gmsh_type(number);
    if (is_surface()) require_surface(number, type);
    if (!type || (!is_surface() && type->degree > CellType::kMaxDegree))
      refuse(is_gmsh_pyramid(number)
                 ? "pyramids; tetrahedra, hexahedra, wedges, triangles and quads are "
                   "supported"
                 : fmt::format("elements of gmsh's type {}; simplices, quads, hexahedra "
                               "and wedges of degrees 1 to 4 are supported",
                               number));
    return type->node_count();
  }

  void require_surface(std::int64_t number, const std::optional<CellType>& type) {
    if (is_gmsh_pyramid(number) || (type && dimension(type->shape) > 2))
      in_.fail("elements of a volume; save the surface mesh alone");
    if (!type || type->shape == CellShape::Quad)
      in_.fail(fmt::format("elements of type {}; only complete triangles are supported", number));
    if (type->shape != CellShape::Triangle) return;
    if (degree_ != 0 && degree_ != type->degree)
      in_.fail("triangles of several degrees; one is needed");
    degree_ = type->degree;
  }

  void read_elements() {
    const Index blocks = in_.count(in_.large("the number of blocks"), 7, "blocks");
    in_.count(in_.large("the number of elements"), 3, "elements");
    in_.large("the smallest tag");
    in_.large("the largest tag");
    for (Index b = 0; b < blocks; ++b) {
      in_.small("a dimension");
      const int entity = static_cast<int>(in_.small("a tag"));
      const std::int64_t number = in_.small("a type");
      const std::size_t nodes = to_size(node_count_of(number));
      const Index count =
          in_.count(in_.large("the number of elements"), 2 * (nodes + 1), "elements");
      const std::size_t first = document_.elements.size(),
                        first_node = document_.element_nodes.size();
      document_.elements.resize(first + to_size(count));
      document_.element_nodes.resize(first_node + nodes * to_size(count));
      file_.lists.resize(document_.elements.size());
      read_entries(in_, count, [&](GmshNumbers& in, Index k) {
        const std::size_t at = first_node + nodes * to_size(k);
        const std::int64_t tag = in.large("an element");
        document_.elements[first + to_size(k)] = {tag, static_cast<int>(number), 0, entity, at};
        for (std::size_t i = 0; i < nodes; ++i) {
          document_.element_nodes[at + i] = in.large("a node");
          if (i == 0) file_.lists[first + to_size(k)] = in.last_place().begin;
        }
      });
    }
  }

  void read_old_elements() {
    const Index count = in_.count(in_.words().next_count("the number of elements"), 3, "elements");
    in_.begin_section();
    Index in_block = 0;  // elements left under the current header of a binary file
    std::int64_t number = 0, tags = 0;
    for (Index k = 0; k < count; ++k) {
      GmshDocument::Element element;
      if (in_.is_binary()) {
        if (in_block == 0) {
          number = in_.small("a type");
          in_block = in_.count(in_.small("the number of elements"), 4, "elements");
          tags = in_.small("the number of tags");
          if (in_block == 0) in_.fail("a block without elements");
        }
        --in_block;
        element.tag = in_.small("an element");
      } else {
        element.tag = in_.small("an element");
        number = in_.small("a type");
        tags = in_.small("the number of tags");
      }
      const int nodes = node_count_of(number);
      element.type = static_cast<int>(number);
      for (std::int64_t t = 0; t < tags; ++t) {
        const int tag = static_cast<int>(in_.small("a tag"));
        if (t == 0) element.physical = tag;
        if (t == 1) element.entity = tag;
      }
      // The third tag counts the partitions that follow.
      if (tags > 2) note_other("partitions of elements");
      element.first_node = document_.element_nodes.size();
      for (int i = 0; i < nodes; ++i) {
        document_.element_nodes.push_back(in_.small("a node"));
        if (i == 0) file_.lists.push_back(in_.last_place().begin);
      }
      document_.elements.push_back(element);
    }
  }

  // Reads the views "u" and "v" of a map; skips others.
  void read_view(const std::string& end) {
    const auto [name, numbers] = read_view_head(in_);
    const bool is_u = name == "\"u\"";
    if (!is_u && name != "\"v\"") {
      pass_section(in_.words(), end);
      document_.others.emplace_back("section $NodeData");
      return;
    }
    auto& [tags, values] = is_u ? document_.u : document_.v;
    std::vector<PlacedCoordinates::Place>& places = is_u ? file_.u : file_.v;
    if (!tags.empty() || numbers[1] != 1)
      in_.words().fail(fmt::format("the view {} should be there once, with one component", name));
    in_.begin_section();
    const Index count = in_.count(numbers[2], 4, "values");
    tags.resize(to_size(count));
    values.resize(to_size(count));
    places.resize(to_size(count));
    read_entries(in_, count, [&, &tags = tags, &values = values](GmshNumbers& in, Index k) {
      tags[to_size(k)] = in.small("a node");
      values[to_size(k)] = in.real("a value");
      places[to_size(k)] = in.last_place();
    });
    require_end(end);
  }

  GmshFile file_;
  GmshDocument& document_;
  GmshParts parts_;
  const StopCheck& stop_;
  GmshNumbers in_;
  int degree_ = 0;  // of triangles, after the first one
};

}  // namespace

void GmshFile::fail_at(std::size_t place, std::string_view problem) const {
  if (document.format.encoding == GmshEncoding::Binary)
    throw Error(ErrorKind::Unreadable, fmt::format("{}: byte {}: {}", path, place, problem));
  TextCursor words(path, content, TextLines::Space, {}, TextComments::None);
  words.go_to(place);
  words.next_token();
  words.fail(problem);
}

GmshTags::GmshTags(const GmshFile& file) : file_(file) {
  const std::vector<std::int64_t>& tags = file.document.node_tags;
  const auto [least, largest] = std::minmax_element(tags.begin(), tags.end());
  const auto refuse = [&](std::int64_t tag) {
    throw Error(ErrorKind::Unreadable,
                fmt::format("{}: two nodes have the tag {}; correct the file", file.path, tag));
  };
  constexpr std::int64_t kSpread = 8;  // largest number of table entries per node
  const bool is_dense = *least >= 0 && *largest <= kSpread * static_cast<std::int64_t>(tags.size());
  if (is_dense) row_.assign(static_cast<std::size_t>(*largest) + 1, -1);
  for (std::size_t k = 0; k < tags.size(); ++k) {
    if (!is_dense) {
      if (!sparse_.emplace(tags[k], static_cast<Index>(k)).second) refuse(tags[k]);
      continue;
    }
    Index& row = row_[static_cast<std::size_t>(tags[k])];
    if (row >= 0) refuse(tags[k]);
    row = static_cast<Index>(k);
  }
}

Index GmshTags::row(std::int64_t tag) const {
  if (row_.empty()) {
    const auto found = sparse_.find(tag);
    return found == sparse_.end() ? -1 : found->second;
  }
  return tag >= 0 && static_cast<std::size_t>(tag) < row_.size()
             ? row_[static_cast<std::size_t>(tag)]
             : -1;
}

Index GmshTags::row_in(std::size_t element, std::int64_t tag) const {
  const Index found = row(tag);
  if (found < 0)
    file_.fail_at(file_.lists[element],
                  fmt::format("element {} has node {}, which is not there; correct the file",
                              file_.document.elements[element].tag, tag));
  return found;
}

GmshFile read_gmsh_file(const std::string& path, std::string content, GmshParts parts,
                        const StopCheck& stop) {
  return GmshReader(path, std::move(content), parts, stop).read();
}

GmshFormat read_gmsh_format(const std::string& path, std::string content) {
  return GmshReader(path, std::move(content), GmshParts::Volume, {}).format();
}

VolumeMesh read_gmsh_mesh(const std::string& path, std::string content, const StopCheck& stop) {
  GmshFile file = read_gmsh_file(path, std::move(content), GmshParts::Volume, stop);
  const GmshDocument& document = file.document;
  const GmshTags tags(file);
  VolumeMesh mesh;
  mesh.file = path;
  mesh.points = Eigen::Map<const Points3>(document.coordinates.data(),
                                          static_cast<Index>(document.node_tags.size()), 3);
  CellCollector cells;
  std::unordered_map<int, std::pair<CellType, std::vector<int>>> types;
  std::vector<Index> nodes;
  for (std::size_t k = 0; k < document.elements.size(); ++k) {
    stop.poll_at(k);
    const GmshDocument::Element& e = document.elements[k];
    auto known = types.find(e.type);
    if (known == types.end()) {
      const CellType type = *gmsh_type(e.type);
      known = types.emplace(e.type, std::pair(type, gmsh_order(type))).first;
    }
    const auto& [type, order] = known->second;
    nodes.resize(order.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      nodes[i] = tags.row_in(k, document.element_nodes[e.first_node + i]);
    const bool is_old = document.format.version == GmshVersion::Old;
    cells.add(type, order, nodes, e.tag, is_old ? e.physical : e.entity, file.lists[k]);
  }
  NodeLists lists{
      .coding = NodeLists::Coding::Words, .comments = TextComments::None, .blocks = cells.lists()};
  using Coding = PlacedCoordinates::Coding;
  Coding coding = Coding::Words;
  if (document.format.encoding == GmshEncoding::Binary) {
    lists.coding = NodeLists::Coding::Bytes;
    lists.width =
        document.format.version == GmshVersion::Old ? sizeof(std::int32_t) : sizeof(std::uint64_t);
    const bool is_native =
        (file.order == ByteOrder::Little) == (std::endian::native == std::endian::little);
    coding = is_native ? Coding::Doubles : Coding::SwappedDoubles;
  }
  mesh.blocks = cells.take();
  if (mesh.blocks.empty())
    throw Error(ErrorKind::Unreadable, path + ": no elements; not a mesh, or truncated");
  mesh.source = std::make_shared<const PlacedCoordinates>(path, std::move(file.content),
                                                          mesh.points, std::move(lists),
                                                          std::move(file.coordinates), coding);
  return mesh;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
