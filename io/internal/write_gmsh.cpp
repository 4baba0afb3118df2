#include <fmt/compile.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <limits>
#include <map>
#include <tuple>
#include <unordered_map>

#include "majorant/framework/error.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/formats.h"
#include "majorant/io/internal/cell_readers.h"
#include "majorant/io/internal/cell_writers.h"
#include "majorant/io/internal/gmsh_document.h"
#include "majorant/io/internal/gmsh_types.h"
#include "majorant/io/internal/text_pieces.h"
#include "majorant/io/io.h"
#include "majorant/io/lagrange_cell.h"
#include "majorant/io/map_check.h"
#include "majorant/io/written_mark.h"

namespace majorant {
namespace {

// Consecutive numbers, as words of a line or as bytes in the machine's order.
class GmshLine {
 public:
  GmshLine(fmt::appender out, GmshEncoding encoding)
      : out_(out), is_binary_(encoding == GmshEncoding::Binary) {}
  void small(std::int64_t value) { put(static_cast<std::int32_t>(value)); }
  void large(std::int64_t value) { put(static_cast<std::uint64_t>(value)); }
  void real(double value) { put(value); }
  bool is_binary() const { return is_binary_; }
  void end() {
    if (!is_binary_) *out_++ = '\n';
  }

 private:
  template <class T>
  void put(const T& value) {
    if (is_binary_) {
      char bytes[sizeof(T)];
      std::memcpy(bytes, &value, sizeof(T));
      out_ = std::copy(bytes, bytes + sizeof(T), out_);
      return;
    }
    if (!is_first_) *out_++ = ' ';
    is_first_ = false;
    out_ = fmt::format_to(out_, FMT_COMPILE("{}"), value);
  }

  fmt::appender out_;
  bool is_binary_, is_first_ = true;
};

class GmshWriter {
 public:
  explicit GmshWriter(GmshEncoding encoding) : encoding_(encoding) {}

  void text(std::string_view words) { pieces_.add(words); }
  // Calls write(k, line) for every line, on all threads.
  template <class Write>
  void lines(std::size_t count, const Write& write) {
    pieces_.add_lines(static_cast<Index>(count), [&](Index k, fmt::appender out) {
      GmshLine line(out, encoding_);
      write(to_size(k), line);
      line.end();
    });
  }
  template <class Write>
  void line(const Write& write) {
    lines(1, [&](std::size_t, GmshLine& line) { write(line); });
  }
  void begin_section(std::string_view name) { text(fmt::format("${}\n", name)); }
  void end_section(std::string_view name) {
    text(fmt::format("{}$End{}\n", is_binary() ? "\n" : "", name));
  }
  bool is_binary() const { return encoding_ == GmshEncoding::Binary; }
  std::string take() { return pieces_.take(); }

 private:
  GmshEncoding encoding_;
  TextPieces pieces_;
};

using EntityName = GmshDocument::EntityName;
using Element = GmshDocument::Element;

// Elements by entity in 4.1. If elements of one entity of 2.2 are in several physical groups, each
// further group becomes an entity of its own.
class Entities {
 public:
  explicit Entities(const GmshDocument& document) : document_(document) {
    for (const Element& e : document.elements) {
      if (types_.contains(e.type)) continue;
      types_[e.type] = {gmsh_dimension(e.type), to_size(gmsh_node_count(e.type))};
    }
    if (document.format.version == GmshVersion::New) {
      all_ = document.entities;
      for (const Element& e : document.elements) all_[name_in_file(e)];
      return;
    }
    for (const Element& e : document.elements) {
      int& last = last_[dimension_of(e)];
      last = std::max(last, tag_in_file(e));
    }
    for (const Element& e : document.elements) {
      const auto [dim, tag] = name_in_file(e);
      const auto key = std::tuple(dim, tag, e.physical);
      if (split_.contains(key)) continue;
      const bool is_first = !all_.contains({dim, tag});
      const EntityName name{dim, is_first ? tag : ++last_[dim]};
      split_[key] = name.second;
      if (e.physical != 0) all_[name].physicals.push_back(e.physical);
      all_[name];
    }
    find_boxes();
  }

  int tag_of(const Element& e) const {
    if (split_.empty()) return e.entity;
    return split_.at({dimension_of(e), tag_in_file(e), e.physical});
  }
  const std::map<EntityName, GmshDocument::Entity>& all() const { return all_; }

