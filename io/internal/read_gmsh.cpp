#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <unordered_map>

#include "majorant/framework/error.h"
#include "majorant/io/byte_cursor.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/written_mark.h"
#include "majorant/io/internal/cell_collector.h"
#include "majorant/io/internal/gmsh_document.h"
#include "majorant/io/internal/cell_readers.h"
#include "majorant/io/internal/source_file.h"
#include "majorant/io/internal/gmsh_types.h"
#include "majorant/io/internal/token_cursor.h"

namespace majorant {
namespace {

struct GmshType {
  int number;
  CellShape shape;
  int degree;
  NodeSet set = NodeSet::Full;
  CellType type() const { return {shape, degree, NodeKind::Uniform, set}; }
};

// gmsh's numbers of element types.
constexpr auto kGmshTypes = [] {
  using enum CellShape;
  return std::to_array<GmshType>({{15, Point, 1},
                                  {1, Segment, 1},
                                  {8, Segment, 2},
                                  {26, Segment, 3},
                                  {27, Segment, 4},
                                  {2, Triangle, 1},
                                  {9, Triangle, 2},
                                  {21, Triangle, 3},
                                  {23, Triangle, 4},
                                  {3, Quad, 1},
                                  {10, Quad, 2},
                                  {16, Quad, 2, NodeSet::Serendipity},
                                  {36, Quad, 3},
                                  {37, Quad, 4},
                                  {4, Tetrahedron, 1},
                                  {11, Tetrahedron, 2},
                                  {29, Tetrahedron, 3},
                                  {30, Tetrahedron, 4},
                                  {5, Hexahedron, 1},
                                  {12, Hexahedron, 2},
                                  {17, Hexahedron, 2, NodeSet::Serendipity},
                                  {92, Hexahedron, 3},
                                  {93, Hexahedron, 4},
                                  {6, Wedge, 1},
                                  {13, Wedge, 2},
                                  {18, Wedge, 2, NodeSet::Serendipity},
                                  {90, Wedge, 3},
                                  {91, Wedge, 4}});
}();

std::optional<CellType> gmsh_type(std::int64_t number) {  // none: without a place here
  for (const GmshType& t : kGmshTypes)
    if (t.number == number) return t.type();
  return std::nullopt;
}

bool is_gmsh_pyramid(std::int64_t number) {
  constexpr std::int64_t kPyramids[] = {7, 14, 19, 118, 119, 120, 121, 122, 123, 124, 125, 132};
  return std::find(std::begin(kPyramids), std::end(kPyramids), number) != std::end(kPyramids);
}

// Numbers of a section, as words or as bytes.
class GmshNumbers {
 public:
  GmshNumbers(const std::string& file, std::string_view text, const StopCheck& stop)
      : file_(file), cursor_(file, text, 0, stop), stop_(stop) {}

  TokenCursor& words() { return cursor_; }
  bool is_binary() const { return is_binary_; }
  ByteOrder order() const { return order_; }
  void begin_binary(ByteOrder order) {
    is_binary_ = true;
    order_ = order;
  }
  // Binary numbers begin behind the end of the line with the section's name.
  void begin_section() {
    if (!is_binary_) return;
    std::size_t at = cursor_.place();
    while (at < cursor_.text().size() && cursor_.text()[at] != '\n') ++at;
    cursor_.go_to(std::min(at + 1, cursor_.text().size()));
  }

  std::int64_t small(std::string_view what) {  // an int
    return is_binary_ ? bytes<std::int32_t>() : cursor_.integer(what);
  }
  std::int64_t large(std::string_view what) {  // a size_t
    return is_binary_ ? static_cast<std::int64_t>(bytes<std::uint64_t>()) : cursor_.integer(what);
  }
  double real(std::string_view what) {
    if (!is_binary_) return cursor_.number(what);
    const auto x = bytes<double>();
    if (!std::isfinite(x)) fail(fmt::format("{} is not finite", what));
    return x;
  }
  PlacedCoordinates::Place last_place() const {
    const std::size_t begin = is_binary_ ? last_ : cursor_.begin();
    return {begin, static_cast<std::uint32_t>(cursor_.place() - begin)};
  }
  // So many things of so many bytes, or characters, at least.
  Index count(std::int64_t value, std::size_t size, std::string_view what) {
    if (value < 0 || static_cast<std::uint64_t>(value) > cursor_.remaining() / size)
      fail(fmt::format("{} {}, more than the file has; it is damaged or truncated", value, what));
    if (value > std::numeric_limits<Index>::max() / 4)
      refuse_mesh(file_, fmt::format("{} {} are too many", value, what));
    return static_cast<Index>(value);
  }
  [[noreturn]] void fail(std::string_view problem) const {
    if (!is_binary_) cursor_.fail(problem);
    throw Error(ErrorKind::Unreadable, fmt::format("{}: byte {}: {}", file_, last_, problem));
  }

