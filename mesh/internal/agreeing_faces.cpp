#include "majorant/mesh/internal/agreeing_faces.h"

#include <algorithm>
#include <utility>

namespace majorant {
namespace {

// The least relative gain of a shorter cut: above rounding, so that turning faces comes to an end.
constexpr double kShorter = 1e-9;

class FaceTurning {
 public:
  FaceTurning(const GivenTriangles& triangles, GluedSides& glued, const StopCheck& stop)
      : triangles_(triangles), glued_(glued), stop_(stop) {
    result_.is_turned.assign(to_size(triangles.face_count()), 0);
  }

  // Orients every component like its first face, breadth first. Where fronts that disagree meet,
  // the surface has one side and is cut.
  AgreeingFaces turn() {
    std::vector<char> seen(result_.is_turned.size(), 0);
    std::vector<Index> component;
    for (Index start = 0; start < triangles_.face_count(); ++start) {
      if (seen[start]) continue;
      component = {start};
      seen[start] = 1;
      bool is_one_sided = false;
      for (std::size_t k = 0; k < component.size(); ++k)
        for (Index h = 3 * component[k]; h < 3 * component[k] + 3; ++h) {
          const Index o = glued_.opposite[h];
          if (o < 0) continue;
          if (!seen[face_of(o)]) {
            seen[face_of(o)] = 1;
            is_turned(face_of(o)) =
                triangles_.agree(h, o) ? is_turned(component[k]) : !is_turned(component[k]);
            component.push_back(face_of(o));
          } else if (o > h && disagrees(h)) {
            is_one_sided = true;
          }
        }
      if (is_one_sided) cut_open(component);
      result_.one_sided += is_one_sided ? 1 : 0;
      turn_the_fewer(component);
    }
    return std::move(result_);
  }

 private:
  char& is_turned(Index f) { return result_.is_turned[f]; }
  char is_turned(Index f) const { return result_.is_turned[f]; }

  bool disagrees(Index h) const {
    const Index o = glued_.opposite[h];
    return triangles_.agree(h, o) == (is_turned(face_of(h)) != is_turned(face_of(o)));
  }

  double cut_length(const std::vector<Index>& component) const {
    double sum = 0;
    for (const Index f : component)
      for (Index h = 3 * f; h < 3 * f + 3; ++h)
        if (glued_.opposite[h] > h && disagrees(h)) sum += triangles_.length(h);
    return sum;
  }

  // Chooses the shorter of two cuts, each shortened: of the component as it was oriented, and of
  // its faces as given.
  void cut_open(const std::vector<Index>& component) {
    shorten_cut(component);
    const double length_oriented = cut_length(component);
    std::vector<char> oriented;
    for (const Index f : component) oriented.push_back(std::exchange(is_turned(f), 0));
    shorten_cut(component);
    if (cut_length(component) > (1 + kShorter) * length_oriented)
      for (std::size_t k = 0; k < component.size(); ++k) is_turned(component[k]) = oriented[k];
    for (const Index f : component)
      for (Index h = 3 * f; h < 3 * f + 3; ++h)
        if (glued_.opposite[h] >= 0 && disagrees(h)) {
          result_.cut_edges.push_back(std::min(h, glued_.opposite[h]));
          glued_.open(h);
        }
  }

  // Turns faces as long as that makes the cut shorter: turning a face exchanges its cut and uncut
  // edges.
  void shorten_cut(const std::vector<Index>& component) {
    std::vector<Index> left(component.rbegin(), component.rend());
    while (!left.empty()) {
      stop_.poll_at(left.size());
      const Index f = left.back();
      left.pop_back();
      double cut = 0, uncut = 0;
      for (Index h = 3 * f; h < 3 * f + 3; ++h)
        if (const Index o = glued_.opposite[h]; o >= 0 && face_of(o) != f)
          (disagrees(h) ? cut : uncut) += triangles_.length(h);
      if (!(cut > (1 + kShorter) * uncut)) continue;
      is_turned(f) ^= 1;
      for (Index h = 3 * f; h < 3 * f + 3; ++h)
        if (glued_.opposite[h] >= 0) left.push_back(face_of(glued_.opposite[h]));
    }
  }

  void turn_the_fewer(const std::vector<Index>& component) {
    const auto turned = std::count_if(component.begin(), component.end(),
                                      [&](Index f) { return is_turned(f) != 0; });
    const auto all = static_cast<std::ptrdiff_t>(component.size());
    if (2 * turned > all || (2 * turned == all && is_turned(component.front())))
      for (const Index f : component) is_turned(f) ^= 1;
  }

  const GivenTriangles& triangles_;
  GluedSides& glued_;
  const StopCheck& stop_;
  AgreeingFaces result_;
};

}  // namespace

AgreeingFaces turn_to_agree(const GivenTriangles& triangles, GluedSides& glued,
                            const StopCheck& stop) {
  return FaceTurning(triangles, glued, stop).turn();
}

AgreeingFaces open_disagreeing(const GivenTriangles& triangles, GluedSides& glued) {
  AgreeingFaces result;
  result.is_turned.assign(to_size(triangles.face_count()), 0);
  for (Index h = 0; h < triangles.half_edge_count(); ++h)
    if (const Index o = glued.opposite[h]; o > h && !triangles.agree(h, o)) {
      result.cut_edges.push_back(h);
      glued.open(h);
    }
  return result;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