  // Returns the entity of each node: that of the file, else that of its element of lowest
  // dimension.
  std::vector<EntityName> of_nodes() const {
    std::vector<EntityName> out = document_.node_entities;
    if (std::all_of(out.begin(), out.end(), [](const EntityName& e) { return e.first >= 0; }))
      return out;
    std::unordered_map<std::int64_t, EntityName> found;
    for (const Element& e : document_.elements) {
      const EntityName name{dimension_of(e), tag_of(e)};
      for (std::size_t k = 0; k < nodes_of(e); ++k) {
        const auto [at, is_new] =
            found.try_emplace(document_.element_nodes[e.first_node + k], name);
        if (!is_new && name.first < at->second.first) at->second = name;
      }
    }
    for (std::size_t k = 0; k < out.size(); ++k) {
      if (out[k].first >= 0) continue;
      const auto at = found.find(document_.node_tags[k]);
      out[k] = at != found.end() ? at->second : all_.rbegin()->first;
    }
    return out;
  }

 private:
  int dimension_of(const Element& e) const { return types_.at(e.type).first; }
  std::size_t nodes_of(const Element& e) const { return types_.at(e.type).second; }
  static int tag_in_file(const Element& e) { return std::max(e.entity, 1); }
  EntityName name_in_file(const Element& e) const {
    const bool is_new = document_.format.version == GmshVersion::New;
    return {dimension_of(e), is_new ? e.entity : tag_in_file(e)};
  }

  void find_boxes() {
    constexpr double kLargest = std::numeric_limits<double>::max();
    for (auto& [name, entity] : all_)
      entity.box = {kLargest, kLargest, kLargest, -kLargest, -kLargest, -kLargest};
    std::unordered_map<std::int64_t, std::size_t> nodes;
    for (std::size_t k = 0; k < document_.node_tags.size(); ++k) nodes[document_.node_tags[k]] = k;
    for (const Element& e : document_.elements) {
      auto& box = all_.at({dimension_of(e), tag_of(e)}).box;
      for (std::size_t k = 0; k < nodes_of(e); ++k) {
        const auto at = document_.node(nodes.at(document_.element_nodes[e.first_node + k]));
        for (std::size_t c = 0; c < 3; ++c) {
          box[c] = std::min(box[c], at[c]);
          box[c + 3] = std::max(box[c + 3], at[c]);
        }
      }
    }
  }

  const GmshDocument& document_;
  std::map<int, std::pair<int, std::size_t>> types_;  // entity tag -> dimension, number of nodes
  std::map<int, int> last_;                           // dimension -> largest tag
  std::map<std::tuple<int, int, int>, int> split_;
  std::map<EntityName, GmshDocument::Entity> all_;
};

// Finds ranges of equal consecutive names.
template <class Name>
std::vector<std::pair<std::size_t, std::size_t>> runs_of(const std::vector<Name>& names) {
  std::vector<std::pair<std::size_t, std::size_t>> out;
  for (std::size_t k = 0; k < names.size(); ++k)
    if (k == 0 || names[k] != names[k - 1])
      out.emplace_back(k, k + 1);
    else
      out.back().second = k + 1;
  return out;
}

class NewFormat {
 public:
  NewFormat(const GmshDocument& document, GmshWriter& out)
      : document_(document), entities_(document), out_(out) {}

  void write() {
    write_entities();
    write_nodes();
    write_elements();
  }

 private:
  void write_entities() {
    out_.begin_section("Entities");
    out_.line([&](GmshLine& line) {
      for (int dim = 0; dim < 4; ++dim)
        line.large(std::count_if(entities_.all().begin(), entities_.all().end(),
                                 [&](const auto& entity) { return entity.first.first == dim; }));
    });
    for (const auto& [name, entity] : entities_.all())
      out_.line([&, &name = name, &entity = entity](GmshLine& line) {
        line.small(name.second);
        for (std::size_t c = 0; c < (name.first == 0 ? 3u : 6u); ++c) line.real(entity.box[c]);
        write_tags(entity.physicals, line);
        if (name.first > 0) write_tags(entity.bounding, line);
      });
    out_.end_section("Entities");
  }
  static void write_tags(const std::vector<int>& tags, GmshLine& line) {
    line.large(static_cast<std::int64_t>(tags.size()));
    for (const int tag : tags) line.small(tag);
  }

