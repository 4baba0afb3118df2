// The file of a checkpoint: what docs/distributed.md, Checkpoints, says of its bytes. One process
// writes and reads it; whose points these are is not known here.
//
//     CheckpointFile file{header, start, vertex_points, other_points, levels};
//     write_checkpoint_file("run.ckpt", file);
//     CheckpointFile back = read_checkpoint_file("run.ckpt");
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "majorant/framework/types.h"
#include "majorant/results/internal/report.h"

namespace majorant {

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

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
