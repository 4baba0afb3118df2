// Vertices of a glTF file with other texture coordinates: the old ones, copies for corners with
// several coordinates, and new ones between them.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

#include "majorant/framework/types.h"

namespace majorant {

// A vertex of the output: one of the input, or a point between three of them.
struct Blend {
  std::array<std::uint32_t, 3> from{};
  Barycentric weights = Barycentric::Unit(0);
  Index vertex = -1;  // of the mesh, for a new vertex
  bool is_vertex() const { return weights[0] == 1; }
};

using Uv = std::array<float, 2>;  // as in the file

// The vertices of the output for one Vertices of the scene: the old ones, then copies and new ones.
class NewVertices {
 public:
  explicit NewVertices(std::size_t count) : uv_(count), has_uv_(count, 0) {}

  std::uint32_t number(std::uint32_t vertex, const Uv& uv) {
    if (!has_uv_[vertex]) {
      has_uv_[vertex] = 1;
      uv_[vertex] = uv;
    }
    if (is_same(uv_[vertex], uv)) return vertex;
    return add({vertex, vertex, vertex, bits(uv)}, {{vertex, vertex, vertex}}, uv);
  }
  // blend: ordered by the numbers of its corners in the mesh, so that all faces at an edge compute
  // the same.
  std::uint32_t number(const Blend& blend, const Uv& uv) {
    has_blends_ = true;
    constexpr auto kBlend = std::numeric_limits<std::uint32_t>::max();
    return add({static_cast<std::uint32_t>(blend.vertex), kBlend, used_corners(blend), bits(uv)},
               blend, uv);
  }

  std::size_t count() const { return uv_.size(); }
  const std::vector<Uv>& uv() const { return uv_; }
  const std::vector<Blend>& added() const { return added_; }
  bool has_blends() const { return has_blends_; }

 private:
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint64_t, std::uint64_t>;

  static bool is_same(const Uv& a, const Uv& b) { return bits(a) == bits(b); }
  static std::uint64_t bits(const Uv& uv) { return std::bit_cast<std::uint64_t>(uv); }
  // Returns a mask of the corners with weight: both corners of an edge.
  static std::uint64_t used_corners(const Blend& blend) {
    std::uint64_t key = 0;
    for (std::size_t k = 0; k < 3; ++k)
      if (blend.weights[static_cast<Index>(k)] != 0)
        key = key * 0x9E3779B97F4A7C15U + blend.from[k] + 1;
    return key;
  }

  std::uint32_t add(const Key& key, const Blend& blend, const Uv& uv) {
    const auto [entry, is_new] = numbers_.try_emplace(key, static_cast<std::uint32_t>(uv_.size()));
    if (is_new) {
      uv_.push_back(uv);
      added_.push_back(blend);
    }
    return entry->second;
  }

  std::vector<Uv> uv_;
  std::vector<char> has_uv_;
  std::vector<Blend> added_;
  std::map<Key, std::uint32_t> numbers_;
  bool has_blends_ = false;
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