  template <class Items, class TagOf>
  void write_counts(std::size_t blocks, const Items& items, const TagOf& tag_of) {
    std::int64_t least = std::numeric_limits<std::int64_t>::max(), most = 0;
    for (const auto& item : items) {
      least = std::min(least, tag_of(item));
      most = std::max(most, tag_of(item));
    }
    out_.line([&](GmshLine& line) {
      line.large(static_cast<std::int64_t>(blocks));
      line.large(static_cast<std::int64_t>(items.size()));
      line.large(least);
      line.large(most);
    });
  }

  void write_nodes() {
    const std::vector<EntityName> names = entities_.of_nodes();
    const auto runs = runs_of(names);
    out_.begin_section("Nodes");
    write_counts(runs.size(), document_.node_tags, [](std::int64_t tag) { return tag; });
    for (const auto& [first, last] : runs) {
      const std::size_t begin = first, count = last - first;
      out_.line([&](GmshLine& line) {
        line.small(names[begin].first);
        line.small(names[begin].second);
        line.small(0);  // no parameters
        line.large(static_cast<std::int64_t>(count));
      });
      out_.lines(count, [&](std::size_t k, GmshLine& line) {
        line.large(document_.node_tags[begin + k]);
      });
      out_.lines(count, [&](std::size_t k, GmshLine& line) {
        for (const double x : document_.node(begin + k)) line.real(x);
      });
    }
    out_.end_section("Nodes");
  }

  void write_elements() {
    std::vector<std::pair<int, int>> names;  // type, entity
    for (const Element& e : document_.elements) names.emplace_back(e.type, entities_.tag_of(e));
    const auto runs = runs_of(names);
    out_.begin_section("Elements");
    write_counts(runs.size(), document_.elements, [](const Element& e) { return e.tag; });
    for (const auto& [first, last] : runs) {
      const std::size_t begin = first;
      out_.line([&, count = last - first](GmshLine& line) {
        line.small(gmsh_dimension(names[begin].first));
        line.small(names[begin].second);
        line.small(names[begin].first);
        line.large(static_cast<std::int64_t>(count));
      });
      const std::size_t nodes = to_size(gmsh_node_count(names[begin].first));
      out_.lines(last - first, [&](std::size_t k, GmshLine& line) {
        const Element& e = document_.elements[begin + k];
        line.large(e.tag);
        for (std::size_t i = 0; i < nodes; ++i)
          line.large(document_.element_nodes[e.first_node + i]);
      });
    }
    out_.end_section("Elements");
  }

  const GmshDocument& document_;
  const Entities entities_;
  GmshWriter& out_;
};

class OldFormat {
 public:
  OldFormat(const GmshDocument& document, GmshWriter& out) : document_(document), out_(out) {}

  // Writes the elements. Returns whether some are in several physical groups, of which only the
  // first is written.
  bool write() {
    require_small_tags();
    out_.begin_section("Nodes");
    out_.text(fmt::format("{}\n", document_.node_tags.size()));
    out_.lines(document_.node_tags.size(), [&](std::size_t k, GmshLine& line) {
      line.small(document_.node_tags[k]);
      for (const double x : document_.node(k)) line.real(x);
    });
    out_.end_section("Nodes");
    out_.begin_section("Elements");
    out_.text(fmt::format("{}\n", document_.elements.size()));
    std::vector<int> types;
    for (const Element& e : document_.elements) {
      types.push_back(e.type);
      physicals_.push_back(physical_of(e));
    }
    for (const auto& [begin, end] : runs_of(types)) write_run(begin, end);
    out_.end_section("Elements");
    return has_more_groups_;
  }

 private:
  void require_small_tags() const {
    constexpr std::int64_t kLargest = std::numeric_limits<std::int32_t>::max();
    const auto require = [&](std::int64_t tag) {
      if (tag > kLargest)
        throw Error(ErrorKind::Unsupported,
                    fmt::format("MSH 2.2 has no tags above {}; there is {}", kLargest, tag));
    };
    for (const std::int64_t tag : document_.node_tags) require(tag);
    for (const Element& e : document_.elements) require(e.tag);
  }

  int physical_of(const Element& e) {
    if (document_.format.version == GmshVersion::Old) return e.physical;
    const auto found = document_.entities.find({gmsh_dimension(e.type), e.entity});
    if (found == document_.entities.end() || found->second.physicals.empty()) return 0;
    has_more_groups_ = has_more_groups_ || found->second.physicals.size() > 1;
    return std::abs(found->second.physicals.front());
  }

