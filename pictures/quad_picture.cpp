#include "majorant/pictures/quad_picture.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include "majorant/io/atomic_file.h"
#include "majorant/pictures/first_view.h"
#include "majorant/pictures/images/png_file.h"
#include "majorant/pictures/internal/canvas.h"
#include "majorant/pictures/internal/layout_drawing.h"
#include "majorant/pictures/internal/legend_drawing.h"
#include "majorant/pictures/internal/raster_scene.h"

namespace majorant {
namespace {

constexpr int kPictureWidth = 1000, kPictureHeight = 800;
constexpr double kQuadEdgeWidth = 0.8, kFeatureWidth = 2.5, kDotRadius = 5;
constexpr Color kFeatureColor{194, 24, 91};

using QuadEdge = std::pair<Index, Index>;  // ascending

Index quad_count(const QuadPicture& picture) {
  return static_cast<Index>(picture.quads.polygons.size());
}

template <class F>
void for_each_edge(const QuadPicture& picture, const F& f) {
  for (Index q = 0; q < quad_count(picture); ++q)
    for (std::size_t k = 0; k < 4; ++k) {
      const auto& quad = picture.quads.polygons[q];
      f(q, QuadEdge(std::minmax(quad[k], quad[(k + 1) % 4])));
    }
}

// The number of quads at each vertex, if it is not 4; 0 for others and on the border.
struct Valences {
  std::vector<int> irregular;
  bool has_border = false;
};

Valences valences_of(const QuadPicture& picture) {
  Valences found;
  found.irregular.assign(picture.quads.positions.size(), 0);
  std::map<QuadEdge, int> sides;
  for_each_edge(picture, [&](Index, const QuadEdge& edge) { ++sides[edge]; });
  for (const Index v : picture.quads.polygons.indices()) ++found.irregular[v];
  for (int& count : found.irregular)
    if (count == 4) count = 0;
  for (const auto& [edge, count] : sides) {
    if (count != 1) continue;
    found.has_border = true;
    found.irregular[edge.first] = found.irregular[edge.second] = 0;
  }
  return found;
}

// Returns a map in which cells 2 q and 2 q + 1 are halves of quad q. uv: by corner of quads, 4 a
// quad; corners at one place with one uv are one point.
MapFile map_of(const QuadPicture& picture, const std::vector<Vector2>& uv,
               const Valences& valences) {
  struct Corner {
    Index vertex;
    double u, v;
    auto operator<=>(const Corner&) const = default;
  };
  std::map<Corner, Index> numbers;
  std::vector<Corner> places;
  MapFile map;
  const Index quads = quad_count(picture);
  map.cells.resize(2 * quads, 3);
  map.input_face.resize(2 * quads);
  map.chart = Eigen::VectorXi::Zero(2 * quads);
  for (Index q = 0; q < quads; ++q) {
    std::array<Index, 4> corner{};
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector2& at = uv[4 * to_size(q) + k];
      const Corner place{picture.quads.polygons[q][k], at.x(), at.y()};
      const auto [found, is_new] = numbers.try_emplace(place, static_cast<Index>(places.size()));
      if (is_new) places.push_back(place);
      corner[k] = found->second;
    }
    map.cells.row(2 * q) << corner[0], corner[1], corner[2];
    map.cells.row(2 * q + 1) << corner[0], corner[2], corner[3];
    for (const Index cell : {2 * q, 2 * q + 1}) {
      map.input_face[cell] = q;
      if (!picture.patch_of.empty()) map.chart[cell] = picture.patch_of[q];
    }
  }
  const auto count = static_cast<Index>(places.size());
  map.points.resize(count, 3);
  map.uv.resize(count, 2);
  map.input_vertex.resize(count);
  map.cone.resize(count);
  for (Index p = 0; p < count; ++p) {
    const Corner& place = places[p];
    map.points.row(p) = picture.quads.positions[place.vertex];
    map.uv.row(p) << place.u, place.v;
    map.input_vertex[p] = place.vertex;
    map.cone[p] = valences.irregular[place.vertex];
  }
  return map;
}

// Quads first to last - 1 of a patch, in rows of `columns`.
struct PatchGrid {
  Index first, last, columns;
  Index rows() const { return (last - first) / columns; }
};

std::vector<PatchGrid> grids_of(const QuadPicture& picture) {
  std::vector<PatchGrid> grids;
  for (Index q = 0; q < quad_count(picture);) {
    PatchGrid grid{q, q, 0};
    while (grid.last < quad_count(picture) &&
           (picture.patch_of.empty() ? grid.last == q
                                     : picture.patch_of[grid.last] == picture.patch_of[q]))
      ++grid.last;
    const auto goes_on = [&](Index left) {
      const auto &a = picture.quads.polygons[left], &b = picture.quads.polygons[left + 1];
      return a[1] == b[0] && a[2] == b[3];
    };
    grid.columns = 1;
    while (q + grid.columns < grid.last && goes_on(q + grid.columns - 1)) ++grid.columns;
    if ((grid.last - grid.first) % grid.columns != 0) grid.columns = grid.last - grid.first;
    grids.push_back(grid);
    q = grid.last;
  }
  return grids;
}

// Returns uv by corner of quads: patches in rows, the highest ones first, with a gap of one square.
std::vector<Vector2> laid_out(const QuadPicture& picture) {
  std::vector<PatchGrid> grids = grids_of(picture);
  std::stable_sort(grids.begin(), grids.end(),
                   [](const PatchGrid& a, const PatchGrid& b) { return a.rows() > b.rows(); });
  double area = 0, widest = 1;
  for (const PatchGrid& grid : grids) {
    area += static_cast<double>(grid.columns + 1) * (grid.rows() + 1);
    widest = std::max(widest, static_cast<double>(grid.columns));
  }
  const double width = std::max(widest, std::sqrt(area));
  std::vector<Vector2> uv(4 * picture.quads.polygons.size());
  double left = 0, bottom = 0, height = 0;
  for (const PatchGrid& grid : grids) {
    if (left > 0 && left + grid.columns > width) {
      bottom += height + 1;
      left = height = 0;
    }
    height = std::max(height, static_cast<double>(grid.rows()));
    for (Index q = grid.first; q < grid.last; ++q) {
      const Vector2 at(left + (q - grid.first) % grid.columns,
                       bottom + (q - grid.first) / grid.columns);
      const std::array corners{at, Vector2(at + Vector2(1, 0)), Vector2(at + Vector2(1, 1)),
                               Vector2(at + Vector2(0, 1))};
      std::copy(corners.begin(), corners.end(), uv.begin() + 4 * std::ptrdiff_t{q});
    }
    left += grid.columns + 1;
  }
  return uv;
}

std::vector<LegendMark> marks_of(const QuadPicture& picture, const Valences& valences) {
  std::vector<LegendMark> marks;
  const auto add_dot = [&](Index count, int turns, const char* words) {
    if (count == 0) return;
    marks.push_back({{Circle{.radius = kDotRadius, .fill = cone_color(turns)}},
                     fmt::format("{} {} of {} than 4 quads", count,
                                 count == 1 ? "vertex" : "vertices", words)});
  };
  const auto& all = valences.irregular;
  const auto count_if = [&](const auto& holds) {
    return static_cast<Index>(std::count_if(all.begin(), all.end(), holds));
  };
  add_dot(count_if([](int n) { return n > 0 && n < 4; }), 3, "fewer");
  add_dot(count_if([](int n) { return n > 4; }), 5, "more");
  if (!picture.feature_edges.empty()) {
    Path line;
    line.move({-kHalfSign, 0});
    line.line({kHalfSign, 0});
    marks.push_back({{Shape{.path = line, .stroke = Stroke{kFeatureColor, kFeatureWidth}}},
                     fmt::format("{} edges on features", picture.feature_edges.size())});
  }
  Shape square{.path = rectangle({-kHalfSign, -kHalfSign}, {2 * kHalfSign, 2 * kHalfSign}),
               .stroke = Stroke{kInk, kQuadEdgeWidth}};
  marks.push_back({{std::move(square)},
                   fmt::format("{} quads{}", quad_count(picture),
                               picture.patch_of.empty()
                                   ? ""
                                   : fmt::format(" in {} patches", grids_of(picture).size()))});
  return marks;
}

class Painting {
 public:
  explicit Painting(const QuadPicture& picture)
      : picture_(picture),
        valences_(valences_of(picture)),
        // uv is not used.
        map_(map_of(picture, std::vector<Vector2>(4 * picture.quads.polygons.size(), {0, 0}),
                    valences_)),
        legends_({}, marks_of(picture, valences_), kPictureWidth) {}

