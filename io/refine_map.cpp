#include "majorant/io/refine_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <map>

#include "majorant/framework/error.h"
#include "majorant/io/bezier_cell.h"
#include "majorant/io/read_mesh.h"

namespace majorant {
namespace {

// The points of a triangle's regular subdivision: (a, b) stands for the barycentric coordinates
// (1 - (a + b) / K, a / K, b / K); rows of constant b.
class Lattice {
 public:
  explicit Lattice(int refine) : refine_(refine) {}

  int refine() const { return refine_; }
  std::size_t size() const { return static_cast<std::size_t>(bezier_cell_size(refine_)); }
  std::size_t at(int a, int b) const {
    return static_cast<std::size_t>(b * (refine_ + 1) - b * (b - 1) / 2 + a);
  }
  std::size_t corner(int k) const {
    return k == 0 ? at(0, 0) : k == 1 ? at(refine_, 0) : at(0, refine_);
  }
  // Sample s = 1 .. refine - 1 along edge 0 (corner 0 to 1), 1 (1 to 2) or 2 (2 to 0).
  std::size_t on_edge(int edge, int s) const {
    return edge == 0 ? at(s, 0) : edge == 1 ? at(refine_ - s, s) : at(0, refine_ - s);
  }

  Points3 barycentric() const {
    Points3 result(static_cast<Eigen::Index>(size()), 3);
    const double K = refine_;
    for (int b = 0; b <= refine_; ++b) {
      for (int a = 0; a + b <= refine_; ++a) {
        result.row(static_cast<Eigen::Index>(at(a, b))) << (refine_ - a - b) / K, a / K, b / K;
      }
    }
    return result;
  }

 private:
  int refine_;
};

// Numbers for the lattice points of one cell after the other; corners and edges are shared.
class SampleNumbering {
 public:
  SampleNumbering(const Lattice& lattice, std::size_t first_free)
      : lattice_(lattice), next_(static_cast<Index>(first_free)) {}

  // The numbers of the lattice points of a cell with these corners. `tags` tell edges apart that
  // have the same two corners.
  const std::vector<Index>& number(const std::vector<Index>& corners,
                                   const std::array<Index, 3>& tags) {
    numbers_.assign(lattice_.size(), -1);
    for (int k = 0; k < 3; ++k) numbers_[lattice_.corner(k)] = corners[static_cast<std::size_t>(k)];
    const int inner = lattice_.refine() - 1;
    for (int edge = 0; edge < 3; ++edge) {
      const Index from = corners[static_cast<std::size_t>(edge)];
      const Index to = corners[static_cast<std::size_t>((edge + 1) % 3)];
      const auto [entry, is_new] = edges_.try_emplace(
          {std::min(from, to), std::max(from, to), tags[static_cast<std::size_t>(edge)]}, next_);
      if (is_new) next_ += inner;
      for (int s = 1; s <= inner; ++s) {
        const int position = from < to ? s - 1 : inner - s;
        numbers_[lattice_.on_edge(edge, s)] = entry->second + position;
      }
    }
    for (Index& sample : numbers_) {
      if (sample < 0) sample = next_++;
    }
    return numbers_;
  }

