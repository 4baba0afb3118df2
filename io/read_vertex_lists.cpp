#include "majorant/io/read_vertex_lists.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/internal/text_cursor.h"
#include "majorant/io/json_depth.h"
#include "majorant/maps/map_problem.h"

namespace majorant {
namespace {

using Json = nlohmann::json;

// A list in JSON, {KEY: [entry, ...], "index_base": 0}, whose entries name vertices.
class VertexList {
 public:
  // example: a valid file, for messages.
  VertexList(const std::string& path, std::string_view key, std::string_view example,
             Index vertex_count, const StopCheck& stop)
      : path_(path), key_(key), vertex_count_(vertex_count) {
    Json document = parse(stop);
    if (!document.is_object() || !document.contains(key_))
      fail(fmt::format("no list \"{}\"; write {}", key_, example));
    if (!document[key_].is_array()) fail(fmt::format("\"{}\" is not a list", key_));
    base_ = read_base(document);
    list_ = std::move(document[key_]);
  }

  template <class Action>
  void for_each(const Action& action) {
    for (position_ = 0; position_ < list_.size(); ++position_) action(list_[position_]);
  }
  // Returns the number counted from 0.
  Index vertex(const Json& number) const {
    if (!number.is_number_integer()) fail_here("a vertex is not an integer");
    const bool is_huge = number.is_number_unsigned() &&
                         number.get<std::uint64_t>() > std::numeric_limits<Index>::max();
    const long long vertex = is_huge ? -1 : number.get<long long>();
    if (vertex < base_ || vertex - base_ >= vertex_count_)
      fail_here(fmt::format("vertex {} out of range {}..{}", number.dump(), base_,
                            base_ + vertex_count_ - 1));
    return static_cast<Index>(vertex - base_);
  }
  [[noreturn]] void fail_here(std::string_view problem) const {
    fail(fmt::format("{}[{}]: {}; correct the file", key_, position_, problem));
  }
  long long base() const { return base_; }

 private:
  Json parse(const StopCheck& stop) const {
    const std::string content = read_whole_file(path_, stop);
    require_shallow_json(path_, content);
    try {
      return Json::parse(content);
    } catch (const Json::parse_error& error) {
      const std::size_t byte = std::min(error.byte, content.size());
      const auto line = 1 + std::count(content.begin(),
                                       content.begin() + static_cast<std::ptrdiff_t>(byte), '\n');
      throw Error(ErrorKind::Unreadable,
                  fmt::format("{}:{}: broken JSON at byte {}; truncated, or a comma or bracket is "
                              "wrong",
                              path_, line, error.byte));
    } catch (const Json::exception&) {
      fail("a number is out of the range of doubles");
    }
  }

  long long read_base(const Json& document) const {
    const auto entry = document.find("index_base");
    if (entry == document.end()) return 0;
    if (!entry->is_number_integer() || (*entry != 0 && *entry != 1))
      fail("\"index_base\" must be 0 or 1");
    return entry->get<long long>();
  }

  [[noreturn]] void fail(std::string_view problem) const {
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {}", path_, problem));
  }