  Drawing draw() {
    const double height = kPictureHeight - legends_.height();
    see({kPictureWidth, static_cast<int>(std::lround(height))});
    Drawing drawing{.width = kPictureWidth,
                    .height = kPictureHeight,
                    .title = "Quads of a surface",
                    .description = picture_.title};
    for (const LegendMark& mark : marks_of(picture_, valences_))
      drawing.description += "; " + mark.text;
    add_quads(drawing.items);
    for (DrawingItem& item : legends_.items(height, kPictureHeight)) drawing.items.push_back(item);
    return drawing;
  }

 private:
  // The visible side and the place of a quad on the screen.
  struct Seen {
    std::array<Vector2, 4> corners;
    double depth;
    bool is_front;
  };

  static bool is_front(const Vector2& a, const Vector2& b, const Vector2& c) {
    return cross(b - a, c - a) < 0;  // y points down
  }

  void see(PixelSize size) {
    view_ = first_view(map_);
    const std::vector<RasterTriangle> halves = surface_triangles(map_, view_, size);
    for (Index q = 0; q < quad_count(picture_); ++q) {
      const RasterTriangle &one = halves[2 * to_size(q)], &other = halves[2 * to_size(q) + 1];
      Seen seen{{one.corners[0], one.corners[1], one.corners[2], other.corners[2]}, 0, true};
      seen.depth = one.depth[0] + one.depth[1] + one.depth[2] + other.depth[2];
      seen.is_front = is_front(seen.corners[0], seen.corners[1], seen.corners[2]) ||
                      is_front(seen.corners[0], seen.corners[2], seen.corners[3]);
      seen_.push_back(seen);
      if (seen.is_front || valences_.has_border) order_.push_back(q);
    }
    std::stable_sort(order_.begin(), order_.end(),
                     [&](Index a, Index b) { return seen_[a].depth < seen_[b].depth; });
  }

