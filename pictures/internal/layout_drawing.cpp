#include "majorant/pictures/internal/layout_drawing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <set>
#include <string_view>
#include <tuple>

#include "majorant/certify/global_injectivity.h"
#include "majorant/framework/error.h"
#include "majorant/framework/pair_order.h"
#include "majorant/maps/bezier_cell.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/pictures/internal/alignment.h"
#include "majorant/pictures/internal/letters.h"
#include "majorant/pictures/turned_over.h"

namespace majorant {
namespace {

constexpr double kTallest = 4000;
constexpr int kPiecesPerEdge = 4;  // Hermite cubics, for degrees above 3

// Sizes and limits of marks.
constexpr double kMaxLines =
    4000;  // of grids, in each direction; more would not be distinguishable
constexpr double kSquareWidth = 1.2, kOutlineWidth = 1.5, kSeamWidth = 2.5, kTargetWidth = 1.8;
constexpr double kConeRadius = 5, kHeldRadius = 5, kTargetRadius = 8, kMeetingRadius = 10;
constexpr double kNameShare = 0.3;  // of the side of a square with the chart's area
constexpr double kSmallestName = 8, kLargestName = 22;
constexpr double kTint = 0.25;  // share of the chart's colour in its cells
constexpr Color kWhite{255, 255, 255}, kGrey = kNoAreaColor;
constexpr Color kPinColor{28, 31, 36}, kHandleColor{213, 94, 0};
constexpr Color kMeetingColor{230, 0, 122}, kSquareColor{120, 120, 120};
constexpr Color kScaffoldFill{246, 246, 246}, kScaffoldEdge{208, 208, 208};
// Neighbouring colours differ in hue; all are dark enough to be seen on the cells' colours.
constexpr Color kColors[] = {{123, 47, 190}, {0, 139, 139}, {194, 24, 91},  {46, 125, 50},
                             {21, 101, 192}, {93, 64, 55},  {216, 27, 255}, {0, 164, 214},
                             {85, 107, 47},  {63, 63, 159}};

Color chart_color(Index chart) { return kColors[to_size(chart) % std::size(kColors)]; }

// Returns point and derivative of a Bezier curve at s, by de Casteljau's algorithm.
std::pair<Vector2, Vector2> evaluate_curve(std::vector<Vector2> control, double s) {
  Vector2 derivative = Vector2::Zero();
  const auto degree = static_cast<double>(control.size() - 1);
  while (control.size() > 1) {
    if (control.size() == 2) derivative = degree * (control[1] - control[0]);
    for (std::size_t i = 0; i + 1 < control.size(); ++i) {
      control[i] = (1.0 - s) * control[i] + s * control[i + 1];
    }
    control.pop_back();
  }
  return {control[0], derivative};
}

// Adds cubics that match the curve's points and derivatives at the ends of equal pieces.
void add_hermite_pieces(Path& path, const std::vector<Vector2>& control) {
  constexpr double kThird = 1.0 / (3.0 * kPiecesPerEdge);
  auto [begin, begin_derivative] = evaluate_curve(control, 0.0);
  for (int piece = 1; piece <= kPiecesPerEdge; ++piece) {
    const auto [end, end_derivative] =
        evaluate_curve(control, static_cast<double>(piece) / kPiecesPerEdge);
    path.cubic(begin + kThird * begin_derivative, end - kThird * end_derivative, end);
    begin = end;
    begin_derivative = end_derivative;
  }
}

struct CellEdge {
  Index cell;
  int edge;
};

// Calls f(edge, neighbouring cell or -1) for every edge. Files may hold cells that form no surface,
// which opposite_half_edges() refuses; of several neighbours the last one is taken.
template <class F>
void for_each_edge(const MapFile& map, const F& f) {
  const auto ends = [&](Index h) {
    return std::pair(from_vertex(map.cells, h), to_vertex(map.cells, h));
  };
  const auto sides = 3 * static_cast<Index>(map.cells.rows());
  const PairOrder directed(static_cast<Index>(map.points.rows()), sides, ends);
  for (Index h = 0; h < sides; ++h) {
    const auto [from, to] = ends(h);
    Index beyond = -1;
    for (const auto& [end, other] : directed.of(to))
      if (end == from) beyond = face_of(other);
    f(CellEdge{face_of(h), corner_of(h)}, beyond);
  }
}

// Returns the edges without a neighbour, by their first point.
std::multimap<Index, CellEdge> boundary_edges(const MapFile& map) {
  std::multimap<Index, CellEdge> boundary;
  for_each_edge(map, [&](const CellEdge& edge, Index other) {
    if (other < 0) boundary.emplace(map.cells(edge.cell, edge.edge), edge);
  });
  return boundary;
}

// Returns all edges, each as a separate stroke.
Shape edges_shape(const LayoutSheet& sheet, const std::vector<CellEdge>& edges,
                  const Stroke& stroke) {
  Shape shape{.stroke = stroke};
  for (const CellEdge& at : edges) {
    shape.path.move(sheet.place(sheet.map().cells(at.cell, at.edge)));
    sheet.add_edge(shape.path, sheet.map(), at.cell, at.edge);
  }
  return shape;
}

Path boundary_path(const LayoutSheet& sheet) {
  const MapFile& map = sheet.map();
  Path path;
  std::multimap<Index, CellEdge> boundary = boundary_edges(map);
  while (!boundary.empty()) {
    auto leaving = boundary.begin();
    path.move(sheet.place(leaving->first));
    while (leaving != boundary.end()) {
      const CellEdge at = leaving->second;
      boundary.erase(leaving);
      sheet.add_edge(path, map, at.cell, at.edge);
      leaving = boundary.find(map.cells(at.cell, next(at.edge)));
    }
    path.close();
  }
  return path;
}

// Returns the numbers of cones with positive and negative index; copies count once.
std::pair<std::size_t, std::size_t> count_cones(const MapFile& map) {
  std::set<Index> positive, negative;
  for (Index p = 0; p < map.cone.size(); ++p) {
    if (map.cone[p] == 0) continue;
    const Index vertex = map.input_vertex.size() > 0 ? map.input_vertex[p] : p;
    (map.cone[p] < 4 ? positive : negative).insert(vertex);
  }
  return {positive.size(), negative.size()};
}

// Returns whether the map is an atlas, with different numbers in `chart`.
bool has_charts(const MapFile& map) {
  return map.chart.size() > 0 && map.chart.minCoeff() != map.chart.maxCoeff();
}

double drawn_area(const LayoutSheet& sheet, Index cell) {
  const auto corner = [&](Index k) { return sheet.place(sheet.map().cells(cell, k)); };
  return 0.5 * cross(corner(1) - corner(0), corner(2) - corner(0));
}

// The place of a chart's name: the middle of the cell nearest to the middle of the chart.
struct ChartRoom {
  double area = 0;  // units of the drawing squared
  Vector2 middle = Vector2::Zero(), place = Vector2::Zero();
  double distance = std::numeric_limits<double>::infinity();
};

std::map<Index, ChartRoom> rooms_of_charts(const LayoutSheet& sheet) {
  const MapFile& map = sheet.map();
  std::map<Index, ChartRoom> rooms;
  const auto corner = [&](Index c, Index k) { return sheet.place(map.cells(c, k)); };
  const auto middle = [&](Index c) {
    return Vector2((corner(c, 0) + corner(c, 1) + corner(c, 2)) / 3);
  };
  for (Index c = 0; c < map.cells.rows(); ++c) {
    ChartRoom& room = rooms[map.chart[c]];
    const double area = std::abs(drawn_area(sheet, c));
    room.area += area;
    room.middle += area * middle(c);
  }
  for (Index c = 0; c < map.cells.rows(); ++c) {
    ChartRoom& room = rooms[map.chart[c]];
    const double distance = (middle(c) - room.middle / room.area).norm();
    if (!(distance < room.distance)) continue;
    room.distance = distance;
    room.place = middle(c);
  }
  return rooms;
}

Circle dot(const Vector2& center, double radius, const Color& color) {
  return {.center = center, .radius = radius, .fill = color, .stroke = Stroke{kWhite, 1.5}};
}

Circle ring(const Vector2& center, double radius, const Color& color) {
  return {.center = center, .radius = radius, .stroke = Stroke{color, kTargetWidth}};
}

Shape segment(const Vector2& from, const Vector2& to, const Stroke& stroke) {
  Shape shape{.stroke = stroke};
  shape.path.move(from);
  shape.path.line(to);
  return shape;
}

// Draws cells of one colour and orientation as one shape, so that overlaps wind in the same sense.
// Cells that are turned over come last.
std::vector<DrawingItem> draw_cells(const LayoutSheet& sheet,
                                    const std::optional<CellColors>& colors, CellFill fill) {
  const MapFile& map = sheet.map();
  CellColors shown = colors ? *colors : plain_colors(map);
  if (colors)
    for (const Index cell : sheet.marks().without_area) shown[to_size(cell)] = kNoAreaColor;
  for (const Index cell : sheet.marks().turned_over) shown[to_size(cell)] = kFlippedColor;
  // Without edges, strokes of the cells' own colour close the gaps between cells.
  const bool has_edges = sheet.marks().edges == CellEdges::Drawn;
  if (!has_edges && fill == CellFill::Nothing) return {};
  std::vector<Shape> shapes;
  std::map<std::tuple<int, int, int, bool>, std::size_t> shape_of;
  for (Index cell = 0; cell < map.cells.rows(); ++cell) {
    const Color color = fill == CellFill::Colors ? shown[to_size(cell)] : kInk;
    const auto [found, is_new] = shape_of.try_emplace(
        {color.red, color.green, color.blue, drawn_area(sheet, cell) > 0}, shapes.size());
    if (is_new) {
      Shape shape{.stroke = Stroke{has_edges ? kInk : color, sheet.stroke_width()}};
      if (fill == CellFill::Colors) shape.fill = color;
      shapes.push_back(std::move(shape));
    }
    sheet.add_cell(shapes[found->second].path, map, cell);
  }
  std::stable_partition(shapes.begin(), shapes.end(),
                        [](const Shape& shape) { return shape.fill != kFlippedColor; });
  return {std::make_move_iterator(shapes.begin()), std::make_move_iterator(shapes.end())};
}

// Draws the scaffold, clipped to the area of the layout.
std::vector<DrawingItem> draw_scaffold(const LayoutSheet& sheet) {
  const std::optional<MapFile>& scaffold = sheet.marks().scaffold;
  if (!scaffold) return {};
  Shape shape{.fill = kScaffoldFill, .stroke = Stroke{kScaffoldEdge, sheet.stroke_width()}};
  for (Index cell = 0; cell < scaffold->cells.rows(); ++cell)
    sheet.add_cell(shape.path, *scaffold, cell);
  return {Clipped{
      "drawing", rectangle({0, 0}, {sheet.width(), sheet.layout_height()}), {std::move(shape)}}};
}

// Draws the outline of every chart in its colour.
void add_chart_outlines(const LayoutSheet& sheet, std::vector<DrawingItem>& items) {
  const MapFile& map = sheet.map();
  if (!has_charts(map)) return;
  std::map<Index, std::vector<CellEdge>> outlines;
  for_each_edge(map, [&](const CellEdge& edge, Index other) {
    const Index chart = map.chart[edge.cell];
    if (other < 0 || map.chart[other] != chart) outlines[chart].push_back(edge);
  });
  for (const auto& [chart, edges] : outlines)
    items.emplace_back(edges_shape(sheet, edges, {chart_color(chart), kOutlineWidth}));
}

// Draws the number of every chart (MapFile::chart) inside it, unless it would be too small to read.
void add_chart_names(const LayoutSheet& sheet, std::vector<DrawingItem>& items) {
  if (!has_charts(sheet.map())) return;
  for (const auto& [chart, room] : rooms_of_charts(sheet)) {
    const double size = std::min(kLargestName, kNameShare * std::sqrt(room.area));
    if (size < kSmallestName) continue;
    items.emplace_back(Label{.at = room.place + Vector2(0, 0.35 * size),
                             .text = fmt::format("{}", chart),
                             .size = size,
                             .anchor = Label::Anchor::Middle,
                             .halo = 3});
  }
}

// Returns the axes of the file's u and v in the turned layout, as unit vectors.
Eigen::Matrix2d grid_axes(const LayoutMarks& marks) {
  Eigen::Matrix2d axes;
  axes << marks.direction.x(), marks.direction.y(), -marks.direction.y(), marks.direction.x();
  return axes;
}

// Returns the smallest and the largest number of a grid line along each axis.
std::pair<Vector2, Vector2> grid_range(const LayoutSheet& sheet) {
  Eigen::Matrix<double, 2, 4> corners;
  corners << sheet.low().x(), sheet.high().x(), sheet.low().x(), sheet.high().x(), sheet.low().y(),
      sheet.low().y(), sheet.high().y(), sheet.high().y();
  const Eigen::Matrix<double, 2, 4> uv =
      grid_axes(sheet.marks()).transpose() * corners / sheet.grid_spacing();
  return {uv.rowwise().minCoeff(), uv.rowwise().maxCoeff()};
}

// Draws lines u, v = integer multiples of the spacing, clipped to the layout by winding numbers, so
// that overlaps are harmless.
void add_grid(const LayoutSheet& sheet, std::vector<DrawingItem>& items) {
  const double spacing = sheet.grid_spacing();
  if (spacing == 0) return;
  const auto [low, high] = grid_range(sheet);
  const Eigen::Matrix2d axes = grid_axes(sheet.marks());
  Shape lines{.stroke = Stroke{kGridColor, std::max(1.0, 2 * sheet.stroke_width())}};
  for (int axis = 0; axis < 2; ++axis) {
    const double first = std::ceil(low[axis]), count = std::floor(high[axis]) - first;
    for (double k = 0; k <= count; ++k) {  // far from the origin first + 1 may equal first
      Vector2 from = low * spacing, to = high * spacing;
      from[axis] = to[axis] = (first + k) * spacing;
      lines.path.move(sheet.place(axes * from));
      lines.path.line(sheet.place(axes * to));
    }
  }
  items.emplace_back(Clipped{"layout", boundary_path(sheet), {std::move(lines)}});
}

std::vector<Vector2> unit_square_of(const MapFile& map) {
  if (!is_for_unit_square(map) || map.uv.minCoeff() < 0 || map.uv.maxCoeff() > 1) return {};
  return {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
}

void add_unit_square(const LayoutSheet& sheet, std::vector<DrawingItem>& items) {
  const std::vector<Vector2>& corners = sheet.marks().unit_square;
  if (corners.empty()) return;
  Shape square{.stroke = Stroke{kSquareColor, kSquareWidth}};
  square.path.move(sheet.place(corners.front()));
  for (std::size_t k = 1; k < corners.size(); ++k) square.path.line(sheet.place(corners[k]));
  square.path.close();
  items.emplace_back(std::move(square));
}

// Draws both sides of every seam edge, one colour a chain.
void add_seams(const LayoutSheet& sheet, std::vector<DrawingItem>& items) {
  const MapFile& map = sheet.map();
  std::map<Index, std::vector<CellEdge>> chains;
  for (Index f = 0; f < map.seam_edges.rows(); ++f)
    for (int k = 0; k < 3; ++k)
      if (map.seam_edges(f, k) > 0) chains[map.seam_edges(f, k) - 1].push_back({f, k});
  for (const auto& [chain, edges] : chains)
    items.emplace_back(edges_shape(sheet, edges, {chart_color(chain), kSeamWidth}));
}

// Draws a dot on every copy of a cone.
void add_cones(const LayoutSheet& sheet, std::vector<DrawingItem>& items) {
  const MapFile& map = sheet.map();
  for (Index p = 0; p < map.cone.size(); ++p)
    if (map.cone[p] > 0)
      items.emplace_back(dot(sheet.place(p), kConeRadius, cone_color(map.cone[p])));
}

Color color_of(PagePoint::Hold hold) {
  return hold == PagePoint::Hold::Pin ? kPinColor : kHandleColor;
}

// Draws every copy of a held or pulled point, its target, and a line between them.
void add_points(const LayoutSheet& sheet, std::vector<DrawingItem>& items) {
  const MapFile& map = sheet.map();
  if (map.input_vertex.size() == 0) return;
  std::map<Index, std::set<Index>> copies;
  for (const Index point : map.cells.leftCols(3).reshaped())
    copies[map.input_vertex[point]].insert(point);
  for (const PagePoint& point : sheet.marks().points) {
    const Color color = color_of(point.hold);
    const Vector2 target = sheet.place(point.target);
    if (copies.count(point.vertex) > 0 && point.hold == PagePoint::Hold::Handle)
      items.emplace_back(ring(target, kTargetRadius, color));
    for (const Index copy : copies[point.vertex]) {
      items.emplace_back(segment(sheet.place(copy), target, {color, kTargetWidth}));
      items.emplace_back(dot(sheet.place(copy), kHeldRadius, color));
    }
  }
}

void add_meeting(const LayoutSheet& sheet, std::vector<DrawingItem>& items) {
  for (const Vector2& uv : sheet.marks().meeting.places)
    items.emplace_back(Circle{.center = sheet.place(uv),
                              .radius = kMeetingRadius,
                              .stroke = Stroke{kMeetingColor, kSeamWidth}});
}

// Returns signs, each with its middle at the origin.
std::vector<LegendMark> legend_marks(const LayoutSheet& sheet) {
  const MapFile& map = sheet.map();
  const LayoutMarks& marks = sheet.marks();
  const double spacing = sheet.grid_spacing();
  const auto line = [&](const Color& color) {
    return std::vector<DrawingItem>{segment({-kHalfSign, 0}, {kHalfSign, 0}, {color, kSeamWidth})};
  };
  std::vector<LegendMark> entries;
  const auto [positive, negative] = count_cones(map);
  for (const auto& [count, turns, text] :
       {std::tuple{positive, 3, "index > 0"}, std::tuple{negative, 5, "index < 0"}})
    if (count > 0)
      entries.push_back({{dot({0, 0}, kConeRadius, cone_color(turns))},
                         fmt::format("{} cone{}, {}", count, count == 1 ? "" : "s", text)});
  if (map.seam_edges.size() > 0 && map.seam_edges.maxCoeff() > 0)
    entries.push_back(
        {line(chart_color(0)), fmt::format("seams ({} chains)", map.seam_edges.maxCoeff())});
  if (spacing > 0) entries.push_back({line(kGridColor), fmt::format("grid {:.6g}", spacing)});
  for (const auto& [hold, one] :
       {std::pair{PagePoint::Hold::Pin, "pin"}, std::pair{PagePoint::Hold::Handle, "handle"}}) {
    const auto count = std::count_if(marks.points.begin(), marks.points.end(),
                                     [&](const PagePoint& p) { return p.hold == hold; });
    std::vector<DrawingItem> sign{dot({0, 0}, kHeldRadius, color_of(hold))};
    if (hold == PagePoint::Hold::Handle)
      sign.insert(sign.begin(), ring({0, 0}, kTargetRadius, kHandleColor));
    if (count > 0)
      entries.push_back({sign, fmt::format("{} {}{}{}", count, one, count == 1 ? "" : "s",
                                           hold == PagePoint::Hold::Handle ? ", targets" : "")});
  }
  if (marks.scaffold)
    entries.push_back(
        {{Shape{.path = rectangle({-kHalfSign, -kHalfSign}, {2 * kHalfSign, 2 * kHalfSign}),
                .fill = kScaffoldFill,
                .stroke = Stroke{kScaffoldEdge, 1}}},
         "space around"});
  if (!marks.turned_over.empty())
    entries.push_back(turned_over_mark(
        marks.turned_over.size(), sheet.colors() ? LegendAbove::Colors : LegendAbove::Nothing));
  if (!marks.without_area.empty())
    entries.push_back(without_area_mark(
        marks.without_area.size(), sheet.colors() ? LegendAbove::Colors : LegendAbove::Nothing));
  if (!marks.meeting.words.empty())
    entries.push_back({{Circle{.center = {0, 0},
                               .radius = kMeetingRadius,
                               .stroke = Stroke{kMeetingColor, kSeamWidth}}},
                       marks.meeting.words});
  return entries;
}

std::string description_of(const LayoutSheet& sheet) {
  const MapFile& map = sheet.map();
  std::string text = fmt::format("{} triangles of degree {}", map.cells.rows(), map.degree);
  if (const std::optional<Legend>& legend = sheet.colors())
    text += fmt::format(", coloured by {}: {}", legend->title, legend->note);
  for (const LegendMark& mark : legend_marks(sheet)) text += "; " + mark.text;
  return text;
}

}  // namespace

Color cone_color(int quarter_turns) {
  return quarter_turns < 4 ? Color{26, 95, 208} : Color{11, 138, 58};
}

CellColors plain_colors(const MapFile& map) {
  CellColors colors(to_size(static_cast<Index>(map.cells.rows())), kGrey);
  if (!has_charts(map)) return colors;
  const auto pale = [](std::uint8_t channel) {
    return static_cast<std::uint8_t>(std::lround(255 + kTint * (channel - 255)));
  };
  for (Index cell = 0; cell < map.cells.rows(); ++cell) {
    const Color color = chart_color(map.chart[cell]);
    colors[to_size(cell)] = {pale(color.red), pale(color.green), pale(color.blue)};
  }
  return colors;
}

LayoutMeeting meeting_of(const MapFile& map) {
  if ((map.cone.size() > 0 && map.cone.maxCoeff() > 0) ||
      (map.seam_edges.size() > 0 && map.seam_edges.maxCoeff() > 0))
    return {};
  try {
    const GlobalInjectivity proof = check_boundary(to_bezier_map(map, "layout"));
    if (proof.result != ProofStatus::Violated) return {};
    LayoutMeeting meeting{{}, meeting_words(proof)};
    for (const BoundaryContact& contact : proof.contacts)
      if (contact.apart == ProofStatus::Violated) meeting.places.push_back(contact.where);
    if (meeting.places.empty() && proof.covered_twice)
      meeting.places.push_back(*proof.covered_twice);
    return meeting;
  } catch (const Error&) {  // the cells form no surface
    return {};
  }
}

LayoutMarks marks_of(const MapFile& map, const Vector2& direction,
                     const std::optional<double>& grid, const std::optional<MapFile>& scaffold,
                     const std::vector<PagePoint>& points) {
  LayoutMarks marks{.grid = grid, .direction = direction, .points = points};
  for (PagePoint& point : marks.points) point.target = turned(point.target, direction);
  if (scaffold) marks.scaffold = turned(*scaffold, direction);
  for (const Vector2& corner : unit_square_of(map))
    marks.unit_square.push_back(turned(corner, direction));
  marks.meeting = meeting_of(map);
  for (Vector2& uv : marks.meeting.places) uv = turned(uv, direction);
  marks.turned_over = turned_over_cells(map);
  marks.without_area = cells_without_area(map);
  return marks;
}

double round_spacing(double least) {
  if (!(least > 0)) return 0;
  const double power = std::pow(10.0, std::floor(std::log10(least)));
  for (const double digit : {1.0, 2.0, 5.0})
    if (digit * power >= least) return digit * power;
  return 10 * power;
}

LayoutSheet::LayoutSheet(const MapFile& map, const LayoutMarks& marks, const Format& format)
    : map_(map), marks_(marks), width_(format.width) {
  low_ = map.uv.colwise().minCoeff().transpose();
  high_ = map.uv.colwise().maxCoeff().transpose();
  for (const Vector2& corner : marks.unit_square) {
    low_ = low_.cwiseMin(corner);
    high_ = high_.cwiseMax(corner);
  }
  for (const PagePoint& point : marks.points) {
    low_ = low_.cwiseMin(point.target);
    high_ = high_.cwiseMax(point.target);
  }
  if (marks.grid) grid_spacing_ = *marks.grid != 0 ? *marks.grid : round_spacing(half_size() / 20);
  if (grid_spacing_ != 0) {
    const auto [first, last] = grid_range(*this);
    if (!(grid_spacing_ > 0) || !((last - first).maxCoeff() <= kMaxLines))
      throw Error(ErrorKind::Usage,
                  fmt::format("a grid of spacing {:g} on a layout of size {:g} cannot be drawn; "
                              "take a spacing between them",
                              grid_spacing_, 2 * half_size()));
  }
  colors_ = format.colors;
  if (marks.legends == Legends::Drawn)
    legends_ = DrawnLegends(colors_, legend_marks(*this), width_);
  const double legends = legends_.height();
  const std::optional<double>& height = format.height;
  // Halved, since the extent of two finite numbers may overflow.
  const Vector2 extent = (0.5 * high_ - 0.5 * low_).cwiseMax(1e-300);
  const double tallest = height ? std::max(*height - legends - 2 * kMargin, kMargin) : kTallest;
  scale_ = std::min(std::max(width_ - 2 * kMargin, kMargin) / extent[0], tallest / extent[1]);
  if (format.scale) scale_ = std::min(scale_, 2 * *format.scale);
  layout_height_ = height ? *height - legends : scale_ * extent[1] + 2 * kMargin;
  height_ = height ? *height : std::round(layout_height_ + legends);
  corner_ = {kMargin, kMargin};
  if (height || format.scale) corner_ = 0.5 * (Vector2(width_, layout_height_) - scale_ * extent);
  for (int edge = 0; edge < 3; ++edge) edges_[to_size(edge)] = bezier_edge_points(map.degree, edge);
}

double LayoutSheet::stroke_width() const {
  const double area = width_ * layout_height_ / static_cast<double>(map_.cells.rows());
  return std::clamp(0.02 * std::sqrt(std::max(area, 0.0)), 0.05, 1.0);
}

// Differences are halved like the extent.
Vector2 LayoutSheet::place(const Vector2& uv) const {
  return corner_ + scale_ * Vector2(0.5 * uv[0] - 0.5 * low_[0], 0.5 * high_[1] - 0.5 * uv[1]);
}

void LayoutSheet::add_edge(Path& path, const MapFile& map, Index cell, int edge) const {
  std::vector<Vector2> control;
  for (const int local : edges_[to_size(edge)])
    control.push_back(place(Vector2(map.uv.row(map.cells(cell, local)))));
  if (map.degree == 1) return path.line(control[1]);
  if (map.degree == 2) return path.quadratic(control[1], control[2]);
  if (map.degree == 3) return path.cubic(control[1], control[2], control[3]);
  add_hermite_pieces(path, control);
}

void LayoutSheet::add_cell(Path& path, const MapFile& map, Index cell) const {
  path.move(place(Vector2(map.uv.row(map.cells(cell, 0)))));
  const int edges = map.degree == 1 ? 2 : 3;  // the last straight edge is implied by closing the
                                              // path
  for (int edge = 0; edge < edges; ++edge) add_edge(path, map, cell, edge);
  path.close();
}

LayoutDrawing draw_layout(const LayoutSheet& sheet, const std::optional<CellColors>& colors,
                          CellFill fill) {
  LayoutDrawing drawing;
  drawing.behind = draw_scaffold(sheet);
  add_unit_square(sheet, drawing.behind);
  drawing.cells = draw_cells(sheet, colors, fill);
  if (sheet.marks().edges == CellEdges::Left)
    drawing.over.emplace_back(
        Shape{.path = boundary_path(sheet), .stroke = Stroke{kInk, kOutlineWidth}});
  add_grid(sheet, drawing.over);
  add_chart_outlines(sheet, drawing.over);
  add_seams(sheet, drawing.over);
  add_cones(sheet, drawing.over);
  add_points(sheet, drawing.over);
  add_meeting(sheet, drawing.over);
  add_chart_names(sheet, drawing.over);
  for (DrawingItem& item : sheet.legends().items(sheet.layout_height(), sheet.height()))
    drawing.over.push_back(std::move(item));
  drawing.description = description_of(sheet);
  return drawing;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
