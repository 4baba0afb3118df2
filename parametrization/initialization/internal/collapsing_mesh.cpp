#include "majorant/parametrization/initialization/internal/collapsing_mesh.h"

#include <algorithm>
#include <utility>

namespace majorant {

CollapsingMesh::CollapsingMesh(const Cells& faces, std::vector<Index> opposite, Index vertex_count)
    : from_(opposite.size()),
      opposite_(std::move(opposite)),
      leaving_(to_size(vertex_count), -1),
      is_present_(to_size(vertex_count), 1),
      has_face_(to_size(static_cast<Index>(faces.rows())), 1),
      faces_left_(static_cast<Index>(faces.rows())) {
  for (Index h = 0; h < static_cast<Index>(from_.size()); ++h) from_[h] = from_vertex(faces, h);
  for (Index h = 0; h < static_cast<Index>(from_.size()); ++h) {
    Index& leaving = leaving_[from(h)];
    if (leaving < 0 || this->opposite(h) < 0) leaving = h;
  }
}

void CollapsingMesh::ring(Index v, std::vector<Index>& ring) const {
  ring.clear();
  Index last = -1;
  for_each_leaving(v, [&](Index h) {
    ring.push_back(to(h));
    last = h;
  });
  if (on_boundary(v)) ring.push_back(from(previous(last)));
}

bool CollapsingMesh::may_collapse(Index h, End leaves, int most) {
  const Index v = leaves == End::Start ? from(h) : to(h),
              u = leaves == End::Start ? to(h) : from(h);
  const Index o = opposite(h);
  if (on_boundary(v) ? o >= 0 : on_boundary(u)) return false;
  // Faces beside the edge: neither may hang on by it alone.
  const auto hangs = [&](Index e) { return opposite(next(e)) < 0 && opposite(previous(e)) < 0; };
  if (hangs(h) || (o >= 0 && hangs(o))) return false;
  ring(v, ring_);
  ring(u, other_ring_);
  const auto sides = static_cast<std::size_t>(o >= 0 ? 2 : 1);
  if (ring_.size() + other_ring_.size() > static_cast<std::size_t>(most) + 2 + sides) return false;
  std::size_t common = 0;
  for (const Index w : ring_)
    common += static_cast<std::size_t>(std::count(other_ring_.begin(), other_ring_.end(), w));
  return common == sides;
}

void CollapsingMesh::link(Index a, Index b) {
  if (a >= 0) opposite_[a] = b;
  if (b >= 0) opposite_[b] = a;
}

// The face of h closes: its other two edges become one.
void CollapsingMesh::take_out(Index h) {
  link(opposite(next(h)), opposite(previous(h)));
  has_face_[face_of(h)] = 0;
  --faces_left_;
}

void CollapsingMesh::put_back(Index h) {
  for (const Index e : {next(h), previous(h)})
    if (opposite(e) >= 0) opposite_[opposite(e)] = e;
  has_face_[face_of(h)] = 1;
  ++faces_left_;
}

void CollapsingMesh::rename_corners(Index v, Index name) {
  for_each_leaving(v, [&](Index h) { from_[h] = name; });
}

void CollapsingMesh::collapse(Index h, End leaves) {
  // With the removed face on its left.
  const Index away = leaves == End::Start ? h : opposite(h);
  const Index back = leaves == End::Start ? opposite(h) : h;
  const Index v = leaves == End::Start ? from(h) : to(h),
              u = leaves == End::Start ? to(h) : from(h);
  Gone gone{v, u, away, back, leaving(u), -1, -1};
  if (away >= 0) gone.leaving_left = leaving(from(previous(away)));
  if (back >= 0) gone.leaving_right = leaving(from(previous(back)));
  const Index v_leaving = leaving(v);
  const bool inside = !on_boundary(u);

  rename_corners(v, u);
  if (away >= 0) take_out(away);
  if (back >= 0) take_out(back);

  // Half-edges of removed faces, where they were the ones to leave from, give way to what is glued
  // in their place.
  Index& at_u = leaving_[u];
  if (inside || (away >= 0 && at_u == next(away))) {
    at_u = opposite(previous(away));
  } else if (away < 0) {  // the boundary ran from u to v
    at_u = v_leaving == next(back) ? opposite(previous(back)) : v_leaving;
  }
  for (const Index e : {away, back}) {
    if (e < 0) continue;
    Index& at_w = leaving_[from(previous(e))];
    if (at_w == previous(e)) at_w = opposite(next(e));
  }
  is_present_[v] = 0;
  gone_.push_back(gone);
}

CollapsingMesh::Restored CollapsingMesh::restore() {
  const Gone gone = gone_.back();
  gone_.pop_back();
  for (const Index e : {gone.away, gone.back})
    if (e >= 0) put_back(e);
  leaving_[gone.onto] = gone.leaving_onto;
  if (gone.away >= 0) leaving_[from(previous(gone.away))] = gone.leaving_left;
  if (gone.back >= 0) leaving_[from(previous(gone.back))] = gone.leaving_right;
  is_present_[gone.vertex] = 1;
  rename_corners(gone.vertex, gone.vertex);
  return {gone.vertex, gone.onto};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
