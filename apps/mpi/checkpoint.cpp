#include "apps/mpi/checkpoint.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <bit>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string_view>
#include <utility>

#include "apps/mpi/internal/collect.h"
#include "apps/mpi/internal/part_data.h"
#include "majorant/constraints/local_injectivity.h"
#include "majorant/elements/bernstein_space.h"
#include "majorant/framework/error.h"
#include "majorant/framework/stopwatch.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/byte_cursor.h"
#include "majorant/io/files/input_file.h"
#include "majorant/io/json_depth.h"
#include "majorant/maps/quadrature_hierarchy.h"

namespace majorant {
namespace {

static_assert(std::endian::native == std::endian::little, "numbers are written as memory has them");

constexpr std::string_view kMagic = "majorckp";
// The version of the format. Raise it whenever the bytes or the required keys of the header change.
constexpr std::uint64_t kVersion = 1;

template <class T>
void append(std::string& bytes, const T* values, std::size_t count) {
  bytes.append(reinterpret_cast<const char*>(values), count * sizeof(T));
}

void append(std::string& bytes, const Vec& values) {
  append(bytes, values.data(), static_cast<std::size_t>(values.size()));
}

std::uint64_t hashed(std::string_view bytes) {
  return majorant::hashed(std::as_bytes(std::span(bytes.data(), bytes.size())));
}

// Data that are only in the cache of the system would be lost in a crash.
void flush(const std::string& path, int flags) {
  const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC);
  const bool done = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int code = errno;
  if (descriptor >= 0) ::close(descriptor);
  // Some file systems have no fsync of folders.
  if (!done && !(code == EINVAL && (flags & O_DIRECTORY)))
    throw Error(ErrorKind::Usage, fmt::format("cannot write {}: {}", path, std::strerror(code)));
}

Vec numbers(ByteCursor& in, std::size_t count) {
  Vec values(static_cast<Index>(count));
  for (double& v : values) v = in.next<double>();
  return values;
}

// The sizes of the data after the header.
struct Sizes {
  std::size_t vertices, faces, others;
  // bytes: the size of the file, which bounds the sizes.
  Sizes(const HeaderReader& header, std::size_t bytes) {
    const auto most = static_cast<std::int64_t>(bytes);
    vertices = static_cast<std::size_t>(header.integer("vertices", 0, most));
    faces = static_cast<std::size_t>(header.integer("faces", 0, most));
    const auto degree =
        static_cast<std::size_t>(header.integer("degree", 1, BezierTriangleSpace::kMaxDegree));
    others = faces * ((degree + 1) * (degree + 2) / 2 - 3);
  }
  std::size_t bytes() const { return 2 * sizeof(double) * (2 * vertices + others) + faces; }
};

Json parsed(const std::string& path, std::string_view header) {
  try {
    require_shallow_json("its header", header);
    return Json::parse(header);
  } catch (const Error& e) {
    refuse_checkpoint(path, e.what());
  } catch (const Json::exception&) {
    refuse_checkpoint(path, "its header cannot be read");
  }
}

std::string name(const char* key) { return fmt::format("'{}'", key); }

std::string name(std::size_t place) { return fmt::format("entry {} of a list", place); }

template <class Key>
[[noreturn]] void refuse_value(const std::string& file, Key key, const Json& value) {
  std::string text = value.dump(-1, ' ', false, Json::error_handler_t::replace);
  if (text.size() > 40) text = text.substr(0, 37) + "...";
  refuse_checkpoint(file, fmt::format("its header says {} is {}", name(key), text));
}

}  // namespace

void refuse_checkpoint(const std::string& path, const std::string& why) {
  throw Error(ErrorKind::Unreadable,
              fmt::format("{}: {}; resume from another checkpoint, or start anew without --resume",
                          path, why));
}

const Json& HeaderReader::at(const char* key) const {
  if (!json_.is_object() || !json_.contains(key))
    refuse_checkpoint(file_, fmt::format("its header has no {}", name(key)));
  return json_.at(key);
}

const Json& HeaderReader::at(std::size_t place) const {
  if (place >= size()) refuse_checkpoint(file_, "its header has a list that is too short");
  return json_.at(place);
}

std::size_t HeaderReader::size() const {
  if (!json_.is_array()) refuse_checkpoint(file_, "its header lacks a list");
  return json_.size();
}

template <class Key>
std::int64_t HeaderReader::integer(Key key, std::int64_t least, std::int64_t most) const {
  const Json& value = at(key);
  // JSON also has unsigned integers beyond the signed ones.
  const bool fits = value.is_number_integer() &&
                    !(value.is_number_unsigned() && value.get<std::uint64_t>() >> 63 != 0);
  if (!fits || value.get<std::int64_t>() < least || value.get<std::int64_t>() > most)
    refuse_value(file_, key, value);
  return value;
}

template <class Key>
double HeaderReader::finite(Key key) const {
  const Json& value = at(key);
  if (!value.is_number() || !std::isfinite(value.get<double>())) refuse_value(file_, key, value);
  return value;
}

