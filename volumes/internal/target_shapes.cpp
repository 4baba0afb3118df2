#include "majorant/volumes/internal/target_shapes.h"

#include <fmt/format.h>

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "majorant/elements/bernstein.h"
#include "majorant/framework/error.h"
#include "majorant/volumes/internal/reference_cell.h"

namespace majorant {
namespace {

// A sum of determinants below this part of the sum of their magnitudes counts as rounding.
constexpr double kCancelled = 1e-12;

// Returns d x / d reference coordinates, by columns, of the regular cell with edges of length 1.
RowMatrix regular_tangents(CellShape shape, int dim) {
  const double half = 0.5, height = std::sqrt(0.75);  // of the triangle
  RowMatrix T = RowMatrix::Identity(dim, dim);
  if (shape == CellShape::Tetrahedron || shape == CellShape::Wedge) {
    T(0, 1) = half;
    T(1, 1) = height;
  }
  if (shape == CellShape::Tetrahedron) {
    T(0, 2) = half;
    T(1, 2) = height / 3;
    T(2, 2) = std::sqrt(2.0 / 3);
  }
  if (shape == CellShape::Triangle) T << -half, half, -height, -height;  // from the last corner
  return T;
}

// Computes d x / d reference coordinates at the centre of the straight cell.
class StraightTangents {
 public:
  StraightTangents(CellShape shape, int dim)
      : element_(bernstein_element(shape, 1)), basis_(element_.basis(element_.degrees())) {
    gradients_ = RowMatrix::Zero(dim, basis_.count());
    for (int d = 0; d < dim; ++d)
      for (int k = 0; k < basis_.count(); ++k)
        gradients_(d, k) = formal(k, element_.derivatives[to_size(d)][0]) -
                           formal(k, element_.derivatives[to_size(d)][1]);
  }
  RowMatrix operator()(const VolumeMesh& mesh, const CellBlock& block, Index cell) const {
    const auto dim = gradients_.rows();
    RowMatrix corners(gradients_.cols(), dim);
    for (Index k = 0; k < corners.rows(); ++k)
      corners.row(k) = mesh.points.row(block.nodes(cell, k)).head(dim);
    return (gradients_ * corners).transpose();
  }

 private:
  // Returns the derivative of a function by one of the homogeneous coordinates, which are taken as
  // independent, at the centre.
  double formal(int k, int coordinate) const {
    const Exponents& e = basis_.exponents(k);
    if (e[to_size(coordinate)] == 0) return 0;
    const int own = element_.factor_of(coordinate);
    double value = 1;
    for (std::size_t f = 0; f < element_.factors.size(); ++f)
      if (static_cast<int>(f) != own) value /= element_.factors[f];
    return value;
  }

  BernsteinElement element_;
  BernsteinBasis basis_;
  RowMatrix gradients_;
};

class TargetShapes {
 public:
  TargetShapes(const VolumeMesh& mesh, const ControlNet& net, const VolumeOptions& options)
      : mesh_(mesh), net_(net), options_(options) {}

  std::vector<RestShapes> make() {
    measure_surroundings();
    std::size_t cell = 0;
    double is = 0, should_be = 0;  // the measures of all cells
    std::vector<RestShapes> out;
    for (const ControlNet::Part& part : net_.parts()) {
      const CellBlock& block = mesh_.blocks[to_size(part.block)];
      const RowMatrix regular = regular_tangents(block.type.shape, net_.dim());
      const StraightTangents straight(block.type.shape, net_.dim());
      RestShapes& rest = out.emplace_back();
      rest.dim = net_.dim();
      rest.inverse.resize(block.size(), net_.dim() * net_.dim());
      rest.measure.resize(block.size());
      for (Index e = 0; e < block.size(); ++e, ++cell) {
        RowMatrix tangents = regular * length_of(part, e, cell);
        if (options_.target == VolumeTarget::Initial)
          if (const RowMatrix own = straight(mesh_, block, e);
              own.determinant() >= std::numeric_limits<double>::min())
            tangents = own;
        const RowMatrix inverse = tangents.inverse();
        rest.inverse.row(e) = Eigen::Map<const Eigen::RowVectorXd>(inverse.data(), inverse.size());
        rest.measure[e] = tangents.determinant() * part.space->reference_measure();
        is += rest.measure[e];
        should_be += straight(mesh_, block, e).determinant() * part.space->reference_measure();
      }
    }
    if (options_.target == VolumeTarget::Ideal && should_be > kCancelled * is)
      for (RestShapes& rest : out) scale(std::pow(should_be / is, 1.0 / net_.dim()), rest);
    return out;
  }

