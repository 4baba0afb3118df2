#include <algorithm>

#include "embedded/map_page_css.h"
#include "embedded/map_page_html.h"
#include "embedded/map_page_js.h"
#include "majorant/io/atomic_file.h"
#include "majorant/io/map_check.h"
#include "majorant/maps/map_file.h"
#include "majorant/pictures/internal/page_data.h"
#include "majorant/pictures/page_text.h"
#include "majorant/pictures/pictures.h"

namespace majorant {

void write_page(const std::string& path, const MapPage& page) {
  require_sound(path, page.map);
  if (page.scaffold) require_sound(path, *page.scaffold);
  if (page.other) require_sound(path, page.other->map);
  const std::string title = page.other ? page.title + " | " + page.other->title : page.title;
  write_file_atomically(path, fill_in(map_page_html(), {{"title", html_text(title)},
                                                        {"style", std::string(map_page_css())},
                                                        {"data", script_json(page_data(page))},
                                                        {"script", std::string(map_page_js())}}));
}

MapObserver Film::watcher() {
  return [this](const TraceEntry& row, const MapView& at) {
    take(row, at);
    return Directive::Continue;
  };
}

void Film::take(const TraceEntry& row, const MapView& at) {
  const int iteration = row.record.iteration;
  const bool is_known = !frames_.empty() && frames_.back().iteration >= iteration;
  if (is_known || iteration % every_ != 0) return;
  frames_.push_back({at.in_model_units(), iteration, row.energy});
  if (frame_bytes_ == 0) {
    const BezierTriangleSpace& space = frames_.back().map.space();
    const BezierTriangleSpace last(space.faces(), space.vertex_count(), degree_);
    frame_bytes_ = static_cast<std::size_t>(last.node_count()) * 2 * sizeof(float);
  }
  while (frames_.size() > 1 && frames_.size() * frame_bytes_ > most_bytes_) {
    every_ *= 2;
    std::erase_if(frames_, [&](const Frame& frame) { return frame.iteration % every_ != 0; });
  }
}

// The start is a frame even if nothing moved it.
bool Film::is_before(const Frame& frame, int last_iteration) {
  return frame.iteration < last_iteration || frame.iteration == 0;
}

std::size_t Film::count(int last_iteration) const {
  return 1 + static_cast<std::size_t>(std::count_if(
                 frames_.begin(), frames_.end(),
                 [&](const Frame& frame) { return is_before(frame, last_iteration); }));
}

std::vector<PageSnapshot> Film::frames(const Frame& result) const {
  std::vector<PageSnapshot> snapshots;
  const auto add = [&](const Frame& frame) {
    BezierMap map = frame.map;
    while (map.degree() < degree_) map = map.elevated();
    snapshots.push_back({frame.iteration, frame.map.degree(), frame.energy, to_map_file(map).uv});
  };
  for (const Frame& frame : frames_)
    if (is_before(frame, result.iteration)) add(frame);
  add(result);
  return snapshots;
}

int last_iteration(const std::vector<TraceEntry>& trace) {
  return trace.empty() ? 0 : trace.back().record.iteration;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
