#include "majorant/parametrization/initialization/internal/sweep_stages.h"

#include <algorithm>

#include "majorant/framework/parallel.h"

namespace majorant {
namespace {

// Vertices of a task, some 50 us; fewer are not worth waking a thread for.
constexpr Index kTaskVertices = 32;

}  // namespace

void SweepStages::order(const CollapsingMesh& mesh, const std::vector<char>& moves, int sweeps) {
  const Index count = mesh.vertex_count();
  std::vector<Index> moving, neighbours;
  std::vector<std::size_t> first{0};
  for (Index v = 0; v < count; ++v) {
    if (!moves[v]) continue;
    moving.push_back(v);
    mesh.for_each_leaving(v, [&](Index h) { neighbours.push_back(mesh.to(h)); });
    if (mesh.on_boundary(v)) {
      Index last = -1;
      mesh.for_each_leaving(v, [&](Index h) { last = h; });
      neighbours.push_back(mesh.from(previous(last)));
    }
    first.push_back(neighbours.size());
  }
  // The last stage of each vertex so far; -1: none yet.
  std::vector<Index> stage(to_size(count), -1), stages;
  stages.reserve(moving.size() * to_size(sweeps));
  for (int sweep = 0; sweep < sweeps; ++sweep)
    for (std::size_t k = 0; k < moving.size(); ++k) {
      Index& mine = stage[moving[k]];
      for (std::size_t q = first[k]; q < first[k + 1]; ++q)
        mine = std::max(mine, stage[neighbours[q]]);
      stages.push_back(++mine);
    }
  for (const Index s : stages) {
    if (starts_.size() < to_size(s) + 2) starts_.resize(to_size(s) + 2, 0);
    ++starts_[to_size(s) + 1];
  }
  for (std::size_t s = 1; s < starts_.size(); ++s) starts_[s] += starts_[s - 1];
  vertices_.resize(stages.size());
  std::vector<std::size_t> next(starts_);
  for (std::size_t k = 0; k < stages.size(); ++k)
    vertices_[next[stages[k]]++] = moving[k % moving.size()];
}

void SweepStages::visit(std::vector<VertexDescent>& descents, const StopCheck& stop) const {
  const int threads = static_cast<int>(descents.size());
  for (std::size_t s = 0; s + 1 < starts_.size(); ++s) {
    const Index* const vertices = vertices_.data() + starts_[s];
    const auto count = static_cast<Index>(starts_[s + 1] - starts_[s]);
    const Index pieces = std::min<Index>(threads, (count + kTaskVertices - 1) / kTaskVertices);
    const auto improve = [&](Index piece, int thread) {
      stop.poll();
      const Index last = count * (piece + 1) / pieces;
      for (Index k = count * piece / pieces; k < last; ++k)
        descents[thread].improve(vertices[k], 1);
    };
    parallel_tasks(pieces, improve, threads);
  }
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
