#include "majorant/pictures/internal/claims_json.h"

#include "majorant/framework/error.h"
#include "majorant/io/internal/json_depth.h"

namespace majorant {

using nlohmann::json;

json claims_of(const MapFile& map) {
  try {
    require_shallow_json("claims", map.claims);
  } catch (const Error&) {
    return json::object();
  }
  json claims = json::parse(map.claims, nullptr, false);
  return claims.is_object() ? claims : json::object();
}

std::string text_at(const json& object, const char* key) {
  const auto entry = object.find(key);
  return entry != object.end() && entry->is_string() ? entry->get<std::string>() : std::string();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
