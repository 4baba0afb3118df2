#include "majorant/io/read_handles.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <unordered_map>

#include "majorant/framework/error.h"
#include "majorant/io/input_file.h"

namespace majorant {
namespace {

using nlohmann::json;

class HandleReader {
 public:
  HandleReader(const std::string& path, Index vertex_count)
      : path_(path), vertex_count_(vertex_count) {}

  std::vector<Handle> read() {
    const json document = parse();
    if (!document.is_object() || !document.contains("handles")) {
      fail("no list \"handles\"; write {\"handles\": [{\"vertex\": 0, \"target\": [0, 0]}]}");
    }
    const json& list = document["handles"];
    if (!list.is_array()) fail("\"handles\" is not a list");
    base_ = read_base(document);
    for (position_ = 0; position_ < list.size(); ++position_) add(read_handle(list[position_]));
    return std::move(handles_);
  }

 private:
  json parse() const {
    const std::string content = read_whole_file(path_);
    try {
      return json::parse(content);
    } catch (const json::parse_error& error) {
      const std::size_t byte = std::min(error.byte, content.size());
      const auto line = 1 + std::count(content.begin(),
                                       content.begin() + static_cast<std::ptrdiff_t>(byte), '\n');
      throw Error(ErrorKind::Unreadable,
                  fmt::format("{}:{}: broken JSON at byte {}; truncated, or a comma or bracket is "
                              "wrong",
                              path_, line, error.byte));
    } catch (const json::exception&) {
      fail("a number is out of the range of doubles");
    }
  }

  long long read_base(const json& document) const {
    const auto entry = document.find("index_base");
    if (entry == document.end()) return 0;
    if (!entry->is_number_integer() || (*entry != 0 && *entry != 1)) {
      fail("\"index_base\" must be 0 or 1");
    }
    return entry->get<long long>();
  }

  Handle read_handle(const json& entry) const {
    if (!entry.is_object() || !entry.contains("vertex") || !entry.contains("target")) {
      fail_here("a handle needs \"vertex\" and \"target\"");
    }
    const json& vertex = entry["vertex"];
    if (!vertex.is_number_integer()) fail_here("\"vertex\" is not an integer");
    const bool is_huge = vertex.is_number_unsigned() &&
                         vertex.get<std::uint64_t>() > std::numeric_limits<Index>::max();
    const long long number = is_huge ? -1 : vertex.get<long long>();
    if (number < base_ || number - base_ >= vertex_count_) {
      fail_here(fmt::format("vertex {} out of range {}..{}", vertex.dump(), base_,
                            base_ + vertex_count_ - 1));
    }
    return {static_cast<Index>(number - base_), read_target(entry["target"])};
  }

  std::optional<Vector2> read_target(const json& target) const {
    if (target.is_string() && target == "initial") return std::nullopt;
    if (!target.is_array() || target.size() != 2 || !target[0].is_number() ||
        !target[1].is_number()) {
      fail_here("\"target\" must be two numbers or \"initial\"");
    }
    const Vector2 point(target[0].get<double>(), target[1].get<double>());
    if (!point.allFinite()) fail_here("\"target\" is not finite");
    return point;
  }

  void add(const Handle& handle) {
    const auto [known, is_new] = known_.try_emplace(handle.vertex, handles_.size());
    if (is_new) {
      handles_.push_back(handle);
    } else if (handles_[known->second].target != handle.target) {
      fail_here(fmt::format("vertex {} has two different targets", handle.vertex + base_));
    }
  }

  [[noreturn]] void fail(std::string_view problem) const {
    throw Error(ErrorKind::Unreadable, fmt::format("{}: {}", path_, problem));
  }
  [[noreturn]] void fail_here(std::string_view problem) const {
    fail(fmt::format("handles[{}]: {}; correct the file", position_, problem));
  }

  const std::string& path_;
  Index vertex_count_;
  long long base_ = 0;
  std::size_t position_ = 0;
  std::vector<Handle> handles_;
  std::unordered_map<Index, std::size_t> known_;  // vertex -> position in handles_
};

}  // namespace

std::vector<Handle> read_handles(const std::string& path, Index vertex_count) {
  return HandleReader(path, vertex_count).read();
}

}  // namespace majorant