 private:
  template <class T>
  T bytes() {
    stop_.poll_at(reads_++);
    last_ = cursor_.place();
    if (cursor_.remaining() < sizeof(T))
      fail("the binary data end too early; the file is truncated");
    cursor_.go_to(last_ + sizeof(T));
    return load_bytes<T>(cursor_.text().data() + last_, order_);
  }

  const std::string& file_;
  TokenCursor cursor_;
  const StopCheck& stop_;
  bool is_binary_ = false;
  ByteOrder order_ = ByteOrder::Little;
  std::size_t last_ = 0, reads_ = 0;
};

// The rows of points by gmsh's tags.
class GmshTags {
 public:
  void add(std::int64_t tag) { tags_.push_back(tag); }
  std::int64_t tag(std::size_t row) const { return tags_[row]; }
  std::size_t size() const { return tags_.size(); }
  // False where a tag comes twice.
  bool finish() {
    std::int64_t largest = 0;
    bool is_dense = true;
    for (const std::int64_t tag : tags_) {
      largest = std::max(largest, tag);
      is_dense = is_dense && tag >= 0;
    }
    constexpr std::int64_t kSpread = 8;  // entries of the table for a point, at most
    if (is_dense && largest <= kSpread * static_cast<std::int64_t>(tags_.size())) {
      row_.assign(static_cast<std::size_t>(largest) + 1, -1);
      for (std::size_t k = 0; k < tags_.size(); ++k) {
        Index& row = row_[static_cast<std::size_t>(tags_[k])];
        if (row >= 0) return false;
        row = static_cast<Index>(k);
      }
      return true;
    }
    for (std::size_t k = 0; k < tags_.size(); ++k)
      if (!sparse_.emplace(tags_[k], static_cast<Index>(k)).second) return false;
    return true;
  }
  Index row(std::int64_t tag) const {  // -1: none
    if (row_.empty()) {
      const auto found = sparse_.find(tag);
      return found == sparse_.end() ? -1 : found->second;
    }
    return tag >= 0 && static_cast<std::size_t>(tag) < row_.size()
               ? row_[static_cast<std::size_t>(tag)]
               : -1;
  }

 private:
  std::vector<std::int64_t> tags_;
  std::vector<Index> row_;
  std::unordered_map<std::int64_t, Index> sparse_;
};

// Refuses bytes that are no text in a file that does not say that it is binary.
std::string checked(const std::string& path, std::string content, const StopCheck& stop) {
  TokenCursor words(path, content, 0, stop);
  if (words.next() == "$MeshFormat") {
    words.next();
    if (words.next() == "1") return content;
  }
  require_text(path, content);
  return content;
}

class GmshReader {
 public:
  GmshReader(const std::string& path, std::string content, const StopCheck& stop)
      : path_(path),
        content_(checked(path, std::move(content), stop)),
        in_(path_, content_, stop) {}

  GmshFormat format() {
    read_format();
    return {is_old_ ? GmshVersion::Old : GmshVersion::New,
            in_.is_binary() ? GmshEncoding::Binary : GmshEncoding::Text};
  }

  GmshDocument document() {
    GmshDocument out;
    document_ = &out;
    out.format = format();
    while (read_section()) {
    }
    return out;
  }

