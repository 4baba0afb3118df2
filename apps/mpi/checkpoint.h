// Checkpoints: where a run of several ranks is, in one file, from which runs on any number of ranks
// go on.
//
//     CheckpointWriter writer("run.ckpt", part, uv, about);
//     parametrize_parts(part, uv, options, record, {10, [&](const auto& s) { writer.write(s); }});
//
//     const CheckpointFile file = read_checkpoint_file("run.ckpt");        // rank 0
//     const Vec uv = of_vertices(part, file.start, 2);
//     parametrize_parts(part, uv, options, record, {}, state_of(part, file));
//
// Rank 0 collects all points, and holds them while the file is written: some 300 bytes a face at
// degree 3. docs/several_processes.md has the format.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "apps/mpi/parametrize_parts.h"
#include "majorant/apps/jobs/report.h"
#include "majorant/framework/types.h"

namespace majorant {

// The file: what docs/several_processes.md, Checkpoints, says of its bytes. One process writes and
// reads it.
struct CheckpointFile {
  Json header;        // with "vertices", "faces" and "degree", which say how long the rest is
  Vec start;          // u, v of every vertex where the run began, model units
  Vec vertex_points;  // u, v of every vertex, normalised
  Vec other_points;   // face by face its other control points, (degree + 1)(degree + 2) / 2 - 3
  std::vector<std::uint8_t> levels;  // of quadrature, by face
};

// What headers say, checked where it is read: a file whose checksum fits may be anybody's. Members
// throw Error(Unreadable) that names the file and the key, for what is not there, of another kind
// or out of range. Keys: of objects, places in lists.
class HeaderReader {
 public:
  // file: for messages. json outlives this.
  HeaderReader(std::string file, const Json& json) : file_(std::move(file)), json_(json) {}

  HeaderReader operator[](const char* key) const { return {file_, at(key)}; }
  HeaderReader operator[](std::size_t place) const { return {file_, at(place)}; }
  const std::string& file() const { return file_; }
  std::size_t size() const;  // of a list
  template <class Key>
  std::int64_t integer(Key key, std::int64_t least, std::int64_t most) const;
  template <class Key>
  double finite(Key key) const;
  bool flag(const char* key) const;
  std::string text(const char* key) const;
  const Json& at(const char* key) const;
  const Json& at(std::size_t place) const;

 private:
  std::string file_;
  const Json& json_;
};

// Throws Error(Unreadable): what is wrong with a checkpoint, and what to do.
[[noreturn]] void refuse_checkpoint(const std::string& path, const std::string& why);

// Whole, and on the disk, or not at all: an older file stays until then. Throws Error(Usage) where
// it cannot be written.
void write_checkpoint_file(const std::string& path, const CheckpointFile& file);
// Throws Error(Unreadable) for what is no such file, of another version of the format, damaged or
// cut short, not as long as its header says, and for points that are not finite. Allocates no more
// than the file has.
CheckpointFile read_checkpoint_file(const std::string& path);

// FNV-1a, 64 bits; `hash`: of what comes before.
inline constexpr std::uint64_t kNothingHashed = 0xcbf29ce484222325;
std::uint64_t hashed(std::span<const std::byte> bytes, std::uint64_t hash = kNothingHashed);

class CheckpointWriter {
 public:
  // start: 2 numbers per vertex here, where the run began; about: rank 0's, what the file says of
  // the run beside its state. Collective.
  CheckpointWriter(std::string path, std::shared_ptr<const MeshPart> part, const Vec& start,
                   Json about);

  // Collective. Where the file cannot be written the older one stays and the run goes on: rank 0
  // has failure().
  void write(const RunState& state, double seconds_of_run);

  // Rank 0's.
  int written() const { return written_; }
  const std::string& failure() const { return failure_; }  // of the last try; empty: it went well
  double seconds() const { return seconds_; }              // spent on it

 private:
  std::string path_;
  std::shared_ptr<const MeshPart> part_;
  Vec start_;
  Json about_;
  int written_ = 0;
  std::string failure_;
  double seconds_ = 0;
};

// What the surface is, for a file that is to fit no other: of positions and faces.
std::string fingerprint(const SurfaceMesh& mesh);

// Throws Error(Unreadable) where the state in a file, path, is none of a run with this quadrature
// (SolveOptions).
void require_state(const std::string& path, const CheckpointFile& file, int quadrature_points);

// file: rank 0's, of this surface, which has passed require_state(). Collective.
RunState state_of(const MeshPart& part, const CheckpointFile& file);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
