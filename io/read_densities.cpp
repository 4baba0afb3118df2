#include "majorant/io/read_densities.h"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "majorant/framework/error.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/json_depth.h"

namespace majorant {
namespace {

using Json = nlohmann::json;

[[noreturn]] void fail(const std::string& path, const std::string& problem) {
  throw Error(ErrorKind::Unreadable, fmt::format("{}: {}", path, problem));
}

double density(const std::string& path, const std::string& name, const Json& value) {
  if (!value.is_number() || !(value.get<double>() > 0) || !std::isfinite(value.get<double>()))
    fail(path, fmt::format("the density of {} is no positive number", name));
  return value.get<double>();
}

Json parse(const std::string& path, const StopCheck& stop) {
  std::string text = read_whole_file(path, stop);
  require_text(path, text);
  require_shallow_json(path, text);
  try {
    return Json::parse(text);
  } catch (const Json::exception&) {
    fail(path, "broken JSON, or a number in it is out of the range of doubles");
  }
}

}  // namespace

MaterialDensities read_densities(const std::string& path, const StopCheck& stop) {
  const Json document = parse(path, stop);
  if (!document.is_object() || (!document.contains("materials") && !document.contains("other")))
    fail(path, "needs {\"materials\": {\"NAME\": PIXELS}, \"other\": PIXELS}, or one of the two");
  MaterialDensities out;
  if (document.contains("materials")) {
    if (!document["materials"].is_object()) fail(path, "\"materials\" is no object");
    for (const auto& [name, value] : document["materials"].items())
      out.materials[name] = density(path, fmt::format("\"{}\"", name), value);
  }
  if (document.contains("other")) out.other = density(path, "\"other\"", document["other"]);
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