  VolumeMesh read() {
    read_format();
    while (read_section()) {
    }
    if (tags_.size() == 0) in_.words().fail("no nodes; not a mesh, or truncated");
    VolumeMesh mesh;
    mesh.file = path_;
    mesh.points = Eigen::Map<const Points3>(points_.data(), static_cast<Index>(tags_.size()), 3);
    NodeLists lists{.coding = NodeLists::Coding::Words, .blocks = cells_.lists()};
    if (in_.is_binary()) {
      lists.coding = NodeLists::Coding::Bytes;
      lists.width = is_old_ ? sizeof(std::int32_t) : sizeof(std::uint64_t);
    }
    mesh.blocks = cells_.take();
    if (mesh.blocks.empty()) in_.words().fail("no elements; not a mesh, or truncated");
    using Coding = PlacedCoordinates::Coding;
    const bool is_native =
        (in_.order() == ByteOrder::Little) == (std::endian::native == std::endian::little);
    const Coding coding = !in_.is_binary() ? Coding::Words
                          : is_native      ? Coding::Doubles
                                           : Coding::SwappedDoubles;
    mesh.source = std::make_shared<const PlacedCoordinates>(
        path_, std::move(content_), mesh.points, std::move(lists), std::move(places_), coding);
    return mesh;
  }

 private:
  void read_format() {
    TokenCursor& words = in_.words();
    if (words.next() != "$MeshFormat") words.fail("no section $MeshFormat; not a gmsh file");
    const std::string version(words.next());
    const std::int64_t is_binary = words.integer("the file type"),
                       size = words.integer("the data size");
    is_old_ = version == "2.2" || version == "2.1" || version == "2" || version == "2.0";
    if (!is_old_ && version != "4.1")
      refuse_mesh(path_, fmt::format("MSH {}; 2.2 and 4.1 are supported, gmsh writes them by "
                                     "-format msh22 and msh41",
                                     version));
    if (size != 8) refuse_mesh(path_, fmt::format("numbers of {} bytes; 8 are supported", size));
    if (is_binary != 0) {
      in_.begin_binary(ByteOrder::Little);
      in_.begin_section();
      if (in_.words().remaining() >= 4 && in_.words().text()[in_.words().place()] == 0)
        in_.begin_binary(ByteOrder::Big);
      if (in_.small("the number 1") != 1) in_.fail("the byte order is not known; damaged file");
    }
    if (in_.words().next() != "$EndMeshFormat") in_.words().fail("$EndMeshFormat is missing");
  }

  bool read_section() {
    TokenCursor& words = in_.words();
    const std::string name(words.next());
    if (name.empty()) return false;
    if (name[0] != '$') words.fail(fmt::format("{} where a section begins", in_quotes(name)));
    const std::string end = "$End" + name.substr(1);
    if (name == "$Nodes" || name == "$Elements") {
      in_.begin_section();
      if (name == "$Nodes")
        is_old_ ? read_old_nodes() : read_nodes();
      else
        is_old_ ? read_old_elements() : read_elements();
      if (words.next() != end)
        words.fail(end +
                   " is missing; the counts are wrong, or the file is "
                   "truncated");
      return true;
    }
    if (document_ != nullptr && name == "$Entities" && !is_old_) {
      in_.begin_section();
      read_entities();
      if (words.next() != end) words.fail(end + " is missing");
      return true;
    }
    if (name == "$ParametricNodes" || name == "$PartitionedEntities" || name == "$NOD")
      refuse_mesh(path_, fmt::format("a section {}; save the mesh without it", name));
    const std::size_t found = words.text().find("\n" + end, words.place());
    if (found == std::string_view::npos) words.fail(end + " is missing; the file is truncated");
    if (document_ != nullptr) {
      const std::size_t begin = words.begin();
      if (name == "$PhysicalNames")
        document_->physical_names =
            std::string(words.text().substr(begin, found + 1 + end.size() - begin)) + "\n";
      else if (!is_mark(words.text().substr(words.place(), found - words.place())))
        document_->others.push_back("section " + name);
    }
    words.go_to(found + 1 + end.size());
    return true;
  }

  // Returns whether the text of a section is our mark, which is written anew.
  static bool is_mark(std::string_view text) {
    const std::size_t begin = text.find_first_not_of(" \t\r\n");
    return begin != std::string_view::npos && is_written_mark(text.substr(begin));
  }

