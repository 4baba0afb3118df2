// Pictures of maps: the layout as an exact vector drawing (SVG), layout or surface as pixels (PNG),
// and both side by side as a page for a browser, with snapshots of the run.
//
//   const MapFile map = read_map("bunny.vtu");
//   write_svg("bunny.svg", map);
//   write_png("bunny.png", map);
//
// Pictures make no claims; use a .vtu for numbers in further computations (io/io.h).
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

// The quantities of pictures. They are pointwise functions of singular values sigma_1 >= sigma_2 of
// the map from the surface to the plane, scaled so that an isometry has 1 and 1: density of an
// energy, area sigma_1 sigma_2, angle sigma_1 / sigma_2, and the two themselves.
enum class Quantity { Density, Area, Angle, SigmaMax, SigmaMin };
inline constexpr std::array kQuantities{Quantity::Density, Quantity::Area, Quantity::Angle,
                                        Quantity::SigmaMax, Quantity::SigmaMin};
// Returns "density", "area", "angle", "sigma-max" or "sigma-min".
std::string_view quantity_name(Quantity quantity);

// Always: pictures and pages show the layout turned so that the longer side of its smallest
// bounding rectangle is horizontal. Automatic: the same if the map's claims do not hold it in
// place: no pins, handles, seams or charts, and no deformation. Coordinates in files do not change.
enum class Alignment { Automatic, Always, Never };

struct ColorRange {
  double low = 0, high = 1;  // see ColorScale::with_range()
};

// A vertex that was held or pulled. Every copy of it is drawn, with a line to its target.
struct PagePoint {
  enum class Hold { Pin, Handle };  // held exactly; pulled

  Index vertex = 0;  // of the input, see MapFile::input_vertex
  Vector2 target;    // in the units of the map's uv
  Hold hold = Hold::Pin;
};

// The background of a picture; without paper it is transparent.
enum class Paper { White, None };

// The drawing of edges: those of all cells, or only the boundary of the layout.
enum class CellEdges { Drawn, Left };

// The legends of a picture, which need room: drawn, or left out.
enum class Legends { Drawn, Left };

// The size of a vector drawing in px.
struct SheetSize {
  int width = 1000, height = 800;  // PngOptions::kSmallest to kLargest
};

// Options of a vector drawing of a layout.

struct SvgOptions {
  // The spacing of grid lines at integer multiples in u and v (uv units of the file). 0: the least
  // of 1, 2 and 5 times a power of ten that is at least a 40th of the layout's larger side; none:
  // no grid.
  std::optional<double> grid = std::nullopt;
  // The space around the map (to_map_file of a BezierMesh), of the same degree: drawn pale behind
  // it, as far as the drawing reaches.
  std::optional<MapFile> scaffold = std::nullopt;
  // The quantity that colours the triangles, by its mean over each; none: the density, if the map
  // has it and names its energy.
  std::optional<Quantity> quantity = std::nullopt;
  // None: the fixed range of the quantity's scale.
  std::optional<ColorRange> color_range = std::nullopt;
  Alignment alignment = Alignment::Automatic;
  std::vector<PagePoint> points = {};  // held and pulled ones, with their targets
  Paper paper = Paper::White;
  // None: 1000 wide, as high as needed. Letters, lines and marks have the same size in px on any
  // sheet, so that they are a larger part of a smaller one. For example, 24 px letters of a sheet
  // 700 wide are 8 points high in a column of 84 mm.
  std::optional<SheetSize> size = std::nullopt;
  CellEdges edges = CellEdges::Drawn;
  Legends legends = Legends::Drawn;
};

