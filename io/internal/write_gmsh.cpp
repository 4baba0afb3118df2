#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <limits>
#include <map>
#include <tuple>
#include <unordered_map>

#include "majorant/framework/error.h"
#include "majorant/io/formats.h"
#include "majorant/io/written_mark.h"
#include "majorant/io/internal/gmsh_document.h"
#include "majorant/io/internal/cell_writers.h"
#include "majorant/io/internal/source_file.h"

namespace majorant {
namespace {

// Numbers one after the other: words, or bytes as memory has them.
class GmshWriter {
 public:
  explicit GmshWriter(GmshEncoding encoding) : is_binary_(encoding == GmshEncoding::Binary) {}

  void text(std::string_view words) { out_ += words; }
  void small(std::int64_t value) { put(static_cast<std::int32_t>(value)); }
  void large(std::int64_t value) { put(static_cast<std::uint64_t>(value)); }
  void real(double value) { put(value); }
  void end_line() {
    if (is_binary_) return;
    if (!out_.empty() && out_.back() == ' ') out_.back() = '\n';
  }
  void begin_section(std::string_view name) { out_ += fmt::format("${}\n", name); }
  void end_section(std::string_view name) {
    out_ += fmt::format("{}$End{}\n", is_binary_ ? "\n" : "", name);
  }
  bool is_binary() const { return is_binary_; }
  std::string take() { return std::move(out_); }

 private:
  template <class T>
  void put(const T& value) {
    if (is_binary_) {
      char bytes[sizeof(T)];
      std::memcpy(bytes, &value, sizeof(T));
      out_.append(bytes, sizeof(T));
    } else {
      fmt::format_to(std::back_inserter(out_), "{} ", value);
    }
  }

  bool is_binary_;
  std::string out_;
};

using EntityName = GmshDocument::EntityName;

// Elements by their entity in 4.1: where elements of one entity of 2.2 are in several physical
// groups, each further group becomes an entity of its own.
class Entities {
 public:
  explicit Entities(const GmshDocument& document) : document_(document) {
    if (document.format.version == GmshVersion::New) {
      all_ = document.entities;
      for (const GmshDocument::Element& e : document.elements) all_[name_in_file(e)];
      return;
    }
    for (const GmshDocument::Element& e : document.elements) {
      int& last = last_[gmsh_dimension(e.type)];
      last = std::max(last, tag_in_file(e));
    }
    for (const GmshDocument::Element& e : document.elements) {
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

  int tag_of(const GmshDocument::Element& e) const {
    if (split_.empty()) return e.entity;
    return split_.at({gmsh_dimension(e.type), tag_in_file(e), e.physical});
  }
  const std::map<EntityName, GmshDocument::Entity>& all() const { return all_; }

  // Returns the entity of each node: that of the file, else of the element of fewest dimensions
  // that has it.
  std::vector<EntityName> of_nodes() const {
    std::unordered_map<std::int64_t, EntityName> found;
    for (const GmshDocument::Element& e : document_.elements) {
      const EntityName name{gmsh_dimension(e.type), tag_of(e)};
      for (int k = 0; k < gmsh_node_count(e.type); ++k) {
        const auto [at, is_new] = found.try_emplace(
            document_.element_nodes[e.first_node + static_cast<std::size_t>(k)], name);
        if (!is_new && name.first < at->second.first) at->second = name;
      }
    }
    std::vector<EntityName> out;
    for (const GmshDocument::Node& node : document_.nodes) {
      const auto at = found.find(node.tag);
      out.push_back(node.entity.first >= 0 ? node.entity
                    : at != found.end()    ? at->second
                                           : all_.rbegin()->first);
    }
    return out;
  }

 private:
  static int tag_in_file(const GmshDocument::Element& e) { return std::max(e.entity, 1); }
  EntityName name_in_file(const GmshDocument::Element& e) const {
    const bool is_new = document_.format.version == GmshVersion::New;
    return {gmsh_dimension(e.type), is_new ? e.entity : tag_in_file(e)};
  }

  void find_boxes() {
    constexpr double kLargest = std::numeric_limits<double>::max();
    for (auto& [name, entity] : all_)
      entity.box = {kLargest, kLargest, kLargest, -kLargest, -kLargest, -kLargest};
    std::unordered_map<std::int64_t, const GmshDocument::Node*> nodes;
    for (const GmshDocument::Node& node : document_.nodes) nodes[node.tag] = &node;
    for (const GmshDocument::Element& e : document_.elements) {
      auto& box = all_.at({gmsh_dimension(e.type), tag_of(e)}).box;
      for (int k = 0; k < gmsh_node_count(e.type); ++k) {
        const auto& at =
            nodes.at(document_.element_nodes[e.first_node + static_cast<std::size_t>(k)])->at;
        for (std::size_t c = 0; c < 3; ++c) {
          box[c] = std::min(box[c], at[c]);
          box[c + 3] = std::max(box[c + 3], at[c]);
        }
      }
    }
  }

  const GmshDocument& document_;
  std::map<int, int> last_;  // the largest tag of a dimension
  std::map<std::tuple<int, int, int>, int> split_;
  std::map<EntityName, GmshDocument::Entity> all_;
};

// Ranges of equal names that follow each other.
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
    for (int dim = 0; dim < 4; ++dim)
      out_.large(std::count_if(entities_.all().begin(), entities_.all().end(),
                               [&](const auto& entity) { return entity.first.first == dim; }));
    out_.end_line();
    for (const auto& [name, entity] : entities_.all()) {
      out_.small(name.second);
      for (std::size_t c = 0; c < (name.first == 0 ? 3u : 6u); ++c) out_.real(entity.box[c]);
      write_tags(entity.physicals);
      if (name.first > 0) write_tags(entity.bounding);
      out_.end_line();
    }
    out_.end_section("Entities");
  }
  void write_tags(const std::vector<int>& tags) {
    out_.large(static_cast<std::int64_t>(tags.size()));
    for (const int tag : tags) out_.small(tag);
  }