template std::int64_t HeaderReader::integer(const char*, std::int64_t, std::int64_t) const;
template std::int64_t HeaderReader::integer(std::size_t, std::int64_t, std::int64_t) const;
template double HeaderReader::finite(const char*) const;
template double HeaderReader::finite(std::size_t) const;

bool HeaderReader::flag(const char* key) const {
  if (!at(key).is_boolean()) refuse_value(file_, key, at(key));
  return at(key);
}

std::string HeaderReader::text(const char* key) const {
  if (!at(key).is_string()) refuse_value(file_, key, at(key));
  return at(key);
}

std::uint64_t hashed(std::span<const std::byte> bytes, std::uint64_t hash) {
  constexpr std::uint64_t kPrime = 0x100000001b3;
  for (const std::byte b : bytes) hash = (hash ^ static_cast<std::uint64_t>(b)) * kPrime;
  return hash;
}

void write_checkpoint_file(const std::string& path, const CheckpointFile& file) {
  const std::string header = file.header.dump();
  const std::uint64_t lengths[] = {kVersion, header.size()};
  std::string bytes(kMagic);
  bytes.reserve(bytes.size() + sizeof lengths + header.size() +
                sizeof(double) *
                    static_cast<std::size_t>(file.start.size() + file.vertex_points.size() +
                                             file.other_points.size()) +
                file.levels.size() + sizeof(std::uint64_t));
  append(bytes, lengths, std::size(lengths));
  bytes += header;
  append(bytes, file.start);
  append(bytes, file.vertex_points);
  append(bytes, file.other_points);
  append(bytes, file.levels.data(), file.levels.size());
  const std::uint64_t check = hashed(bytes);
  append(bytes, &check, 1);
  write_file_atomically(path, bytes,
                        [](const std::string& temporary) { flush(temporary, O_RDONLY); });
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  flush(folder.empty() ? "." : folder.string(), O_RDONLY | O_DIRECTORY);
}

CheckpointFile read_checkpoint_file(const std::string& path) {
  const std::string bytes = read_whole_file(path);
  ByteCursor in(path, bytes, ByteOrder::Little);
  if (!bytes.starts_with(kMagic)) refuse_checkpoint(path, "it is no checkpoint of majorant-mpi");
  in.skip(kMagic.size());
  if (in.remaining() < 3 * sizeof(std::uint64_t)) refuse_checkpoint(path, "it is cut short");
  if (const auto version = in.next<std::uint64_t>(); version != kVersion)
    refuse_checkpoint(
        path, fmt::format("its format has version {}, this majorant-mpi reads version {}", version,
                          kVersion));
  const std::string_view content(bytes.data(), bytes.size() - sizeof(std::uint64_t));
  if (hashed(content) !=
      load_bytes<std::uint64_t>(content.data() + content.size(), ByteOrder::Little))
    refuse_checkpoint(path, "it is damaged or cut short, its checksum does not fit");
  const auto length = in.next<std::uint64_t>();
  const std::string_view header = content.substr(bytes.size() - in.remaining(), length);
  in.skip(length);
  CheckpointFile file;
  file.header = parsed(path, header);
  const Sizes sizes({path, file.header}, bytes.size());
  if (in.remaining() != sizes.bytes() + sizeof(std::uint64_t))
    refuse_checkpoint(path, "its header does not say how long it is");
  file.start = numbers(in, 2 * sizes.vertices);
  file.vertex_points = numbers(in, 2 * sizes.vertices);
  file.other_points = numbers(in, 2 * sizes.others);
  file.levels.resize(sizes.faces);
  for (std::uint8_t& level : file.levels) level = in.next<std::uint8_t>();
  for (const Vec* points : {&file.start, &file.vertex_points, &file.other_points})
    if (!points->allFinite()) refuse_checkpoint(path, "it has points that are not finite");
  return file;
}

namespace {

// The first nodes of a face are the corners of its triangle.
constexpr Index kCorners = 3;

Json to_json(const RunState& state) {
  Json remedies = Json::array();
  for (const RemedyUse& use : state.solver.remedies)
    remedies.push_back({{"runs", use.runs}, {"gained", use.gained}});
  Json initial;  // null if not finite
  if (std::isfinite(state.initial_value)) initial = state.initial_value;
  return {{"entering", state.entering},
          {"initial_value", initial},
          {"softened", state.solver.soft_started},
          {"stalls", state.solver.stalls},
          {"refinements", state.solver.refinements},
          {"barrier_followed", state.solver.barrier_followed},
          {"depth", state.solver.depth},
          {"remedies", remedies}};
}

// Reads everything except points and levels.
RunState from_json(const HeaderReader& header) {
  constexpr int kMany = std::numeric_limits<int>::max();
  const auto count = [&](const HeaderReader& in, const char* key, int most) {
    return static_cast<int>(in.integer(key, 0, most));
  };
  RunState state;
  state.entering = header.flag("entering");
  state.initial_value = header.at("initial_value").is_null()
                            ? std::numeric_limits<double>::infinity()
                            : header.finite("initial_value");
  state.solver.soft_started = header.flag("softened");
  state.solver.stalls = count(header, "stalls", kMany);
  state.solver.refinements = count(header, "refinements", kMany);
  state.solver.barrier_followed = header.flag("barrier_followed");
  state.solver.depth = count(header, "depth", LocalInjectivity::kMaxDepth);
  const HeaderReader remedies = header["remedies"];
  for (std::size_t k = 0; k < state.solver.remedies.size(); ++k)
    state.solver.remedies[k] = {count(remedies[k], "runs", kMany), remedies[k].finite("gained")};
  return state;
}

// Returns the number of coordinates of a face's control points, without its corners.
Index others_of(int degree) { return 2 * ((degree + 1) * (degree + 2) / 2 - kCorners); }

// Calls visit(place in the coordinates of the faces, node) for these control points.
template <class Visit>
void for_each_other(const BezierTriangleSpace& space, const Visit& visit) {
  Index place = 0;
  for (Index f = 0; f < space.element_count(); ++f)
    for (Index k = kCorners; k < space.cells().cols(); ++k, place += 2)
      visit(place, space.cells()(f, k));
}

}  // namespace

