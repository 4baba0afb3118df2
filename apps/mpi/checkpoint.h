// Checkpoints: the state of a run on several ranks in one file, from which runs on any number of
// ranks continue.
//
//     CheckpointWriter writer("run.ckpt", part, uv, about);
//     parametrize_parts(part, uv, options, record, {10, [&](const auto& s) { writer.write(s); }});
//
//     const CheckpointFile file = read_checkpoint_file("run.ckpt");        // rank 0
//     const Vec uv = of_vertices(part, file.start, 2);
//     parametrize_parts(part, uv, options, record, {}, state_of(part, file));
//
// Rank 0 collects all points and holds them while it writes the file: about 300 bytes a face at
// degree 3. docs/several_processes.md describes the format.
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

// The contents of a file, see docs/several_processes.md, Checkpoints. One process reads and writes
// it.
struct CheckpointFile {
  Json header;  // with "vertices", "faces" and "degree", which determine the length of the rest
  Vec start;    // u, v of every vertex at the start of the run, model units
  Vec vertex_points;  // u, v of every vertex, normalized
  Vec other_points;   // the other control points, face by face, (degree + 1)(degree + 2) / 2 - 3
                      // each
  std::vector<std::uint8_t> levels;  // of quadrature, by face
};

// A validating reader of headers, since a file with a correct checksum may come from anybody.
// Members throw Error(Unreadable) that names the file and the key if a value is missing, of another
// kind, or out of range. Keys are those of objects, or places in lists.
class HeaderReader {
 public:
  // file: for messages. json must outlive this.
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

// Throws Error(Unreadable) with the fault of a checkpoint and a remedy.
[[noreturn]] void refuse_checkpoint(const std::string& path, const std::string& why);

// Writes the file completely and flushes it to the disk, or not at all; an older file stays until
// then. Throws Error(Usage) if it cannot be written.
void write_checkpoint_file(const std::string& path, const CheckpointFile& file);
// Throws Error(Unreadable) for files that are not checkpoints, have another version, are damaged,
// cut short, or not as long as the header says, and for points that are not finite. Allocates no
// more than the size of the file.
CheckpointFile read_checkpoint_file(const std::string& path);

// The FNV-1a hash, 64 bits; `hash` is that of the preceding bytes.
inline constexpr std::uint64_t kNothingHashed = 0xcbf29ce484222325;
std::uint64_t hashed(std::span<const std::byte> bytes, std::uint64_t hash = kNothingHashed);

class CheckpointWriter {
 public:
  // start: 2 numbers for each vertex of this rank at the start of the run; about: the data of the
  // run besides its state, from rank 0. Collective.
  CheckpointWriter(std::string path, std::shared_ptr<const MeshPart> part, const Vec& start,
                   Json about);

  // Collective. If the file cannot be written, the older one stays and the run continues; rank 0
  // then has a failure().
  void write(const RunState& state, double seconds_of_run);

  // Valid on rank 0.
  int written() const { return written_; }
  const std::string& failure() const { return failure_; }  // of the last write; empty: it succeeded
  double seconds() const { return seconds_; }              // spent on writing

 private:
  std::string path_;
  std::shared_ptr<const MeshPart> part_;
  Vec start_;
  Json about_;
  int written_ = 0;
  std::string failure_;
  double seconds_ = 0;
};

// Returns a hash of positions and faces, which ties a file to its surface.
std::string fingerprint(const SurfaceMesh& mesh);

// Throws Error(Unreadable) if the state in the file `path` cannot belong to a run with this
// quadrature (SolveOptions).
void require_state(const std::string& path, const CheckpointFile& file, int quadrature_points);

// file: on rank 0, of this surface, after require_state(). Collective.
RunState state_of(const MeshPart& part, const CheckpointFile& file);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