  template <class Items>
  void write_counts(std::size_t blocks, const Items& items) {
    std::int64_t least = std::numeric_limits<std::int64_t>::max(), most = 0;
    for (const auto& item : items) {
      least = std::min(least, item.tag);
      most = std::max(most, item.tag);
    }
    out_.large(static_cast<std::int64_t>(blocks));
    out_.large(static_cast<std::int64_t>(items.size()));
    out_.large(least);
    out_.large(most);
    out_.end_line();
  }

  void write_nodes() {
    const std::vector<EntityName> names = entities_.of_nodes();
    const auto runs = runs_of(names);
    out_.begin_section("Nodes");
    write_counts(runs.size(), document_.nodes);
    for (const auto& [begin, end] : runs) {
      out_.small(names[begin].first);
      out_.small(names[begin].second);
      out_.small(0);  // no parameters
      out_.large(static_cast<std::int64_t>(end - begin));
      out_.end_line();
      for (std::size_t k = begin; k < end; ++k) {
        out_.large(document_.nodes[k].tag);
        out_.end_line();
      }
      for (std::size_t k = begin; k < end; ++k) {
        for (const double x : document_.nodes[k].at) out_.real(x);
        out_.end_line();
      }
    }
    out_.end_section("Nodes");
  }

  void write_elements() {
    std::vector<std::pair<int, int>> names;  // type, entity
    for (const GmshDocument::Element& e : document_.elements)
      names.emplace_back(e.type, entities_.tag_of(e));
    const auto runs = runs_of(names);
    out_.begin_section("Elements");
    write_counts(runs.size(), document_.elements);
    for (const auto& [begin, end] : runs) {
      out_.small(gmsh_dimension(names[begin].first));
      out_.small(names[begin].second);
      out_.small(names[begin].first);
      out_.large(static_cast<std::int64_t>(end - begin));
      out_.end_line();
      for (std::size_t k = begin; k < end; ++k) {
        const GmshDocument::Element& e = document_.elements[k];
        out_.large(e.tag);
        for (int i = 0; i < gmsh_node_count(e.type); ++i)
          out_.large(document_.element_nodes[e.first_node + static_cast<std::size_t>(i)]);
        out_.end_line();
      }
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

  // Returns whether elements are in more physical groups than one, of which the first is written.
  bool write() {
    require_small_tags();
    out_.begin_section("Nodes");
    out_.text(fmt::format("{}\n", document_.nodes.size()));
    for (const GmshDocument::Node& node : document_.nodes) {
      out_.small(node.tag);
      for (const double x : node.at) out_.real(x);
      out_.end_line();
    }
    out_.end_section("Nodes");
    out_.begin_section("Elements");
    out_.text(fmt::format("{}\n", document_.elements.size()));
    std::vector<int> types;
    for (const GmshDocument::Element& e : document_.elements) types.push_back(e.type);
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
    for (const GmshDocument::Node& node : document_.nodes) require(node.tag);
    for (const GmshDocument::Element& e : document_.elements) require(e.tag);
  }

  int physical_of(const GmshDocument::Element& e) {
    if (document_.format.version == GmshVersion::Old) return e.physical;
    const auto found = document_.entities.find({gmsh_dimension(e.type), e.entity});
    if (found == document_.entities.end() || found->second.physicals.empty()) return 0;
    has_more_groups_ = has_more_groups_ || found->second.physicals.size() > 1;
    return std::abs(found->second.physicals.front());
  }

  void write_run(std::size_t begin, std::size_t end) {
    constexpr int kTags = 2;
    if (out_.is_binary()) {
      out_.small(document_.elements[begin].type);
      out_.small(static_cast<std::int64_t>(end - begin));
      out_.small(kTags);
    }
    for (std::size_t k = begin; k < end; ++k) {
      const GmshDocument::Element& e = document_.elements[k];
      out_.small(e.tag);
      if (!out_.is_binary()) {
        out_.small(e.type);
        out_.small(kTags);
      }
      out_.small(physical_of(e));
      out_.small(e.entity);
      for (int i = 0; i < gmsh_node_count(e.type); ++i)
        out_.small(document_.element_nodes[e.first_node + static_cast<std::size_t>(i)]);
      out_.end_line();
    }
  }

  const GmshDocument& document_;
  GmshWriter& out_;
  bool has_more_groups_ = false;
};

}  // namespace

std::string gmsh_content(const GmshDocument& document, const GmshFormat& wanted,
                         std::vector<std::string>* left_out) {
  GmshWriter out(wanted.encoding);
  const bool is_new = wanted.version == GmshVersion::New;
  out.text(fmt::format("$MeshFormat\n{} {} 8\n", is_new ? "4.1" : "2.2", out.is_binary() ? 1 : 0));
  if (out.is_binary()) out.small(1);
  out.end_section("MeshFormat");
  out.text(mark_text(MarkStyle::GmshSection));
  out.text(document.physical_names);
  bool has_more_groups = false;
  if (is_new)
    NewFormat(document, out).write();
  else
    has_more_groups = OldFormat(document, out).write();
  if (left_out != nullptr) {
    *left_out = document.others;
    if (has_more_groups) left_out->push_back("physical groups of elements beside their first one");
  }
  return out.take();
}

std::string gmsh_text(const VolumeMesh& mesh, const GmshChoice& choice) {
  return gmsh_content(gmsh_document_of(mesh),
                      {choice.version.value_or(GmshVersion::New),
                       choice.encoding.value_or(GmshEncoding::Text)},
                      nullptr);
}

std::string gmsh_text_in_version(const VolumeMesh& mesh, const GmshChoice& choice,
                                 std::vector<std::string>* left_out) {
  std::string content = mesh.source->with_points(mesh.points);
  const GmshFormat own = read_gmsh_format(mesh.file, content);
  const GmshFormat wanted{choice.version.value_or(own.version),
                          choice.encoding.value_or(own.encoding)};
  if (own == wanted) return with_mark(MarkStyle::GmshSection, std::move(content));
  return gmsh_content(read_gmsh_document(mesh.file, std::move(content), {}), wanted, left_out);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