// Writes one <path> per colour, of the curved boundaries of its cells. They are exact for degrees 1
// to 3, as lines, quadratic and cubic Bezier curves; for higher degrees there are four Hermite
// cubics an edge. The v axis points up. Without a size the drawing is 1000 wide and fits the
// control points (a layout more than 4 times as tall as wide is 4000 high instead). Coordinates
// have 6 digits of the drawing's size. <title> and <desc> describe it.
//
// Cells are coloured by `distortion`, the mean density of the energy that the map's claims name, on
// the fixed scale of that energy (docs/pictures.md), so that pictures of different maps can be
// compared. The legend names energy, degree and isometry. It also has the smallest and the largest
// value on the map (as MapMeasures::max_density, not of the means that are drawn), and the number
// of means beyond the scale. Without distortion and energy the cells are grey, or in pale colours
// by chart. Cells that are turned over have kFlippedColor and lie over all others. The second
// legend has their number, and the first one does not count them. The output depends only on the
// map and the options.
//
// Behind the cells is the unit square, for layouts that lie in it and were made for it (they claim
// to be normalized, or claim nothing). Over the cells are the grid lines, clipped to the layout.
// Several charts have thin outlines in one colour a chart, and numbers where there is room. Seams
// have thick lines along both sides in one colour a chain. There are dots on cones, blue for index
// > 0 and green for index < 0; points and lines to their targets; rings where boundary edges meet;
// a second legend. Throws Error(Invalid) if the map is inconsistent or not finite. Throws
// Error(Usage) if the file cannot be written, if the grid cannot be drawn, if a side of the sheet
// is out of range or too small for its legends, or if the range of colours excludes the isometry.
void write_svg(const std::string& path, const MapFile& map, const SvgOptions& options = {});
// Returns the drawing as text. Throws the same Error(Invalid).
std::string svg_text(const MapFile& map, const SvgOptions& options = {});

// Draws two maps of one surface side by side, for comparisons. They have one scale,
// that of the surface (uv over the claimed layout_scale), one range of colours and one legend.
// Below each are its caption, its degree, and the smallest and the largest value on it.
//
//   const MapPair pair{{{read_map("a.vtu"), "a.vtu"}, {read_map("b.vtu"), "b.vtu"}}};
//   write_svg("ab.svg", pair);

struct CaptionedMap {
  MapFile map;
  std::string caption;                 // broken if it is too wide
  std::vector<PagePoint> points = {};  // replaces SvgOptions::points
};
using MapPair = std::array<CaptionedMap, 2>;

// Densities of both are of the energy that the first map names. No scaffold is drawn. Throws the
// errors for one map, and those of to_bezier_map() for a map whose file lacks the density.
void write_svg(const std::string& path, const MapPair& pair, const SvgOptions& options = {});
std::string svg_text(const MapPair& pair, const SvgOptions& options = {});

// Draws a map as pixels: the layout, or the surface with a texture by the map. A layout shows the
// same drawing as write_svg(), with lines and letters of the same relative size. Only colours are
// per pixel instead of per cell, and images have no edges over them.
//
//   write_png("layout.png", file);
//   PngOptions options;
//   options.view = Vector3(1, 0.5, 2);                    // the surface, with a checkerboard
//   options.quantity = Quantity::Area;                    // coloured by distortion instead
//   write_png("surface.png", file, options);
//
// Every sample of every pixel (3 by 3) finds its cell and place, and evaluates the Bezier triangle
// and its Jacobian there. There are no straight triangles in between, and colours vary inside of
// cells. The page of write_page() does the same in a browser; with the conventions below both look
// the same.
//
//     * Camera: orthographic. `view` points from the surface to the eye. The y axis is up in the
//       picture (the z axis if `view` is closer than 3 degrees to y). The visible part is in the
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
// Not for measuring or magnifying; write_svg() and write_page() keep curves.

struct PngOptions {
  static constexpr int kSmallest = 16, kLargest = 8192;  // pixels on a side

  int width = 1000, height = 800;
  std::optional<Vector3> view = {};       // none: the layout
  std::optional<Quantity> quantity = {};  // none: see image
  // The bytes of a PNG file that is the texture; none: a checkerboard on a surface, the density
  // (grey if the claims name no energy) on a layout.
  std::optional<std::string> image = {};
  std::optional<int> squares = {};             // of the checkerboard, at least 1; none: see above
  std::optional<ColorRange> color_range = {};  // none: that of the fixed scale
  Alignment alignment = Alignment::Automatic;
  std::optional<double> grid = {};       // see SvgOptions; over colours and images
  std::optional<MapFile> scaffold = {};  // around a layout, see SvgOptions
  std::vector<PagePoint> points = {};    // see SvgOptions
  Paper paper = Paper::White;
  CellEdges edges = CellEdges::Drawn;  // for layouts
  Legends legends = Legends::Drawn;
};

// Colours have a legend as in SVG, with the same smallest and largest value over the whole map.
// Cells that are turned over have kFlippedColor, except under an image, lie over others, and are
// counted as in SVG. The bytes depend on the map and the options alone, not on the number of
// threads. Throws Error(Invalid) if the map is inconsistent or not finite, and Error(Unreadable)
// for an image that is not a PNG. Throws Error(Usage) for a size out of range or too small for
// legends, for no squares, for a zero view, for a range without the isometry, for a density without
// a named energy, and if the file cannot be written.
void write_png(const std::string& path, const MapFile& map, const PngOptions& options = {});

