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
// degree 3. docs/distributed.md has the format.
#pragma once

#include <string>

#include "distributed/internal/checkpoint_file.h"
#include "distributed/parametrize_parts.h"

namespace majorant {

class CheckpointWriter {
 public:
  // start: 2 numbers per vertex here, where the run began; about: rank 0's, what the file says of
  // the run beside its state. Collective.
  CheckpointWriter(std::string path, std::shared_ptr<const MeshPart> part, const Vec& start,
                   Json about);

  // Collective. Where the file cannot be written the older one stays and the run goes on: rank 0
  // has failure().
  void write(const PartState& state, double seconds_of_run);

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
PartState state_of(const MeshPart& part, const CheckpointFile& file);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
