// Pictures of maps: the layout as an exact vector drawing (SVG), layout or surface as pixels (PNG),
// and both side by side as a page for a browser, with the film of a run.
//
//   const MapFile map = read_map("bunny.vtu");
//   write_svg("bunny.svg", map);
//   write_png("bunny.png", map);
//
// Pictures promise nothing; numbers that others compute with belong into a .vtu (io/io.h).
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "majorant/maps/map_file.h"
#include "majorant/maps/map_options.h"

namespace majorant {

// Pointwise, of singular values sigma_1 >= sigma_2 of the map from the surface to the plane, in
// units in which an isometry has 1 and 1: density of an energy, area sigma_1 sigma_2, angle sigma_1
// / sigma_2, and the two themselves.
enum class Quantity { Density, Area, Angle, SigmaMax, SigmaMin };
inline constexpr std::array kQuantities{Quantity::Density, Quantity::Area, Quantity::Angle,
                                        Quantity::SigmaMax, Quantity::SigmaMin};
// "density", "area", "angle", "sigma-max", "sigma-min".
std::string_view quantity_name(Quantity quantity);

// Always: pictures and pages show the layout turned so that the longer side of the smallest
// rectangle around it lies horizontally. Automatic: the same where nothing holds it as it is, as
// far as the map's claims tell: no pins, handles, seams or charts, and no deformation. Files keep
// their coordinates either way.
enum class Alignment { Automatic, Always, Never };

struct ColorRange {
  double low = 0, high = 1;  // as ColorScale::with_range() has them
};

// A vertex that was held or pulled: drawn at every copy of it, with a line to its target.
struct PagePoint {
  enum class Hold { Pin, Handle };  // exactly there; pulled there

