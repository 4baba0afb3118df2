#include "majorant/io/write_svg.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <vector>

#include "majorant/io/atomic_file.h"
#include "majorant/io/bezier_cell.h"
#include "majorant/io/heat_color.h"
#include "majorant/io/map_check.h"

namespace majorant {
namespace {

constexpr double kWidth = 1000.0;
constexpr double kTallest = 4000.0;
constexpr double kMargin = 10.0;
constexpr double kLegendHeight = 50.0;
constexpr int kPiecesPerEdge = 4;
constexpr int kLegendSteps = 24;

struct ValueRange {
  double low = 0.0;
  double high = 0.0;

  double fraction(double value) const { return high > low ? (value - low) / (high - low) : 0.0; }
};

// The smallest value and the 98 % quantile.
ValueRange range_of(const Vec& values) {
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const double position = 0.98 * static_cast<double>(sorted.size() - 1);
  return {sorted.front(), sorted[static_cast<std::size_t>(std::ceil(position))]};
}

// Point and derivative of a Bezier curve at s, by de Casteljau's algorithm.
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

class Drawing {
 public:
  explicit Drawing(const MapFile& map) : map_(map) {
    low_ = map.uv.colwise().minCoeff().transpose();
    const Vector2 high = map.uv.colwise().maxCoeff().transpose();
    // Halves: the extent of two finite numbers may overflow.
    const Vector2 extent = (0.5 * high - 0.5 * low_).cwiseMax(1e-300);
    scale_ = std::min((kWidth - 2 * kMargin) / extent[0], kTallest / extent[1]);
    top_ = high[1];
    height_ = scale_ * extent[1] + 2 * kMargin;
    for (int edge = 0; edge < 3; ++edge)
      edges_[static_cast<std::size_t>(edge)] = bezier_edge_points(map.degree, edge);
  }

  std::string text() {
    const bool has_legend = map_.distortion.size() > 0;
    const double height = std::ceil(height_ + (has_legend ? kLegendHeight : 0.0));
    add("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
        "viewBox=\"0 0 {0} {1}\">\n",
        kWidth, height);
    add("<g stroke=\"#333\" stroke-width=\"{:.3g}\" stroke-linejoin=\"round\">\n", stroke_width());
    const ValueRange range = has_legend ? range_of(map_.distortion) : ValueRange{};
    for (Eigen::Index cell = 0; cell < map_.cells.rows(); ++cell) {
      const std::string fill =
          has_legend ? heat_color(range.fraction(map_.distortion[cell])) : "#dddddd";
      add("<path fill=\"{}\" d=\"", fill);
      add_outline(cell);
      add("\"/>\n");
    }
    add("</g>\n");
    if (has_legend) add_legend(range);
    add("</svg>\n");
    return fmt::to_string(buffer_);
  }

 private:
  template <class... Args>
  void add(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(buffer_), format, std::forward<Args>(args)...);
  }

  // In drawing units; differences are halved like the extent.
  Vector2 place(Index point) const {
    return {kMargin + scale_ * (0.5 * map_.uv(point, 0) - 0.5 * low_[0]),
            kMargin + scale_ * (0.5 * top_ - 0.5 * map_.uv(point, 1))};
  }

  // Three decimals of a drawing of 1000: 6 digits. No trailing zeros, no -0.
  void add_number(double value) {
    const auto thousandths = std::llround(1000.0 * value);
    const auto magnitude = std::llabs(thousandths);
    if (thousandths < 0) add("-");
    add("{}", magnitude / 1000);
    const auto rest = magnitude % 1000;
    if (rest == 0) return;
    const std::string digits = fmt::format(".{:03}", rest);
    add("{}", std::string_view(digits).substr(0, digits.find_last_not_of('0') + 1));
  }

  void add_point(char separator, const Vector2& point) {
    add("{}", separator);
    add_number(point[0]);
    add(",");
    add_number(point[1]);
  }

  void add_outline(Eigen::Index cell) {
    add_point('M', place(map_.cells(cell, 0)));
    for (const auto& edge : edges_) {
      std::vector<Vector2> control;
      for (const int local : edge) control.push_back(place(map_.cells(cell, local)));
      if (map_.degree > 3) {
        add_hermite_pieces(control);
        continue;
      }
      for (std::size_t i = 1; i < control.size(); ++i) {
        add_point(i > 1 ? ' ' : "LQC"[map_.degree - 1], control[i]);
      }
    }
    add("Z");
  }

  // Cubics with the curve's points and derivatives at the ends of equal pieces.
  void add_hermite_pieces(const std::vector<Vector2>& control) {
    constexpr double kThird = 1.0 / (3.0 * kPiecesPerEdge);
    auto [begin, begin_derivative] = evaluate_curve(control, 0.0);
    for (int piece = 1; piece <= kPiecesPerEdge; ++piece) {
      const auto [end, end_derivative] =
          evaluate_curve(control, static_cast<double>(piece) / kPiecesPerEdge);
      add_point('C', begin + kThird * begin_derivative);
      add_point(' ', end - kThird * end_derivative);
      add_point(' ', end);
      begin = end;
      begin_derivative = end_derivative;
    }
  }

  // A twentieth of the typical cell, thin lines at most.
  double stroke_width() const {
    const double area = kWidth * height_ / static_cast<double>(map_.cells.rows());
    return std::clamp(0.02 * std::sqrt(area), 0.05, 1.0);
  }

  void add_legend(const ValueRange& range) {
    constexpr double kBarWidth = 240.0;
    constexpr double kBarHeight = 12.0;
    const double y = height_ + 8.0;
    const double step = kBarWidth / kLegendSteps;
    add("<g font-family=\"sans-serif\" font-size=\"14\" fill=\"#333\">\n");
    for (int i = 0; i < kLegendSteps; ++i) {
      add("<rect x=\"{}\" y=\"", kMargin + i * step);
      add_number(y);
      add("\" width=\"{}\" height=\"{}\" fill=\"{}\"/>\n", step, kBarHeight,
          heat_color((i + 0.5) / kLegendSteps));
    }
    for (const auto& [anchor, x, label] :
         {std::tuple{"start", kMargin, fmt::format("{:.5g}", range.low)},
          std::tuple{"end", kMargin + kBarWidth, fmt::format("{:.5g}", range.high)}}) {
      add("<text text-anchor=\"{}\" x=\"{}\" y=\"", anchor, x);
      add_number(y + kBarHeight + 16.0);
      add("\">{}</text>\n", label);
    }
    add("<text x=\"{}\" y=\"", kMargin + kBarWidth + 12.0);
    add_number(y + kBarHeight - 1.0);
    add("\">distortion (largest {:.5g})</text>\n</g>\n", map_.distortion.maxCoeff());
  }

  const MapFile& map_;
  Vector2 low_;
  double top_ = 0.0;
  double scale_ = 1.0;   // drawing units per half uv unit
  double height_ = 0.0;  // of the layout with margins
  std::array<std::vector<int>, 3> edges_;
  fmt::memory_buffer buffer_;
};

}  // namespace

void write_svg(const std::string& path, const MapFile& map) {
  require_sound(path, map);
  write_file_atomically(path, Drawing(map).text());
}

}  // namespace majorant
