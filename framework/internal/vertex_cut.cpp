#include "majorant/framework/internal/vertex_cut.h"

#include <span>
#include <utility>

namespace majorant {

VertexCut::VertexCut(BlockNeighbours near, std::vector<Terminal> terminals)
    : near_(std::move(near)),
      terminals_(std::move(terminals)),
      previous_(to_size(near_.size()), kNone),
      next_(to_size(near_.size()), kNone) {
  while (find_levels()) {
    tried_.assign(to_size(near_.size()), kNone);
    for (Index k = 0; k < near_.size(); ++k)
      if (terminals_[k] == Terminal::Source && previous_[k] != kEnd && level_[2 * k] == 0 &&
          find_path(2 * k))
        add_path();
  }
  near_sources_ = sides(Side::Sources, Side::Sinks);
  reverse();
  find_levels();
  near_sinks_ = sides(Side::Sinks, Side::Sources);
}

// Returns the next state: out of a free node, or back along the path that uses the node.
Index VertexCut::after_entering(Index node) const {
  const Index previous = previous_[node];
  return previous == kNone ? 2 * node + 1 : previous >= 0 ? 2 * previous + 1 : kNone;
}

// A search that leaves a used node has undone the rest of that node's path, and may also undo its
// way through the node.
bool VertexCut::find_levels() {
  level_.assign(2 * to_size(near_.size()), kNone);
  queue_.clear();
  for (Index k = 0; k < near_.size(); ++k)
    if (terminals_[k] == Terminal::Source) {
      level_[2 * k] = 0;
      queue_.push_back(2 * k);
    }
  Index last = kNone;  // the level of the nearest sink
  for (std::size_t q = 0; q < queue_.size(); ++q) {
    const Index state = queue_[q], node = state / 2, level = level_[state];
    if (last >= 0 && level >= last) break;
    const auto reach = [&](Index to) {
      if (level_[to] >= 0) return;
      level_[to] = level + 1;
      queue_.push_back(to);
    };
    if (state % 2 == 0) {
      if (const Index to = after_entering(node); to >= 0) reach(to);
    } else if (is_last(node)) {
      last = level;
    } else {
      if (previous_[node] != kNone) reach(state - 1);
      for (const Index other : near_.of(node)) reach(2 * other);
    }
  }
  return last >= 0;
}

// Returns the next untried state, one level on; -1: none.
Index VertexCut::after_leaving(Index node) {
  const std::span<const Index> near = near_.of(node);
  const Index level = level_[2 * node + 1] + 1;
  Index& tried = tried_[node];
  if (tried == kNone) {
    tried = 0;
    if (previous_[node] != kNone && level_[2 * node] == level) return 2 * node;
  }
  while (tried < static_cast<Index>(near.size()))
    if (const Index to = 2 * near[to_size(tried++)]; level_[to] == level) return to;
  return kNone;
}

// Advances level by level. A state without a way on is not tried again.
bool VertexCut::find_path(Index first) {
  path_.assign(1, first);
  while (!path_.empty()) {
    const Index state = path_.back(), node = state / 2;
    Index to = kNone;
    if (state % 2 == 1) {
      if (is_last(node)) return true;
      to = after_leaving(node);
    } else {
      to = after_entering(node);
      if (to >= 0 && level_[to] != level_[state] + 1) to = kNone;
    }
    if (to >= 0) {
      path_.push_back(to);
    } else {
      level_[state] = kEnd;
      path_.pop_back();
    }
  }
  return false;
}

void VertexCut::add_path() {
  for (std::size_t k = 0; k + 1 < path_.size(); ++k) {
    const Index node = path_[k] / 2, to = path_[k + 1] / 2;
    if (path_[k] % 2 == 1 || to == node) continue;
    next_[to] = kNone;
    previous_[node] = kNone;
  }
  for (std::size_t k = 0; k + 1 < path_.size(); ++k) {
    const Index node = path_[k] / 2, to = path_[k + 1] / 2;
    if (path_[k] % 2 == 0 || to == node) continue;
    next_[node] = to;
    previous_[to] = node;
  }
  previous_[path_.front() / 2] = kEnd;
  next_[path_.back() / 2] = kEnd;
  for (const Index state : path_) level_[state] = kEnd;
}

// Reverses the flow.
void VertexCut::reverse() {
  std::swap(previous_, next_);
  for (Terminal& terminal : terminals_)
    if (terminal != Terminal::None)
      terminal = terminal == Terminal::Source ? Terminal::Sink : Terminal::Source;
}

// Returns the sides by what the last search reached. A node of the separator has no free capacity.
std::vector<VertexCut::Side> VertexCut::sides(Side here, Side there) const {
  std::vector<Side> out;
  out.reserve(to_size(near_.size()));
  for (Index k = 0; k < near_.size(); ++k)
    out.push_back(level_[2 * k + 1] >= 0 ? here : level_[2 * k] >= 0 ? Side::Separator : there);
  return out;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