  // Features and irregular vertices are drawn after the last of their quads.
  void add_quads(std::vector<DrawingItem>& items) const {
    std::map<QuadEdge, Index> last_at_edge;
    std::vector<Index> last_at_vertex(picture_.quads.positions.size(), -1);
    for (const auto& [a, b] : picture_.feature_edges) last_at_edge[std::minmax(a, b)] = -1;
    std::vector<Index> rank(picture_.quads.polygons.size(), -1);
    for (std::size_t r = 0; r < order_.size(); ++r) rank[order_[r]] = static_cast<Index>(r);
    for_each_edge(picture_, [&](Index q, const QuadEdge& edge) {
      for (const Index v : {edge.first, edge.second})
        last_at_vertex[v] = std::max(last_at_vertex[v], rank[q]);
      if (const auto found = last_at_edge.find(edge); found != last_at_edge.end())
        found->second = std::max(found->second, rank[q]);
    });
    const CellColors colors = plain_colors(map_);
    for (Index r = 0; r < static_cast<Index>(order_.size()); ++r) {
      const Index q = order_[r];
      const auto& quad = picture_.quads.polygons[q];
      const auto& corners = seen_[q].corners;
      Path outline;
      outline.move(corners[0]);
      for (std::size_t k = 1; k < 4; ++k) outline.line(corners[k]);
      outline.close();
      items.emplace_back(Shape{.path = std::move(outline),
                               .fill = lit(colors[2 * to_size(q)], q),
                               .stroke = Stroke{kInk, kQuadEdgeWidth}});
      for (std::size_t k = 0; k < 4; ++k) {
        const auto found = last_at_edge.find(std::minmax(quad[k], quad[(k + 1) % 4]));
        if (found == last_at_edge.end() || found->second != r) continue;
        Path line;
        line.move(corners[k]);
        line.line(corners[(k + 1) % 4]);
        items.emplace_back(
            Shape{.path = std::move(line), .stroke = Stroke{kFeatureColor, kFeatureWidth}});
      }
      for (std::size_t k = 0; k < 4; ++k)
        if (const int n = valences_.irregular[quad[k]]; n > 0 && last_at_vertex[quad[k]] == r)
          items.emplace_back(
              Circle{.center = corners[k], .radius = kDotRadius, .fill = cone_color(n)});
    }
  }

  Color lit(const Color& color, Index q) const {
    const auto corner = [&](std::size_t k) -> const Vector3& {
      return picture_.quads.positions[picture_.quads.polygons[q][k]];
    };
    const Vector3 normal = (corner(2) - corner(0)).cross(corner(3) - corner(1)).stableNormalized();
    const double light = kDarkest + (1 - kDarkest) * std::abs(normal.dot(view_));
    const auto channel = [&](std::uint8_t value) {
      return static_cast<std::uint8_t>(std::lround(light * value));
    };
    return {channel(color.red), channel(color.green), channel(color.blue)};
  }

  const QuadPicture& picture_;
  Valences valences_;
  MapFile map_;
  DrawnLegends legends_;
  Vector3 view_ = Vector3::UnitZ();
  std::vector<Seen> seen_;    // by quad
  std::vector<Index> order_;  // quads in painting order, the farthest first
};

}  // namespace

std::string svg_text(const QuadPicture& picture) { return svg_text(Painting(picture).draw()); }

void write_svg(const std::string& path, const QuadPicture& picture) {
  write_file_atomically(path, svg_text(picture));
}

void write_png(const std::string& path, const QuadPicture& picture) {
  Canvas canvas({kPictureWidth, kPictureHeight}, 1, Paper::White);
  canvas.paint(Painting(picture).draw().items);
  write_file_atomically(path, encode_png(canvas.image()));
}

MapPage page_of(const QuadPicture& picture) {
  MapPage page;
  page.title = picture.title;
  page.map = map_of(picture, laid_out(picture), valences_of(picture));
  page.alignment = Alignment::Never;
  if (picture.feature_edges.empty()) return page;
  std::map<QuadEdge, int> is_feature;
  for (const auto& [a, b] : picture.feature_edges) is_feature[std::minmax(a, b)] = 1;
  MapFile& map = page.map;
  map.seam_edges = Cells::Zero(map.cells.rows(), 3);
  for (Index c = 0; c < map.cells.rows(); ++c)
    for (Index k = 0; k < 3; ++k) {
      const Index a = map.input_vertex[map.cells(c, k)],
                  b = map.input_vertex[map.cells(c, (k + 1) % 3)];
      map.seam_edges(c, k) = static_cast<Index>(is_feature.count(std::minmax(a, b)));
    }
  return page;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