// Writes a map as a page for a browser: the surface in 3D and the layout side by side, exact, in
// one file.
//
//   MapPage page;
//   page.title = "creature.obj";
//   page.map = read_map("creature.vtu");
//   page.points = {{.vertex = 12, .target = Vector2(0.5, 0.25), .hold = PagePoint::Hold::Pin}};
//   write_page("creature.html", page);
//
// The page holds the control points and evaluates the Bezier triangles for every pixel: a texture,
// distortions (maps/distortion.h) on fixed scales, the straight map with the same corners, the
// place under the mouse. It needs neither a network nor other files. docs/pictures.md describes its
// contents and its data.
//
// A picture, not data: use a .vtu for numbers in further computations.

// A cell with a defect.
struct PageFault {
  Index cell = 0;
  std::string text;  // one line about the defect
};

// The map at an iteration of the run.
struct PageSnapshot {
  int iteration = 0;
  int degree = 1;  // of the run at that iteration
  double energy = 0;
  Points2 uv;  // #N by 2, in the numbering, the (elevated) degree and the units of MapPage::map
};

struct MapPage {
  std::string title;  // for example the name of the input
  MapFile map;        // degree 1 to 8; it may be invalid, but must be finite
  std::optional<MapFile> scaffold =
      std::nullopt;  // the space around the image, of the map's degree
  std::vector<PagePoint> points = {};
  std::vector<PageFault> faults = {};  // listed in this order
  // A JSON object in the form of reports. The page shows `status`, `command`, `message`, the
  // numbers of `result` and `distortion`, `proofs` and `findings`, if present.
  std::string facts = "{}";
  Alignment alignment = Alignment::Automatic;  // of the shown layout
  // The quantity that is shown first; none: a checkerboard, or the density if color_range is given.
  std::optional<Quantity> quantity = std::nullopt;
  // The range of colours of that quantity; none: the fixed one of its scale.
  std::optional<ColorRange> color_range = std::nullopt;
  // Snapshots by ascending iterations. The page keeps them in single precision, 8 bytes a control
  // point each.
  std::vector<PageSnapshot> snapshots = {};
  // A second map of the same surface with corresponding cells: the page shows both side by side,
  // and the difference of their densities. Its scaffold and its `other` are ignored.
  std::shared_ptr<const MapPage> other = {};
};

// Texts may hold any bytes; invalid UTF-8 is shown as U+FFFD. Energy and scale of the layout are
// those of the map's claims. The output depends only on `page`. Throws Error(Invalid) if the map is
// inconsistent, not finite or of a degree above 8, or if points, faults or snapshots do not belong
// to it. Throws Error(Usage) if the file cannot be written or the range excludes the isometry.
void write_page(const std::string& path, const MapPage& page);

// Records the maps of a run every few iterations, for its page.
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
// Memory is bounded: frames are counted with 8 bytes a control point at the degree of the result,
// as the page holds them. If another one does not fit, every second one is dropped, and from then
// on only every second one is recorded. Iteration 0, the start, is always kept.
class Film {
 public:
  // The memory of all frames: 46 frames of 10,000 cubic triangles.
  static constexpr std::size_t kMaxBytes = std::size_t{1} << 24;

  struct Frame {
    BezierMap map;
    int iteration = 0;
    double energy = 0;
  };

  // every: iterations between frames, at least 1. degree: of the result.
  Film(int every, int degree, std::size_t most_bytes = kMaxBytes)
      : every_(every), degree_(degree), most_bytes_(most_bytes) {}

  // Returns an observer for SolveOptions::watch, which this must outlive.
  MapObserver watcher();
  int every() const { return every_; }  // now
  // Returns the number of frames that frames() gives for a result at that iteration.
  std::size_t count(int last_iteration) const;
  // Returns the frames by ascending iterations, elevated to the degree of the result, which is the
  // last one.
  std::vector<PageSnapshot> frames(const Frame& result) const;

 private:
  static bool is_before(const Frame& frame, int last_iteration);
  void take(const TraceEntry& row, const MapView& at);

  int every_, degree_;
  std::size_t most_bytes_, frame_bytes_ = 0;
  std::vector<Frame> frames_;
};

// Returns the iteration of the last row, 0 if there is none.
int last_iteration(const std::vector<TraceEntry>& trace);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