CheckpointWriter::CheckpointWriter(std::string path, std::shared_ptr<const MeshPart> part,
                                   const Vec& start, Json about)
    : path_(std::move(path)),
      part_(std::move(part)),
      start_(whole_of_vertices(*part_, start, 2)),
      about_(std::move(about)) {}

void CheckpointWriter::write(const RunState& state, double seconds_of_run) {
  const AddedSeconds time(seconds_);
  const MeshPart& part = *part_;
  const Index width = others_of(state.space->degree());
  Vec others(width * part.mesh->face_count()), levels = Vec::Zero(part.mesh->face_count());
  for_each_other(*state.space, [&](Index place, Index node) {
    others.segment<2>(place) = state.x.segment<2>(2 * node);
  });
  for (std::size_t f = 0; f < state.solver.levels.size(); ++f)
    levels[static_cast<Index>(f)] = state.solver.levels[f];
  CheckpointFile file;
  file.vertex_points = whole_of_vertices(part, state.x.head(2 * part.mesh->vertex_count()), 2);
  file.other_points = whole_of_faces(part, others, width);
  levels = whole_of_faces(part, levels, 1);
  if (part.ranks().rank() > 0) return;
  file.levels.assign(levels.begin(), levels.end());
  file.header = about_;
  file.header["vertices"] = part.whole.vertices;
  file.header["faces"] = part.whole.faces;
  file.header["degree"] = state.space->degree();
  file.header["ranks"] = part.ranks().count();
  file.header["iterations"] = about_.value("iterations", std::int64_t{0}) + state.iterations;
  file.header["seconds"] = about_.value("seconds", 0.0) + seconds_of_run;
  file.header["state"] = to_json(state);
  file.start = start_;
  try {
    write_checkpoint_file(path_, file);
    ++written_;
    failure_.clear();
  } catch (const Error& e) {
    failure_ = e.what();
  }
}

std::string fingerprint(const SurfaceMesh& mesh) {
  const Points3& positions = mesh.positions();
  const Cells& faces = mesh.faces();
  std::uint64_t hash = hashed(
      std::as_bytes(std::span(positions.data(), static_cast<std::size_t>(positions.size()))));
  hash =
      hashed(std::as_bytes(std::span(faces.data(), static_cast<std::size_t>(faces.size()))), hash);
  return fmt::format("{:016x}", hash);
}

void require_state(const std::string& path, const CheckpointFile& file, int quadrature_points) {
  const HeaderReader header(path, file.header);
  from_json(header["state"]);
  const int degree = file.header.at("degree");
  const int top = optimizer_quadrature(degree, quadrature_points).top();
  for (const std::uint8_t level : file.levels)
    if (level > top)
      refuse_checkpoint(
          path, fmt::format("it has faces at level {} of {} of the quadrature", level, top));
}

RunState state_of(const MeshPart& part, const CheckpointFile& file) {
  const Ranks& ranks = part.ranks();
  const Json header =
      Json::parse(broadcast(ranks, ranks.rank() == 0 ? file.header.dump() : std::string()));
  RunState state = from_json(HeaderReader("checkpoint", header)["state"]);
  const int degree = header.at("degree");
  state.space = std::make_shared<const BezierTriangleSpace>(part.mesh->faces(),
                                                            part.mesh->vertex_count(), degree);
  state.x.resize(2 * state.space->node_count());
  state.x.head(2 * part.mesh->vertex_count()) = of_vertices(part, file.vertex_points, 2);
  const Vec others = of_faces(part, file.other_points, others_of(degree));
  for_each_other(*state.space, [&](Index place, Index node) {
    state.x.segment<2>(2 * node) = others.segment<2>(place);
  });
  const Vec levels = of_faces(part,
                              Eigen::Map<const Eigen::Matrix<std::uint8_t, Eigen::Dynamic, 1>>(
                                  file.levels.data(), static_cast<Index>(file.levels.size()))
                                  .cast<double>(),
                              1);
  for (const double level : levels) state.solver.levels.push_back(static_cast<RuleId>(level));
  return state;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