  Index vertex = 0;  // of the input, as MapFile::input_vertex counts them
  Vector2 target;    // in the units of the map's uv
  Hold hold = Hold::Pin;
};

// What a picture lies on: a transparent one shows what is behind it.
enum class Paper { White, None };

// Whether the edges of cells are drawn; without them the boundary of the layout is.
enum class CellEdges { Drawn, Left };

// Whether a picture has legends; without them it has no room for any.
enum class Legends { Drawn, Left };

// Of a vector drawing, px.
struct SheetSize {
  int width = 1000, height = 800;  // PngOptions::kSmallest to kLargest
};

// The layout of a map as a vector drawing: what to look at, and to put into a paper.

struct SvgOptions {
  // Grid lines at integer multiples of this in u and v (uv units of the file); 0: the least of 1, 2
  // and 5 times a power of ten that is at least a 40th of the layout's larger side; none: no grid.
  std::optional<double> grid = std::nullopt;
  // The space around the map (to_map_file of a BezierMesh), of its degree: drawn pale behind it, as
  // far as the drawing reaches.
  std::optional<MapFile> scaffold = std::nullopt;
  // The quantity that colours the triangles, by its mean over each; none: the density, where the
  // map has it and names its energy.
  std::optional<Quantity> quantity = std::nullopt;
  // None: the fixed range of the quantity's scale.
  std::optional<ColorRange> color_range = std::nullopt;
  Alignment alignment = Alignment::Automatic;
  std::vector<PagePoint> points = {};  // held and pulled ones, with their targets
  Paper paper = Paper::White;
  // None: 1000 wide, as high as it takes. Letters, lines and marks have the same px on any sheet,
  // and so are a larger part of a smaller one: 24 px letters of a sheet 700 wide are 8 points high
  // in a column of 84 mm.
  std::optional<SheetSize> size = std::nullopt;
  CellEdges edges = CellEdges::Drawn;
  Legends legends = Legends::Drawn;
};

// One <path> per colour, of the curved boundaries of its cells: lines for degree 1, quadratic and
// cubic Bezier curves for 2 and 3, exactly; higher degrees as four Hermite cubics an edge. The v
// axis points up. Without a size the drawing is 1000 wide and fits the control points (a layout
// more than 4 times as tall as wide is 4000 high instead); coordinates have 6 digits of the
// drawing's size. <title> and <desc> say what it is of.
//
// Cells are filled by `distortion`, the mean density of the energy that the map's claims name, on
// the fixed scale of that energy (docs/pictures.md): pictures of different maps can be compared.
// The legend names energy, degree and isometry, the smallest and the largest value on the map (not
// of the means that are drawn; as MapMeasures::max_density), and how many means are beyond the
// scale. Without both the cells are grey, or in pale colours by chart. Cells that are turned over
// have kFlippedColor and lie over all others; their number is in the second legend, and no number
// of the first one counts them. The output depends on nothing but the map and the options.
//
// Behind the cells: the unit square, of layouts that lie in it and were made for it (claimed to be
// normalized, or without claims). Over them: grid lines if asked for, cut off at the layout's
// boundary; where the map has several charts, thin outlines in one colour a chart, and its number
// where there is room; where it has seams, thick lines along both sides of them in one colour a
// chain, and dots on the cones, blue for index > 0 and green for index < 0; points and lines to
// their targets; rings where boundary edges meet; a second legend. Throws Error(Invalid) if the map
// is inconsistent or not finite, Error(Usage) if the file cannot be written, the grid cannot be
// drawn, a side of the sheet is out of range or less than its legends take, whose lines are broken
// to its width, or the range of colours leaves out the isometry.
void write_svg(const std::string& path, const MapFile& map, const SvgOptions& options = {});
// The drawing as text, for who has a place for it already. Throws Error(Invalid) likewise.
std::string svg_text(const MapFile& map, const SvgOptions& options = {});

// Two maps of one surface side by side, for figures that compare: at one scale, that of the surface
// (uv over the claimed layout_scale), on one range of colours, with one legend of these;
// below each its caption, its degree, and the smallest and the largest value on it.
//
//   const MapPair pair{{{read_map("a.vtu"), "a.vtu"}, {read_map("b.vtu"), "b.vtu"}}};
//   write_svg("ab.svg", pair);

struct CaptionedMap {
  MapFile map;
  std::string caption;                 // broken where it is too wide
  std::vector<PagePoint> points = {};  // in place of SvgOptions::points
};
using MapPair = std::array<CaptionedMap, 2>;

// Densities of both are of the energy that the first one names, whatever the second was made with.
// No scaffold is drawn. Throws as for one map, and what to_bezier_map() does of a map whose density
// the file does not have.
void write_svg(const std::string& path, const MapPair& pair, const SvgOptions& options = {});
std::string svg_text(const MapPair& pair, const SvgOptions& options = {});

// A map as a picture of pixels: the layout, or the surface with what the map lays on it. A layout
// has all that write_svg() draws, from one description, so that the two cannot differ; lines and
// letters are as large a part of it as there. Only colours are those of pixels, not of cells, and
// images have no edges on them.
//
//   write_png("layout.png", file);
//   PngOptions options;
//   options.view = Vector3(1, 0.5, 2);                    // from there: the surface, checkered
//   options.quantity = Quantity::Area;                    // or coloured by its distortion
//   write_png("surface.png", file, options);
//
// Every sample of every pixel (3 by 3) finds the cell it is in and the place there and evaluates
// the Bezier triangle and its Jacobian at it: no straight triangles in between, and heat maps vary
// inside of cells. The page of write_page() does the same in a browser; with the conventions below
// both show the same.
//
//     * Camera: orthographic. `view` points from the surface to the eye; the y axis is up in the
//       picture (the z axis where `view` is closer than 3 degrees to it). What is seen is in the
//       middle and as large as it fits, a surface with a margin of 2 % of the smaller side.
//     * Light comes from the eye: sRGB values times 0.72 + 0.28 |cos| of its angle with the normal,
//       which is interpolated between those of corners, means of the faces around them by area.
//     * Checkerboard: squares of 1, 2 or 5 times a power of ten uv units, at least a 40th of the
//       layout's larger side, edges on multiples of that; or `squares` along the side of the square
//       that an image lies on.
//     * Grid: on the surface lines whose width is a twelfth of their distance.
//     * Image: upright over the unit square of layouts that were made for one (claimed to be
//       normalized, or without claims), over the square around the middle of others that has their
//       larger side; bilinear, and repeated beyond it.
//
// Not for what is to be measured or magnified: write_svg() and write_page() keep curves.

struct PngOptions {
  static constexpr int kSmallest = 16, kLargest = 8192;  // pixels on a side

