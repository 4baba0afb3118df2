#include "majorant/io/internal/json_strings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>
#include <span>
#include <vector>

namespace majorant {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kDeepest = 3;  // keys of a place

class Strings final : public nlohmann::json_sax<Json> {
 public:
  explicit Strings(const VisitString& visit) : visit_(visit) {}

  bool string(std::string& value) override { return visit_(place(), value); }
  bool start_object(std::size_t) override {
    keys_.emplace_back();
    return true;
  }
  bool key(std::string& name) override {
    if (keys_.size() <= kDeepest) keys_.back() = name;
    return true;
  }
  bool end_object() override {
    keys_.pop_back();
    return true;
  }
  bool start_array(std::size_t) override { return true; }
  bool end_array() override { return true; }
  bool null() override { return true; }
  bool boolean(bool) override { return true; }
  bool number_integer(Json::number_integer_t) override { return true; }
  bool number_unsigned(Json::number_unsigned_t) override { return true; }
  bool number_float(Json::number_float_t, const std::string&) override { return true; }
  bool binary(Json::binary_t&) override { return true; }
  bool parse_error(std::size_t, const std::string&, const Json::exception&) override {
    return false;
  }

 private:
  std::string place() const {
    const std::size_t depth = std::min(keys_.size(), kDeepest);
    return fmt::format("{}{}", fmt::join(std::span(keys_).first(depth), "/"),
                       keys_.size() > kDeepest ? "/..." : "");
  }

  const VisitString& visit_;
  std::vector<std::string> keys_;  // of the objects around
};

// Without what follows "data:" at the beginning of a text.
std::string without_data(std::string_view json) {
  constexpr std::string_view kData = "\"data:";
  std::string lean;
  for (std::size_t at = 0; at < json.size();) {
    const std::size_t found = json.find(kData, at);
    const std::size_t begin = found == std::string_view::npos ? json.size() : found + kData.size();
    lean += json.substr(at, begin - at);
    at = begin;
    // A quote behind a backslash ends no text, and begins none.
    if (begin == json.size() || (found > 0 && json[found - 1] == '\\')) continue;
    const std::size_t end = std::min(json.find('"', begin), json.size());
    if (json[end - 1] != '\\') at = end;
  }
  return lean;
}

}  // namespace

void visit_strings(std::string_view json, const VisitString& visit) {
  Strings strings(visit);
  Json::sax_parse(without_data(json), &strings);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
