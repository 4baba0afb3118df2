#include "majorant/io/internal/json_strings.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <vector>

namespace majorant {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kDeepest = 3;  // number of keys in a place

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
  std::vector<std::string> keys_;  // of the enclosing objects
};

}  // namespace

void JsonWithoutData::append(std::string_view block) {
  while (!block.empty()) block = is_in_data_ ? behind_data(block) : behind_text(block);
}

std::string_view JsonWithoutData::behind_text(std::string_view block) {
  constexpr std::string_view kData = "\"data:";
  const std::size_t before = text_.size();
  text_ += block;
  std::size_t at = text_.find(kData, before - std::min(before, kData.size() - 1));
  // A quote after a backslash does not begin a text.
  while (at != std::string::npos && at > 0 && text_[at - 1] == '\\')
    at = text_.find(kData, at + kData.size());
  if (at == std::string::npos) return {};
  const std::size_t end = at + kData.size();
  text_.resize(end);
  is_in_data_ = true;
  backslashes_ = 0;
  return block.substr(end - before);
}

std::string_view JsonWithoutData::behind_data(std::string_view block) {
  for (std::size_t at = block.find('"'), from = 0; at != std::string_view::npos;
       from = at + 1, at = block.find('"', from)) {
    count_backslashes(block.substr(from, at - from));
    is_in_data_ = backslashes_ % 2 != 0;  // the quote is escaped
    backslashes_ = 0;
    if (!is_in_data_) return block.substr(at);
  }
  count_backslashes(block.substr(block.rfind('"') + 1));
  return {};
}

// Counts the backslashes at the end of the text so far.
void JsonWithoutData::count_backslashes(std::string_view more) {
  const std::size_t last = more.find_last_not_of('\\');
  backslashes_ =
      last == std::string_view::npos ? backslashes_ + more.size() : more.size() - 1 - last;
}

void visit_strings(std::string_view json, const VisitString& visit) {
  Strings strings(visit);
  Json::sax_parse(json, &strings);
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