  const std::string& path_;
  std::string key_;
  Index vertex_count_;
  long long base_ = 0;
  std::size_t position_ = 0;
  Json list_;
};

// Returns the entries, each vertex once; repeated equal entries count once. read(Json, vertex)
// makes an Entry.
template <class Entry, class Read, class Same>
std::vector<Entry> read_once(VertexList& list, std::string_view what, const Read& read,
                             const Same& same) {
  std::vector<Entry> entries;
  std::unordered_map<Index, std::size_t> known;  // vertex -> place in `entries`
  list.for_each([&](const Json& item) {
    if (!item.is_object() || !item.contains("vertex")) list.fail_here("an entry needs \"vertex\"");
    const Index vertex = list.vertex(item["vertex"]);
    const Entry entry = read(item, vertex);
    const auto [place, is_new] = known.try_emplace(vertex, entries.size());
    if (is_new)
      entries.push_back(entry);
    else if (!same(entries[place->second], entry))
      list.fail_here(fmt::format("vertex {} has two different {}", vertex + list.base(), what));
  });
  return entries;
}

std::optional<Vector2> read_target(const VertexList& list, const Json& entry) {
  if (!entry.contains("target")) list.fail_here("a handle needs \"vertex\" and \"target\"");
  if (entry.contains("weight"))  // users would expect it to have an effect
    list.fail_here("\"weight\": all handles have one weight; leave it out");
  const Json& target = entry["target"];
  if (target.is_string() && target == "initial") return std::nullopt;
  if (!target.is_array() || target.size() != 2 || !target[0].is_number() || !target[1].is_number())
    list.fail_here("\"target\" must be two numbers or \"initial\"");
  const Vector2 point(target[0].get<double>(), target[1].get<double>());
  if (!point.allFinite()) list.fail_here("\"target\" is not finite");
  return point;
}

int read_quarter_turns(const VertexList& list, const Json& entry) {
  // A limit that no vertex reaches. Chosen, not tuned.
  constexpr double kMaximum = 1000;
  const bool turns = entry.contains("quarter_turns");
  if (turns == entry.contains("index"))
    list.fail_here("a cone needs either \"quarter_turns\" or \"index\"");
  const Json& number = turns ? entry["quarter_turns"] : entry["index"];
  if (!number.is_number()) list.fail_here("\"quarter_turns\" and \"index\" are numbers");
  const double value = turns ? number.get<double>() : 4 - 4 * number.get<double>();
  if (!(value >= 1) || value != std::floor(value) || value > kMaximum)
    list.fail_here(fmt::format("{} {} gives {} quarter turns; a cone has a positive whole number",
                               turns ? "quarter_turns" : "index", number.dump(), value));
  return static_cast<int>(value);
}

}  // namespace

std::vector<Handle> read_handles(const std::string& path, Index vertex_count,
                                 const StopCheck& stop) {
  VertexList list(path, "handles", "{\"handles\": [{\"vertex\": 0, \"target\": [0, 0]}]}",
                  vertex_count, stop);
  const auto read = [&](const Json& item, Index vertex) {
    return Handle{vertex, read_target(list, item)};
  };
  return read_once<Handle>(list, "targets", read,
                           [](const Handle& a, const Handle& b) { return a.target == b.target; });
}

std::vector<Cone> read_cones(const std::string& path, Index vertex_count, const StopCheck& stop) {
  VertexList list(path, "cones", "{\"cones\": [{\"vertex\": 0, \"quarter_turns\": 3}]}",
                  vertex_count, stop);
  const auto read = [&](const Json& item, Index vertex) {
    return Cone{vertex, read_quarter_turns(list, item)};
  };
  return read_once<Cone>(list, "angles", read, [](const Cone& a, const Cone& b) {
    return a.quarter_turns == b.quarter_turns;
  });
}

std::vector<std::array<Index, 2>> read_seams(const std::string& path, Index vertex_count,
                                             const StopCheck& stop) {
  VertexList list(path, "edges", "{\"edges\": [[0, 1], [1, 2]]}", vertex_count, stop);
  std::vector<std::array<Index, 2>> edges;
  list.for_each([&](const Json& item) {
    if (!item.is_array() || item.size() != 2) list.fail_here("an edge is two vertices");
    edges.push_back({list.vertex(item[0]), list.vertex(item[1])});
    if (edges.back()[0] == edges.back()[1]) list.fail_here("the two vertices are the same");
  });
  return edges;
}

Vec read_face_weights(const std::string& path, Index face_count, const StopCheck& stop) {
  std::string text = read_whole_file(path, stop);
  require_text(path, text);
  TextCursor cursor(path, text, TextLines::Plain);
  Vec weights(face_count);
  Index count = 0;
  while (cursor.next_line())
    while (!cursor.at_end_of_line()) {
      const double weight = cursor.next_number("a face weight");
      if (!(weight > 0)) cursor.fail("a face weight must be positive");
      if (!is_usable_weight(weight))
        cursor.fail(fmt::format("a face weight of {:g} leaves {:g}..{:g}; only their ratios matter",
                                weight, 1 / kLargestFactor, kLargestFactor));
      if (count == face_count)
        cursor.fail(fmt::format("more than {} numbers; give one for each face", face_count));
      weights[count++] = weight;
    }
  if (count != face_count)
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {} numbers for {} faces; give one for each",
                                                   path, count, face_count));
  return weights;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
