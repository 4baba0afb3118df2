#include "majorant/parametrization/cone_cleanup.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "majorant/framework/error.h"

namespace majorant {
namespace {

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

// A seamless map needs every angle below 180 degrees; 120 on average leaves room to untangle.
constexpr int kLargestMeanAngle = 120;

class Cleanup {
 public:
  Cleanup(const SurfaceMesh& mesh, const FieldGeometry& geometry, const std::vector<char>& is_fixed,
          FieldConnection& field)
      : mesh_(mesh), geometry_(geometry), is_fixed_(is_fixed), field_(field) {}

  int run() {
    // A pass can make room for the next one; each of them leaves fewer cones.
    while (cancel_neighbours()) {
    }
    for (Index v = 0; v < mesh_.vertex_count(); ++v)
      while (excess(v) != 0) route(v);
    return moved_;
  }

 private:
  int turns(Index v) const { return field_.quarter_turns[at(v)]; }
  bool boundary(Index v) const { return geometry_.is_boundary[at(v)]; }
  bool movable(Index h) const {
    const Index o = mesh_.opposite(h);
    if (o < 0) return false;
    return is_fixed_.empty() || !is_fixed_[at(h / 3)] || !is_fixed_[at(o / 3)];
  }
  int most_turns(Index v) const {
    return std::max(4, geometry_.valence[at(v)] * kLargestMeanAngle / 90);
  }
  // Quarter turns that v has to give away (> 0) or to receive (< 0).
  int excess(Index v) const {
    if (boundary(v)) return 0;
    return turns(v) < 1 ? turns(v) - 1 : std::max(0, turns(v) - most_turns(v));
  }
  // What a quarter turn less at `from` and one more at `to` does to the number of cones.
  int change(Index from, Index to) const {
    const auto cost = [&](Index v, int step) {
      return boundary(v) ? 0 : std::abs(turns(v) + step - 4) - std::abs(turns(v) - 4);
    };
    return cost(from, -1) + cost(to, 1);
  }
  void move(Index h) {
    move_quarter(mesh_, geometry_, h, field_);
    ++moved_;
  }

  bool cancel_neighbours() {
    bool any = false;
    for (Index h = 0; h < mesh_.half_edge_count(); ++h) {
      const Index a = mesh_.from_vertex(h), b = mesh_.to_vertex(h);
      if (!movable(h) || change(a, b) >= 0) continue;
      move(h);
      any = true;
    }
    return any;
  }

  // Sends one quarter turn of a vertex with an excess to the nearest vertex that can take it (or
  // fetches one), over as few edges as possible.
  void route(Index v) {
    const int step = excess(v) > 0 ? 1 : -1;  // what the receiver gets
    const auto takes = [&](Index w) {
      return boundary(w) || (turns(w) + step >= 1 && turns(w) + step <= most_turns(w) &&
                             turns(w) * step <= 4 * step);
    };
    std::vector<std::vector<Index>> leaving(at(mesh_.vertex_count()));
    for (Index h = 0; h < mesh_.half_edge_count(); ++h)
      if (movable(h)) leaving[at(mesh_.from_vertex(h))].push_back(h);
    std::vector<Index> entered(at(mesh_.vertex_count()), -1), queue{v};
    Index goal = -1;
    for (std::size_t next = 0; next < queue.size() && goal < 0; ++next)
      for (const Index h : leaving[at(queue[next])]) {
        const Index w = mesh_.to_vertex(h);
        if (w == v || entered[at(w)] >= 0) continue;
        entered[at(w)] = h;
        queue.push_back(w);
        if (takes(w)) {
          goal = w;
          break;
        }
      }
    if (goal < 0)
      throw Error(ErrorKind::Infeasible,
                  fmt::format("{}: vertex {}: the mesh is too coarse for the cones of a cross "
                              "field; refine it",
                              mesh_.file(), mesh_.input_vertex(v) + 1));
    for (Index w = goal; w != v; w = mesh_.from_vertex(entered[at(w)]))
      move(step > 0 ? entered[at(w)] : mesh_.opposite(entered[at(w)]));
  }

  const SurfaceMesh& mesh_;
  const FieldGeometry& geometry_;
  const std::vector<char>& is_fixed_;
  FieldConnection& field_;
  int moved_ = 0;
};

}  // namespace

int clean_up_cones(const SurfaceMesh& mesh, const FieldGeometry& geometry,
                   const std::vector<char>& is_fixed, FieldConnection& field) {
  return Cleanup(mesh, geometry, is_fixed, field).run();
}

}  // namespace majorant