  void read_entities() {
    std::array<Index, 4> counts{};
    for (Index& count : counts)
      count = in_.count(in_.large("the number of entities"), 4, "entities");
    const auto read_tags = [&](std::vector<int>& out) {
      const Index count = in_.count(in_.large("the number of tags"), 2, "tags");
      for (Index k = 0; k < count; ++k) out.push_back(static_cast<int>(in_.small("a tag")));
    };
    for (int dim = 0; dim < 4; ++dim)
      for (Index k = 0; k < counts[to_size(dim)]; ++k) {
        GmshDocument::Entity& entity =
            document_->entities[{dim, static_cast<int>(in_.small("a tag"))}];
        for (std::size_t c = 0; c < (dim == 0 ? 3u : 6u); ++c) entity.box[c] = in_.real("a bound");
        read_tags(entity.physicals);
        if (dim > 0) read_tags(entity.bounding);
      }
  }

  void add_coordinates() {
    for (const char* const what : {"x", "y", "z"}) {
      points_.push_back(in_.real(what));
      places_.push_back(in_.last_place());
    }
  }

  // The node whose coordinates were read last.
  void add_node_of(GmshDocument::EntityName entity) {
    const std::size_t k = document_->nodes.size();
    document_->nodes.push_back(
        {tags_.tag(k), {points_[3 * k], points_[3 * k + 1], points_[3 * k + 2]}, entity});
  }

  // Once each.
  void note_other(const char* what) {
    if (document_ == nullptr) return;
    std::vector<std::string>& others = document_->others;
    if (std::find(others.begin(), others.end(), what) == others.end()) others.push_back(what);
  }

  void finish_nodes() {
    if (!tags_.finish()) in_.fail("two nodes have one tag");
  }

  void require_first_nodes() {
    if (tags_.size() > 0) in_.fail("a second section $Nodes");
  }

  void read_old_nodes() {
    require_first_nodes();
    const Index count = in_.count(in_.words().count("the number of nodes"), 7, "nodes");
    in_.begin_section();
    for (Index k = 0; k < count; ++k) {
      tags_.add(in_.small("a node"));
      add_coordinates();
      if (document_ != nullptr) add_node_of({-1, 0});
    }
    finish_nodes();
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
      for (Index k = 0; k < count; ++k) tags_.add(in_.large("a node"));
      for (Index k = 0; k < count; ++k) {
        add_coordinates();
        if (document_ != nullptr) add_node_of({static_cast<int>(dim), static_cast<int>(entity)});
        for (std::int64_t c = 0; is_parametric != 0 && c < dim; ++c) in_.real("a parameter");
      }
    }
    finish_nodes();
  }

  const CellType& type_of(std::int64_t number) {
    const auto known = types_.find(number);
    if (known != types_.end()) return known->second.first;
    const std::optional<CellType> type = gmsh_type(number);
    if (!type)
      refuse_mesh(path_,
                  is_gmsh_pyramid(number)
                      ? "pyramids; tetrahedra, hexahedra, wedges, triangles and quads are "
                        "supported"
                      : fmt::format("elements of gmsh's type {}; simplices, quads, hexahedra "
                                    "and wedges of degrees 1 to 4 are supported",
                                    number));
    return types_.emplace(number, std::pair(*type, gmsh_order(*type))).first->second.first;
  }

  void add_cell(std::int64_t gmsh_number, std::int64_t tag, std::int64_t region) {
    const auto& [type, order] = types_.at(gmsh_number);
    cells_.add(type, order, nodes_, tag, static_cast<int>(region), list_begin_);
  }

  // The element whose nodes were read last.
  void add_element(std::int64_t tag, std::int64_t number, std::int64_t physical,
                   std::int64_t entity) {
    document_->elements.push_back({tag, static_cast<int>(number), static_cast<int>(physical),
                                   static_cast<int>(entity), document_->element_nodes.size()});
    for (const Index row : nodes_) document_->element_nodes.push_back(tags_.tag(to_size(row)));
  }

  void add_node(std::int64_t tag) {
    const Index row = tags_.row(tag);
    if (row < 0) in_.fail(fmt::format("an element has node {}, which is not there", tag));
    if (nodes_.empty()) list_begin_ = in_.last_place().begin;
    nodes_.push_back(row);
  }