  void write_run(std::size_t begin, std::size_t end) {
    constexpr int kTags = 2;
    const int type = document_.elements[begin].type;
    if (out_.is_binary())
      out_.line([&](GmshLine& line) {
        line.small(type);
        line.small(static_cast<std::int64_t>(end - begin));
        line.small(kTags);
      });
    const std::size_t nodes = to_size(gmsh_node_count(type));
    out_.lines(end - begin, [&](std::size_t k, GmshLine& line) {
      const Element& e = document_.elements[begin + k];
      line.small(e.tag);
      if (!line.is_binary()) {
        line.small(type);
        line.small(kTags);
      }
      line.small(physicals_[begin + k]);
      line.small(e.entity);
      for (std::size_t i = 0; i < nodes; ++i) line.small(document_.element_nodes[e.first_node + i]);
    });
  }

  const GmshDocument& document_;
  GmshWriter& out_;
  std::vector<int> physicals_;  // by element
  bool has_more_groups_ = false;
};

// Writes one number per node, which gmsh shows as colours and level lines.
void write_view(char name, const GmshDocument::Tagged<double>& view, GmshWriter& out) {
  if (view.tags.empty()) return;
  out.text(fmt::format("$NodeData\n1\n\"{}\"\n1\n0\n3\n0\n1\n{}\n", name, view.tags.size()));
  out.lines(view.tags.size(), [&](std::size_t k, GmshLine& line) {
    line.small(view.tags[k]);
    line.real(view.numbers[k]);
  });
  out.end_section("NodeData");
}

void write_input_numbers(std::string_view name, const GmshDocument::Tagged<Index>& numbers,
                         GmshWriter& out) {
  if (numbers.tags.empty()) return;
  out.text(fmt::format("${}\n{}\n", name, numbers.tags.size()));
  out.lines(numbers.tags.size(), [&](std::size_t k, GmshLine& line) {
    line.small(numbers.tags[k]);
    line.small(numbers.numbers[k]);
  });
  out.end_section(name);
}

// Adds values with tags from 1.
template <class Number, class Values>
GmshDocument::Tagged<Number> tagged(const Values& values) {
  GmshDocument::Tagged<Number> out;
  for (Eigen::Index k = 0; k < values.size(); ++k) {
    out.tags.push_back(k + 1);
    out.numbers.push_back(values[k]);
  }
  return out;
}

// Makes a document of a map's triangles with these nodes. Every chart is a surface entity.
GmshDocument document_of_map(const MapFile& map, const Points3& nodes) {
  struct Chart {
    std::vector<Index> cells, nodes;
  };
  std::map<Index, Chart> charts;
  std::vector<char> is_placed(to_size(static_cast<Index>(nodes.rows())), 0);
  for (Index c = 0; c < map.cells.rows(); ++c) {
    Chart& chart = charts[map.chart.size() == 0 ? 0 : map.chart[c]];
    chart.cells.push_back(c);
    for (const Index p : map.cells.row(c))
      if (!std::exchange(is_placed[to_size(p)], 1)) chart.nodes.push_back(p);
  }
  for (std::size_t p = 0; p < is_placed.size(); ++p)  // points without a cell
    if (!is_placed[p]) charts.begin()->second.nodes.push_back(static_cast<Index>(p));

  GmshDocument out;
  out.format.version = GmshVersion::New;
  const int type = *gmsh_number({CellShape::Triangle, map.degree});
  if (map.chart.size() > 0) out.physical_names = fmt::format("$PhysicalNames\n{}\n", charts.size());
  for (const auto& [number, chart] : charts) {
    const int tag = number + 1;
    for (const Index p : chart.nodes) {
      out.node_tags.push_back(std::int64_t{p} + 1);
      out.node_entities.emplace_back(2, tag);
      for (const double x : nodes.row(p)) out.coordinates.push_back(x);
    }
    for (const Index c : chart.cells) {
      out.elements.push_back({std::int64_t{c} + 1, type, 0, tag, out.element_nodes.size()});
      for (const Index p : map.cells.row(c)) out.element_nodes.push_back(std::int64_t{p} + 1);
    }
    const Cells cells = map.cells(chart.cells, Eigen::all);
    const Points3 here = nodes(cells.reshaped(), Eigen::all);
    const Eigen::RowVector3d low = here.colwise().minCoeff(), high = here.colwise().maxCoeff();
    GmshDocument::Entity& entity = out.entities[{2, tag}];
    entity.box = {low[0], low[1], low[2], high[0], high[1], high[2]};
    if (map.chart.size() == 0) continue;
    entity.physicals.push_back(tag);
    out.physical_names += fmt::format("2 {} \"chart {}\"\n", tag, number);
  }
  if (map.chart.size() > 0) out.physical_names += "$EndPhysicalNames\n";
  return out;
}

}  // namespace

GmshDocument gmsh_document_of(const VolumeMesh& mesh) {
  GmshDocument out;
  out.format.version = GmshVersion::Old;  // there physical groups are tags of elements
  for (Index k = 0; k < mesh.points.rows(); ++k) {
    out.node_tags.push_back(std::int64_t{k} + 1);
    out.node_entities.emplace_back(-1, 0);
    for (const double x : mesh.points.row(k)) out.coordinates.push_back(x);
  }
  for (const CellBlock& block : mesh.blocks) {
    const std::optional<int> number = gmsh_number(block.type);
    if (!number)
      refuse_mesh(mesh.file, describe(block.type) + " whose nodes are not those of a lattice");
    const std::vector<int> order = gmsh_order(block.type);
    for (Index cell = 0; cell < block.size(); ++cell) {
      const int region = block.regions[to_size(cell)];
      out.elements.push_back({static_cast<std::int64_t>(out.elements.size()) + 1, *number, region,
                              region, out.element_nodes.size()});
      for (const int k : order) out.element_nodes.push_back(block.nodes(cell, k) + 1);
    }
  }
  return out;
}

std::string gmsh_content(const GmshDocument& document, const GmshFormat& format,
                         std::vector<std::string>* left_out) {
  GmshWriter out(format.encoding);
  const bool is_new = format.version == GmshVersion::New;
  out.text(fmt::format("$MeshFormat\n{} {} 8\n", is_new ? "4.1" : "2.2", out.is_binary() ? 1 : 0));
  if (out.is_binary()) out.line([](GmshLine& line) { line.small(1); });
  out.end_section("MeshFormat");
  out.text(mark_text(MarkStyle::GmshSection));
  out.text(document.physical_names);
  bool has_more_groups = false;
  if (is_new)
    NewFormat(document, out).write();
  else
    has_more_groups = OldFormat(document, out).write();
  write_view('u', document.u, out);
  write_view('v', document.v, out);
  write_input_numbers(kGmshInputVertex, document.input_vertex, out);
  write_input_numbers(kGmshInputFace, document.input_face, out);
  if (left_out != nullptr) {
    *left_out = document.others;
    if (has_more_groups) left_out->push_back("physical groups of elements beside their first one");
  }
  return out.take();
}

std::string gmsh_text(const VolumeMesh& mesh, const GmshChoice& choice) {
  return gmsh_content(
      gmsh_document_of(mesh),
      {choice.version.value_or(GmshVersion::New), choice.encoding.value_or(GmshEncoding::Text)},
      nullptr);
}

std::string gmsh_text_in_version(const VolumeMesh& mesh, const GmshChoice& choice,
                                 std::vector<std::string>* left_out) {
  std::string content = mesh.source->with_points(mesh.points);
  const GmshFormat own = read_gmsh_format(mesh.file, content);
  const GmshFormat format{choice.version.value_or(own.version),
                          choice.encoding.value_or(own.encoding)};
  if (own == format) return with_mark(MarkStyle::GmshSection, std::move(content));
  const GmshFile file = read_gmsh_file(mesh.file, std::move(content), GmshParts::Volume, {});
  return gmsh_content(file.document, format, left_out);
}

void write_msh(const std::string& path, const MapFile& map, MshContent content,
               const FileVerification& verify) {
  require_sound(path, map);
  if (content == MshContent::Surface) require_complete(path, map);
  require_lagrange_degree(path, map);
  const Points2 uv = lagrange_nodes(map);
  Points3 nodes = map.points;  // for flat triangles control points are values, too
  if (content == MshContent::Image) nodes << uv, Vec::Zero(uv.rows());
  GmshDocument document = document_of_map(map, nodes);
  if (content == MshContent::Surface) {
    document.u = tagged<double>(uv.col(0));
    document.v = tagged<double>(uv.col(1));
    document.input_vertex = tagged<Index>(map.input_vertex);
    document.input_face = tagged<Index>(map.input_face);
  }
  const GmshFormat format{GmshVersion::New, GmshEncoding::Text};
  write_file_atomically(path, gmsh_content(document, format, nullptr), verify);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
