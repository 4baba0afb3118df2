#include "majorant/io/claims.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

#include "majorant/framework/error.h"
#include "majorant/io/json_depth.h"

namespace majorant {
namespace {

using Json = nlohmann::json;

// The tolerance of the length of unit vectors. Rounding, also of printed digits, is far below.
constexpr double kUnitLength = 1e-12;

// A value and its place: "bunny.vtu: majorant_claims.pins[3].vertex".
struct Place {
  const Json& value;
  std::string name;

  [[noreturn]] void fail(const std::string& problem) const {
    throw Error(ErrorKind::Unreadable, fmt::format("{} {}; damaged file", name, problem));
  }
};

bool as_bool(const Place& p) {
  if (!p.value.is_boolean()) p.fail("is neither true nor false");
  return p.value.get<bool>();
}

std::string as_string(const Place& p) {
  if (!p.value.is_string()) p.fail("is not a string");
  return p.value.get<std::string>();
}

double as_number(const Place& p) {
  if (!p.value.is_number()) p.fail("is not a number");
  const double number = p.value.get<double>();
  if (!std::isfinite(number)) p.fail("is not finite");
  return number;
}

// Returns a whole number of at least `least`. The range is tested before the conversion, since JSON
// numbers have none.
int as_integer(const Place& p, int least) {
  if (!p.value.is_number_integer()) p.fail("is not a whole number");
  constexpr int kMaximum = std::numeric_limits<int>::max();
  const bool in_range = p.value.is_number_unsigned()
                            ? p.value.get<std::uint64_t>() <= std::uint64_t{kMaximum}
                            : p.value.get<std::int64_t>() >= least;
  const auto number = in_range ? p.value.get<std::int64_t>() : std::int64_t{-1};
  if (!in_range || number < least) p.fail(fmt::format("is not in {}..{}", least, kMaximum));
  return static_cast<int>(number);
}

Place element(const Place& p, std::size_t k) {
  return {p.value[k], fmt::format("{}[{}]", p.name, k)};
}

// Returns a required entry of an object.
Place member(const Place& p, const char* key) {
  if (!p.value.is_object()) p.fail("is not an object");
  const auto entry = p.value.find(key);
  if (entry == p.value.end()) p.fail(fmt::format("has no \"{}\"", key));
  return {*entry, fmt::format("{}.{}", p.name, key)};
}

Vector2 as_point(const Place& p) {
  if (!p.value.is_array() || p.value.size() != 2) p.fail("is not a list of two numbers");
  return {as_number(element(p, 0)), as_number(element(p, 1))};
}

template <class Read>
auto as_list(const Place& p, const Read& read) {
  if (!p.value.is_array()) p.fail("is not a list");
  std::vector<decltype(read(p))> list;
  for (std::size_t k = 0; k < p.value.size(); ++k) list.push_back(read(element(p, k)));
  return list;
}

ClaimedPin as_pin(const Place& p) {
  return {as_integer(member(p, "vertex"), 0), as_point(member(p, "target"))};
}

Cone as_cone(const Place& p) {
  return {as_integer(member(p, "vertex"), 0), as_integer(member(p, "quarter_turns"), 1)};
}

std::array<Index, 2> as_edge(const Place& p) {
  if (!p.value.is_array() || p.value.size() != 2) p.fail("is not a list of two vertices");
  return {as_integer(element(p, 0), 0), as_integer(element(p, 1), 0)};
}

Index as_number_from_zero(const Place& p) { return as_integer(p, 0); }

ClaimedStack as_stack(const Place& p) {
  return {as_list(member(p, "charts"), as_number_from_zero),
          as_list(member(p, "mirrored"), as_number_from_zero)};
}

ClaimedObject as_object(const Place& p) {
  return {as_string(member(p, "name")), as_number_from_zero(member(p, "charts"))};
}

double as_positive(const Place& p) {
  const double number = as_number(p);
  if (!(number > 0)) p.fail("is not positive");
  return number;
}

ClaimedNormalization as_normalization(const Place& p) {
  const Place size = member(p, "size");
  const ClaimedNormalization n{as_point(member(p, "origin")), as_number(size)};
  if (!(n.size > 0)) size.fail("is not positive");
  return n;
}

Vector2 as_alignment(const Place& p) {
  const Place direction = member(p, "direction");
  const Vector2 unit = as_point(direction);
  if (!(std::abs(unit.norm() - 1) <= kUnitLength)) direction.fail("is not of length 1");
  return unit;
}

BoundaryCondition as_boundary(const Place& p) {
  const std::string boundary = as_string(p);
  if (boundary != "free" && boundary != "fixed") p.fail("is neither \"free\" nor \"fixed\"");
  return boundary == "free" ? BoundaryCondition::Free : BoundaryCondition::Fixed;
}

ClaimedStart as_start(const Place& p) {
  const std::string start = as_string(p);
  if (start == "tutte") return ClaimedStart::Tutte;
  if (start == "multiresolution") return ClaimedStart::Multiresolution;
  if (start == "input") return ClaimedStart::Input;
  return start == "planar" ? ClaimedStart::Planar : ClaimedStart::Other;
}

// The optional entries of an object.
class Entries {
 public:
  explicit Entries(Place object) : object_(std::move(object)) {
    if (!object_.value.is_object()) object_.fail("is not a JSON object");
  }