  void read_elements() {
    const Index blocks = in_.count(in_.large("the number of blocks"), 7, "blocks");
    in_.count(in_.large("the number of elements"), 3, "elements");
    in_.large("the smallest tag");
    in_.large("the largest tag");
    for (Index b = 0; b < blocks; ++b) {
      in_.small("a dimension");
      const std::int64_t region = in_.small("a tag"), number = in_.small("a type");
      const CellType& type = type_of(number);
      const Index count = in_.count(in_.large("the number of elements"), 3, "elements");
      for (Index k = 0; k < count; ++k) {
        const std::int64_t tag = in_.large("an element");
        nodes_.clear();
        for (int i = 0; i < type.node_count(); ++i) add_node(in_.large("a node"));
        if (document_ != nullptr) add_element(tag, number, 0, region);
        add_cell(number, tag, region);
      }
    }
  }

  void read_old_elements() {
    const Index count = in_.count(in_.words().count("the number of elements"), 3, "elements");
    in_.begin_section();
    Index in_block = 0;  // of binary files, whose elements have common headers
    std::int64_t number = 0, tags = 0;
    for (Index k = 0; k < count; ++k) {
      std::int64_t element = 0;
      if (in_.is_binary()) {
        if (in_block == 0) {
          number = in_.small("a type");
          in_block = in_.count(in_.small("the number of elements"), 4, "elements");
          tags = in_.small("the number of tags");
          if (in_block == 0) in_.fail("a block without elements");
        }
        --in_block;
        element = in_.small("an element");
      } else {
        element = in_.small("an element");
        number = in_.small("a type");
        tags = in_.small("the number of tags");
      }
      const CellType& type = type_of(number);
      std::int64_t region = 0, entity = 0;
      for (std::int64_t t = 0; t < tags; ++t) {
        const std::int64_t tag = in_.small("a tag");
        if (t == 0) region = tag;
        if (t == 1) entity = tag;
      }
      // The third tag counts the partitions of the element, which follow.
      if (tags > 2) note_other("partitions of elements");
      nodes_.clear();
      for (int i = 0; i < type.node_count(); ++i) add_node(in_.small("a node"));
      if (document_ != nullptr) add_element(element, number, region, entity);
      add_cell(number, element, region);
    }
  }

  const std::string& path_;
  std::string content_;
  GmshNumbers in_;
  bool is_old_ = false;
  GmshTags tags_;
  std::vector<double> points_;
  std::vector<PlacedCoordinates::Place> places_;
  std::unordered_map<std::int64_t, std::pair<CellType, std::vector<int>>> types_;
  std::vector<Index> nodes_;
  std::size_t list_begin_ = 0;  // where the first of them stands
  CellCollector cells_;
  GmshDocument* document_ = nullptr;  // where to note what is read, if anywhere
};

}  // namespace

int gmsh_node_count(int type) { return gmsh_type(type)->node_count(); }
int gmsh_dimension(int type) { return dimension(gmsh_type(type)->shape); }

GmshDocument gmsh_document_of(const VolumeMesh& mesh) {
  GmshDocument out;
  out.format.version = GmshVersion::Old;  // of which physical groups are the elements'
  for (Index k = 0; k < mesh.points.rows(); ++k)
    out.nodes.push_back(
        {k + 1, {mesh.points(k, 0), mesh.points(k, 1), mesh.points(k, 2)}, {-1, 0}});
  for (const CellBlock& block : mesh.blocks) {
    const auto known = std::find_if(kGmshTypes.begin(), kGmshTypes.end(),
                                    [&](const GmshType& t) { return t.type() == block.type; });
    if (known == kGmshTypes.end())
      refuse_mesh(mesh.file, describe(block.type) + " whose nodes are not those of a lattice");
    const std::vector<int> order = gmsh_order(block.type);
    for (Index cell = 0; cell < block.size(); ++cell) {
      const int region = block.regions[to_size(cell)];
      out.elements.push_back({static_cast<std::int64_t>(out.elements.size()) + 1, known->number,
                              region, region, out.element_nodes.size()});
      for (const int k : order) out.element_nodes.push_back(block.nodes(cell, k) + 1);
    }
  }
  return out;
}

GmshFormat read_gmsh_format(const std::string& path, std::string content) {
  return GmshReader(path, std::move(content), {}).format();
}

GmshDocument read_gmsh_document(const std::string& path, std::string content,
                                const StopCheck& stop) {
  return GmshReader(path, std::move(content), stop).document();
}

VolumeMesh read_gmsh_mesh(const std::string& path, std::string content, const StopCheck& stop) {
  return GmshReader(path, std::move(content), stop).read();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