  int width = 1000, height = 800;
  std::optional<Vector3> view = {};       // none: the layout
  std::optional<Quantity> quantity = {};  // none: see image
  // The bytes of a PNG file that is laid on; none: a checkerboard on a surface, the density (grey
  // where the claims name no energy) on a layout.
  std::optional<std::string> image = {};
  std::optional<int> squares = {};             // of the checkerboard, at least 1; none: see above
  std::optional<ColorRange> color_range = {};  // none: that of the fixed scale
  Alignment alignment = Alignment::Automatic;
  std::optional<double> grid = {};       // as of SvgOptions; over colours and images
  std::optional<MapFile> scaffold = {};  // around a layout, as of SvgOptions
  std::vector<PagePoint> points = {};    // likewise
  Paper paper = Paper::White;
  CellEdges edges = CellEdges::Drawn;  // of a layout
  Legends legends = Legends::Drawn;
};

// Heat maps have a legend below, as SVG's, with the same smallest and largest value, those of the
// whole map. Turned over cells have kFlippedColor but under an image, where they are turned over;
// they lie over others, and are counted as in SVG. The bytes depend on the map and the options
// alone, not on the number of threads. Throws Error(Invalid) if the map is inconsistent or not
// finite, Error(Unreadable) for an image that is none, Error(Usage) for a size out of range or so
// low that legends leave no room, no squares, a view that is no direction, a range without the
// isometry, a density whose energy is not named, and where the file cannot be written.
void write_png(const std::string& path, const MapFile& map, const PngOptions& options = {});

// A map as a page for a browser: the surface in 3D and the layout side by side, exact, in one file.
//
//   MapPage page;
//   page.title = "creature.obj";
//   page.map = read_map("creature.vtu");
//   page.points = {{.vertex = 12, .target = Vector2(0.5, 0.25), .hold = PagePoint::Hold::Pin}};
//   write_page("creature.html", page);
//
// The page holds the control points and evaluates the Bezier triangles itself, for every pixel: a
// texture, distortion in the words of maps/distortion.h on fixed scales, the
// straight map of the same corners, what the mouse points at. It asks nobody for anything: no
// network, no other file. docs/web_page.md says what it shows and what its data look like.
//
// A picture, not data: numbers that others compute with belong into a .vtu.

// A cell of which something is not true.
struct PageFault {
  Index cell = 0;
  std::string text;  // one line: what is wrong with it
};

// The map as it was during the run.
struct PageSnapshot {
  int iteration = 0;
  int degree = 1;  // of the run at that time
  double energy = 0;
  Points2 uv;  // #N by 2, in the numbering, the degree (elevated) and the units of MapPage::map
};

struct MapPage {
  std::string title;  // what is mapped, a file name say
  MapFile map;        // degree 1 to 8; it may be invalid, but must be finite
  std::optional<MapFile> scaffold =
      std::nullopt;  // the space around the image, of the map's degree
  std::vector<PagePoint> points = {};
  std::vector<PageFault> faults = {};  // listed in this order
  // A JSON object: what is known of the map, as in reports. Shown are `status`, `command`,
  // `message`, the numbers of `result` and `distortion`, `proofs` and `findings`, where these are.
  std::string facts = "{}";
  Alignment alignment = Alignment::Automatic;  // of the layout as it is shown
  // The quantity that is shown first; none: a checkered texture, or the density where color_range
  // is given.
  std::optional<Quantity> quantity = std::nullopt;
  // The range of colours of that quantity; none: the fixed one of its scale.
  std::optional<ColorRange> color_range = std::nullopt;
  // Snapshots in the order of their iterations. The page keeps them in single precision, 8 bytes a
  // control point each.
  std::vector<PageSnapshot> snapshots = {};
  // A second map of the same surface, its cells those of this one: the page shows both side by
  // side, and the difference of their densities. Not its scaffold, nor what it would compare with.
  std::shared_ptr<const MapPage> other = {};
};

// Texts may hold any bytes; what is not UTF-8 is shown as U+FFFD. Energy and scale of the layout
// are those of the map's claims. The output depends on nothing but `page`.
// Throws Error(Invalid) if the map is inconsistent, not finite or of a degree above 8, or if
// points, faults or snapshots do not belong to it, Error(Usage) if the file cannot be written or
// the range leaves out the isometry.
void write_page(const std::string& path, const MapPage& page);

// The maps that a run goes through, every few iterations, for the page that shows them.
//
//   Film film(5, options.map.degree);
//   options.solve.watch = film.watcher();
//   RunRecord record;
//   const ParametrizationResult result = parametrize(mesh, options, record);
//   MapPage page;
//   page.map = to_map_file(*result.map);
//   page.snapshots = film.frames(
//       {*result.map, last_iteration(record.trace()), result.value_quadrature});
//
// Memory is bounded: frames are counted as the page holds them, 8 bytes a control point at the
// degree of the result. When one more would not fit, every second one goes, and from then on only
// every second one is taken. The start, iteration 0, is always one of them.
class Film {
 public:
  // The memory that all frames may take: 46 frames of 10,000 cubic triangles.
  static constexpr std::size_t kMostBytes = std::size_t{1} << 24;

  struct Frame {
    BezierMap map;
    int iteration = 0;
    double energy = 0;
  };

  // every: iterations from frame to frame, at least 1. degree: of the result.
  Film(int every, int degree, std::size_t most_bytes = kMostBytes)
      : every_(every), degree_(degree), most_bytes_(most_bytes) {}

  // For SolveOptions::watch; the film outlives it.
  MapObserver watcher();
  int every() const { return every_; }  // now
  // The number of frames that frames() gives for a result of that iteration.
  std::size_t count(int last_iteration) const;
  // The frames and, as the last one, the result, elevated to its degree, by rising iterations.
  std::vector<PageSnapshot> frames(const Frame& result) const;

 private:
  static bool is_before(const Frame& frame, int last_iteration);
  void take(const TraceEntry& row, const MapView& at);

  int every_, degree_;
  std::size_t most_bytes_, frame_bytes_ = 0;
  std::vector<Frame> frames_;
};

// The iteration of the last row, 0 where there is none.
int last_iteration(const std::vector<TraceEntry>& trace);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