 private:
  const Lattice& lattice_;
  Index next_;
  std::map<std::array<Index, 3>, Index> edges_;  // (smaller corner, larger, tag) -> first sample
  std::vector<Index> numbers_;
};

// Stores the samples whose number is new: the first cell decides.
template <class Point>
void store(const std::vector<Index>& numbers, const Eigen::MatrixXd& samples,
           std::vector<Point>& points) {
  const std::size_t known = points.size();
  const auto largest = static_cast<std::size_t>(*std::max_element(numbers.begin(), numbers.end()));
  points.resize(std::max(known, largest + 1), Point::Zero());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto number = static_cast<std::size_t>(numbers[i]);
    if (number >= known) points[number] = samples.row(static_cast<Eigen::Index>(i)).transpose();
  }
}

// The inner control point next to the corner with the smaller number, for every edge.
std::array<Index, 3> edge_tags(const MapFile& map, Index cell, const std::vector<Index>& corners) {
  std::array<Index, 3> tags = {-1, -1, -1};
  if (map.degree == 1) return tags;
  for (int edge = 0; edge < 3; ++edge) {
    const auto points = bezier_edge_points(map.degree, edge);
    const auto from = static_cast<std::size_t>(edge);
    const bool forward = corners[from] < corners[(from + 1) % 3];
    tags[from] = map.cells(cell, forward ? points[1] : points[points.size() - 2]);
  }
  return tags;
}

void add_triangles(const Lattice& lattice, const std::vector<Index>& numbers,
                   std::vector<std::vector<Index>>& triangles) {
  const int K = lattice.refine();
  const auto add = [&](std::size_t i, std::size_t j, std::size_t k) {
    triangles.push_back({numbers[i], numbers[j], numbers[k]});
  };
  for (int b = 0; b < K; ++b) {
    for (int a = 0; a + b < K; ++a) {
      add(lattice.at(a, b), lattice.at(a + 1, b), lattice.at(a, b + 1));
      if (a + b + 1 == K) continue;
      add(lattice.at(a + 1, b), lattice.at(a + 1, b + 1), lattice.at(a, b + 1));
    }
  }
}

// Whether vertex numbers of the coarse mesh are those of the input.
bool has_numbers_of(const PolygonMesh& coarse, const PolygonMesh& input) {
  if (coarse.positions.size() > input.positions.size()) return false;
  for (const auto& polygon : coarse.polygons) {
    for (const Index v : polygon) {
      const auto vertex = static_cast<std::size_t>(v);
      if (coarse.positions[vertex] != input.positions[vertex]) return false;
    }
  }
  return true;
}

}  // namespace

PolygonMesh refine_map(const MapFile& map, const PolygonMesh* input, int refine) {
  const long long most = std::numeric_limits<Index>::max();
  const long long samples = (refine + 1LL) * (refine + 2LL) / 2;
  if (refine < 1) throw Error(ErrorKind::Usage, fmt::format("refine {} is less than 1", refine));
  if (refine > 10000 || samples > most / (2 * map.cells.rows() + map.points.rows())) {
    throw Error(ErrorKind::Usage, fmt::format("refine {} gives too many triangles", refine));
  }
  const PolygonMesh coarse = mesh_from_map(map, "");
  PolygonMesh fine;
  fine.positions = coarse.positions;
  fine.texcoords = coarse.texcoords;
  if (input != nullptr && has_numbers_of(coarse, *input)) fine.positions = input->positions;
  const Lattice lattice(refine);
  const Points3 barycentric = lattice.barycentric();
  const Eigen::MatrixXd bernstein = bernstein_values(map.degree, barycentric);
  SampleNumbering surface(lattice, fine.positions.size());
  SampleNumbering plane(lattice, fine.texcoords.size());
  const bool knows_faces = input != nullptr && map.input_face.size() == map.cells.rows();
  auto directive = knows_faces ? input->directives.begin() : decltype(input->directives.begin()){};
  for (std::size_t c = 0; c < coarse.polygons.size(); ++c) {
    const auto cell = static_cast<Index>(coarse.polygon_lines[c] - 1);
    while (knows_faces && directive != input->directives.end() &&
           directive->first <= map.input_face[cell]) {
      fine.directives.emplace_back(static_cast<Index>(fine.polygons.size()), directive->second);
      ++directive;
    }
    const Eigen::MatrixXd corners = map.points(map.cells.row(cell).leftCols<3>(), Eigen::all);
    const Eigen::MatrixXd control = map.uv(map.cells.row(cell), Eigen::all);
    const auto& v = surface.number(coarse.polygons[c], {-1, -1, -1});
    store(v, barycentric * corners, fine.positions);
    add_triangles(lattice, v, fine.polygons);
    const auto& corner_texcoords = coarse.polygon_texcoords[c];
    const auto& vt = plane.number(corner_texcoords, edge_tags(map, cell, corner_texcoords));
    store(vt, bernstein * control, fine.texcoords);
    add_triangles(lattice, vt, fine.polygon_texcoords);
  }
  for (; knows_faces && directive != input->directives.end(); ++directive) {
    fine.directives.emplace_back(static_cast<Index>(fine.polygons.size()), directive->second);
  }
  return fine;
}

}  // namespace majorant
