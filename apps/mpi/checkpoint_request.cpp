#include "apps/mpi/checkpoint_request.h"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <span>

#include "apps/arguments/help_text.h"
#include "apps/arguments/number_check.h"
#include "majorant/framework/error.h"

namespace majorant::app {
namespace {

constexpr const char* kSurface = "surface";

std::string name_of(std::span<const double> numbers) {
  return numbers.empty() ? "" : fmt::format("{:016x}", hashed(std::as_bytes(numbers)));
}

std::string name_of(const std::vector<Pin>& points) {
  std::vector<double> numbers;
  for (const Pin& p : points) {
    const Vector2 target = p.target.value_or(Vector2::Zero());
    numbers.insert(numbers.end(),
                   {static_cast<double>(p.vertex), p.target ? 1.0 : 0.0, target.x(), target.y()});
  }
  return name_of(numbers);
}

// File options are stored as hashes of their contents, which messages do not show.
bool is_file(const std::string& key) {
  return key == "pins" || key == "handles" || key == "weights";
}

std::string difference(const std::string& key, const Json& stored, const Json& current) {
  if (key == kSurface) return "it was saved for another surface than the input";
  if (is_file(key)) return fmt::format("it was saved by a run with another --{} file", key);
  const auto text = [](const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
  };
  return fmt::format("it was saved by a run with --{} {}, but this run has {}", key, text(stored),
                     text(current));
}

// Requires that the file has these points with targets.
void require_points(const HeaderReader& stored, const std::vector<Pin>& current) {
  if (stored.size() != current.size())
    refuse_checkpoint(stored.file(), "its header has other points");
  for (std::size_t k = 0; k < current.size(); ++k) {
    stored[k].integer(std::size_t{0}, current[k].vertex, current[k].vertex);
    for (const std::size_t c : {1, 2}) stored[k].finite(c);
  }
}

}  // namespace

void CheckpointRequest::add_to(CLI::App& verb) {
  begin_group(verb, OptionGroup::Files);
  verb.add_option(
          "--checkpoint", file,
          "save the state of the run to this .ckpt file; --resume continues on any number of ranks")
      ->type_name("FILE");
  verb.add_option("--every", every, "iterations between two checkpoints (10)")
      ->type_name("N")
      ->check(whole_number(1))
      ->needs("--checkpoint");
  verb.add_option("--resume", resume, "continue from this checkpoint")->type_name("FILE");
}

Json CheckpointRequest::to_json() const {
  return {{"checkpoint", file}, {"every", every}, {"resume", resume}};
}

Json identity(const MapRequest& request, const MapJob& job) {
  const MapOptions& map = job.options.map;
  return {{kSurface, fingerprint(*job.mesh)},
          {"degree", request.degree},
          {"energy", request.energy},
          {"boundary", request.boundary},
          {"quadrature", request.quadrature},
          {"pins", name_of(map.pins)},
          {"handles", name_of(map.handles)},
          {"soft", request.soft},
          {"weights",
           name_of({map.face_weight.data(), static_cast<std::size_t>(map.face_weight.size())})}};
}

Json points_json(const std::vector<Pin>& points) {
  Json list = Json::array();
  for (const Pin& p : points) list.push_back({p.vertex, p.target->x(), p.target->y()});
  return list;
}

std::vector<Pin> points_from(const Json& json) {
  std::vector<Pin> points;
  for (const Json& p : json) points.push_back({p.at(0), Vector2(p.at(1), p.at(2))});
  return points;
}

CheckpointFile CheckpointRequest::read_fitting(const MapRequest& map, const MapJob& job) const {
  CheckpointFile kept = read_checkpoint_file(resume);
  const HeaderReader header(resume, kept.header), stored = header["identity"];
  const Json all = identity(map, job);
  for (const auto& [key, current] : all.items())
    if (stored.at(key.c_str()) != current)
      throw Error(ErrorKind::Unreadable,
                  fmt::format("{}: {}; use the same options, or start anew without --resume",
                              resume, difference(key, stored.at(key.c_str()), current)));
  // Further requirements on a file of this surface and these options.
  constexpr auto kMany = std::numeric_limits<std::int64_t>::max();
  header.integer("vertices", job.mesh->vertex_count(), job.mesh->vertex_count());
  header.integer("faces", job.mesh->face_count(), job.mesh->face_count());
  header.integer("degree", 1, map.degree);
  header.integer("iterations", 0, kMany);
  header.integer("ranks", 1, kMany);
  header.finite("seconds");
  header.text("start");
  require_points(header["pins"], job.options.map.pins);
  require_points(header["handles"], job.options.map.handles);
  require_state(resume, kept, job.options.solve.quadrature_points);
  return kept;
}

Json CheckpointRequest::section(const CheckpointWriter& writer) const {
  return {{"file", file},
          {"every", every},
          {"written", writer.written()},
          {"failure", writer.failure()},
          {"seconds", writer.seconds()}};
}

Json CheckpointRequest::resumed_section(const CheckpointFile& resumed) const {
  Json section{{"file", resume}};
  for (const char* key : {"degree", "iterations", "seconds", "ranks"})
    section[key] = resumed.header.at(key);
  return section;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