  template <class T, class Read>
  void read(const char* key, const Read& read_entry, std::optional<T>& out) const {
    const auto entry = object_.value.find(key);
    if (entry != object_.value.end() && !entry->is_null())
      out = read_entry(Place{*entry, fmt::format("{}.{}", object_.name, key)});
  }

 private:
  Place object_;
};

ClaimedOptions as_options(const Place& p) {
  ClaimedOptions options;
  Entries(p).read("seamless", as_bool, options.seamless);
  Entries(p).read("handles", as_string, options.handles);
  return options;
}

Json parse(const std::string& text, const std::string& name) {
  require_shallow_json(name, text);
  try {
    return Json::parse(text);
  } catch (const Json::exception&) {
    throw Error(ErrorKind::Unreadable,
                fmt::format("{} is broken JSON, or a number in it is out of the range of "
                            "doubles; damaged file",
                            name));
  }
}

}  // namespace

Claims parse_claims(const std::string& text, const std::string& file) {
  Claims claims;
  if (text.empty()) return claims;
  const std::string name = file.empty() ? "majorant_claims" : file + ": majorant_claims";
  const Json document = parse(text, name);
  const Entries entries({document, name});
  entries.read("version", as_string, claims.version);
  entries.read("energy", as_string, claims.energy);
  entries.read(
      "degree", [](const Place& p) { return as_integer(p, 1); }, claims.degree);
  entries.read("value", as_number, claims.value);
  entries.read("boundary", as_boundary, claims.boundary);
  entries.read("init", as_start, claims.init);
  entries.read("seams", as_bool, claims.seams);
  entries.read("bijective", as_bool, claims.bijective);
  entries.read("other_triangles", as_bool, claims.other_triangles);
  entries.read("complete", as_bool, claims.complete);
  entries.read("aligned", as_alignment, claims.aligned);
  entries.read("normalized", as_normalization, claims.normalized);
  entries.read("layout_scale", as_positive, claims.layout_scale);
  entries.read(
      "pins", [](const Place& p) { return as_list(p, as_pin); }, claims.pins);
  entries.read(
      "cones", [](const Place& p) { return as_list(p, as_cone); }, claims.cones);
  entries.read(
      "cuts", [](const Place& p) { return as_list(p, as_edge); }, claims.cuts);
  entries.read(
      "stacks", [](const Place& p) { return as_list(p, as_stack); }, claims.stacks);
  entries.read(
      "objects", [](const Place& p) { return as_list(p, as_object); }, claims.objects);
  entries.read("options", as_options, claims.options);
  return claims;
}

Claims readable_claims(const std::string& text) {
  try {
    return parse_claims(text, "");
  } catch (const Error&) {
    return {};
  }
}

double claimed_scale(const Claims& claims) {
  if (claims.normalized) return claims.normalized->size;
  return claims.layout_scale ? 1 / *claims.layout_scale : 1;
}

Held held_by(const Claims& claims) {
  const bool is_pulled = claims.options && !claims.options->handles.value_or("").empty();
  if (is_pulled || (claims.pins && !claims.pins->empty())) return Held::Points;
  return claims.boundary == BoundaryCondition::Fixed ? Held::Boundary : Held::Nothing;
}

bool starts_at_tutte_boundary(const Claims& claims) {
  const ClaimedStart start = claims.init.value_or(ClaimedStart::Tutte);
  return start == ClaimedStart::Tutte || start == ClaimedStart::Multiresolution;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
