#include "distributed/checkpoint_request.h"

#include <fmt/format.h>

#include <limits>
#include <span>

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

// The values of files are names of their contents: not for users.
bool is_file(const std::string& key) {
  return key == "pins" || key == "handles" || key == "weights";
}

std::string difference(const std::string& key, const Json& told, const Json& asked) {
  if (key == kSurface) return "it is of another surface than the input";
  if (is_file(key)) return fmt::format("it is of a run with other --{}", key);
  const auto text = [](const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.dump();
  };
  return fmt::format("it is of a run with --{} {}, this one has {}", key, text(told), text(asked));
}

// The points asked for, with targets.
void require_points(const HeaderReader& told, const std::vector<Pin>& asked) {
  if (told.size() != asked.size()) refuse_checkpoint(told.file(), "its header has other points");
  for (std::size_t k = 0; k < asked.size(); ++k) {
    told[k].integer(std::size_t{0}, asked[k].vertex, asked[k].vertex);
    for (const std::size_t c : {1, 2}) told[k].finite(c);
  }
}

}  // namespace

void CheckpointRequest::add_to(CLI::App& verb) {
  verb.add_option("--checkpoint", file,
                  "keeps where the run is in this file, .ckpt, for --resume on any number of ranks")
      ->type_name("FILE");
  verb.add_option("--every", every, "iterations from one checkpoint to the next (10)")
      ->type_name("N")
      ->check(whole_number(1))
      ->needs("--checkpoint");
  verb.add_option("--resume", resume, "go on where this checkpoint was made")->type_name("FILE");
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

CheckpointFile read_fitting(const std::string& path, const MapRequest& request, const MapJob& job) {
  CheckpointFile file = read_checkpoint_file(path);
  const HeaderReader header(path, file.header), told = header["identity"];
  const Json all = identity(request, job);
  for (const auto& [key, asked] : all.items())
    if (told.at(key.c_str()) != asked)
      throw Error(ErrorKind::Unreadable,
                  fmt::format("{}: {}; ask for the same, or start anew without --resume", path,
                              difference(key, told.at(key.c_str()), asked)));
  // What a file of this surface and these asked must say, too.
  constexpr auto kMany = std::numeric_limits<std::int64_t>::max();
  header.integer("vertices", job.mesh->vertex_count(), job.mesh->vertex_count());
  header.integer("faces", job.mesh->face_count(), job.mesh->face_count());
  header.integer("degree", 1, request.degree);
  header.integer("iterations", 0, kMany);
  header.integer("ranks", 1, kMany);
  header.finite("seconds");
  header.text("start");
  require_points(header["pins"], job.options.map.pins);
  require_points(header["handles"], job.options.map.handles);
  require_state(path, file, job.options.solve.quadrature_points);
  return file;
}

Json checkpoint_section(const CheckpointRequest& request, const CheckpointWriter& writer) {
  return {{"file", request.file},
          {"every", request.every},
          {"written", writer.written()},
          {"failure", writer.failure()},
          {"seconds", writer.seconds()}};
}

Json resumed_section(const CheckpointRequest& request, const CheckpointFile& file) {
  Json section{{"file", request.resume}};
  for (const char* key : {"degree", "iterations", "seconds", "ranks"})
    section[key] = file.header.at(key);
  return section;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