 private:
  static void scale(double factor, RestShapes& rest) {
    rest.inverse /= factor;
    rest.measure *= integer_power(factor, rest.dim);
  }

  // Computes at each corner the mean signed det of the straight cells around it: these are the star
  // of the corner, wherever it lies. If that is not positive, the mean of all cells is used; if the
  // cells cancel, the mean magnitude; if all are flat, the box of the mesh.
  void measure_surroundings() {
    mean_.setZero(net_.count());
    Vec count = Vec::Zero(net_.count());
    double sum = 0, magnitudes = 0;
    Index cells = 0;
    for (const ControlNet::Part& part : net_.parts()) {
      const CellBlock& block = mesh_.blocks[to_size(part.block)];
      const StraightTangents straight(block.type.shape, net_.dim());
      const double regular = regular_tangents(block.type.shape, net_.dim()).determinant();
      for (Index e = 0; e < block.size(); ++e) {
        const double size = straight(mesh_, block, e).determinant() / regular;
        sum += size;
        magnitudes += std::abs(size);
        ++cells;
        for (int k = 0; k < corner_count(block.type.shape); ++k) {
          mean_[part.space->cells()(e, k)] += size;
          count[part.space->cells()(e, k)] += 1;
        }
      }
    }
    double all = std::abs(sum) > kCancelled * magnitudes ? std::abs(sum) : magnitudes;
    if (!(all > 0)) {
      const Vector3 box = mesh_.points.colwise().maxCoeff() - mesh_.points.colwise().minCoeff();
      all = integer_power(box.norm(), net_.dim());
    }
    const double mean = all / cells;
    for (Index k = 0; k < mean_.size(); ++k) mean_[k] = mean_[k] > 0 ? mean_[k] / count[k] : mean;
  }

  // Returns the length of the edges of the regular target cell.
  double length_of(const ControlNet::Part& part, Index e, std::size_t cell) const {
    if (options_.target == VolumeTarget::Size)
      return options_.sizes.size() == 1 ? options_.sizes[0] : options_.sizes[cell];
    const int corners = corner_count(mesh_.blocks[to_size(part.block)].type.shape);
    double sum = 0;
    for (int k = 0; k < corners; ++k) sum += mean_[part.space->cells()(e, k)];
    const double length = std::pow(sum / corners, 1.0 / net_.dim());
    if (!is_edge_length(length, net_.dim()))
      throw Error(ErrorKind::Unsupported,
                  fmt::format("{}: edges of a length of {} are beyond what doubles hold the "
                              "volumes of; scale the mesh",
                              mesh_.file, length));
    return length;
  }

  const VolumeMesh& mesh_;
  const ControlNet& net_;
  const VolumeOptions& options_;
  Vec mean_;
};

}  // namespace

std::vector<RestShapes> target_shapes(const VolumeMesh& mesh, const ControlNet& net,
                                      const VolumeOptions& options) {
  if (options.target == VolumeTarget::Size) {
    std::size_t cells = 0;
    for (const ControlNet::Part& part : net.parts()) cells += to_size(part.space->element_count());
    if (options.sizes.size() != 1 && options.sizes.size() != cells)
      throw InvalidArgument(fmt::format("{} sizes for {} elements: one is needed, or one for each",
                                        options.sizes.size(), cells));
    for (const double size : options.sizes)
      if (!is_edge_length(size, net.dim()))
        throw InvalidArgument(fmt::format(
            "a size of {}; positive is needed, of which doubles hold the volume", size));
  }
  return TargetShapes(mesh, net, options).make();
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
