// Point queries: preimages of a map, and nearest points of a surface.
#include <string>
#include <vector>

#include "arrays.h"
#include "majorant/certify/cut_map.h"
#include "majorant/certify/inverse_map.h"
#include "majorant/framework/parallel.h"
#include "majorant/mesh/nearest_point.h"
#include "map_file.h"
#include "module.h"
#include "run.h"

namespace majorant::python {
namespace {

using Flags = Eigen::Matrix<bool, Eigen::Dynamic, 1>;

std::unique_ptr<InverseMap> inverse_of(const MapFile& file) {
  Run run;
  return run([&] {
    const CutMap cut(file, "the map");
    return std::make_unique<InverseMap>(cut.map_cut_along(cut.cuts()));
  });
}

// Returns for each row of uv: face, barycentric coordinates, whether the preimage is undecided.
py::tuple locate(const InverseMap& inverse, const Doubles& uv, int threads) {
  const auto points = matrix<Points2>(uv);
  Run run;
  InverseMap::Points found = run([&] {
    const ThreadCount count(threads);
    return inverse.locate(points, run.stop());
  });
  Flags undecided(points.rows());
  for (Index k = 0; k < undecided.size(); ++k) undecided[k] = found.is_undecided[to_size(k)];
  return py::make_tuple(Integers(static_cast<py::ssize_t>(found.face.size()), found.face.data()),
                        moved(std::move(found.barycentric)), moved(std::move(undecided)));
}

// Returns for each preimage of each row of uv: the row, face, barycentric coordinates, whether the
// preimage is undecided.
py::tuple locate_all(const InverseMap& inverse, const Doubles& uv, int threads) {
  const auto points = matrix<Points2>(uv);
  Run run;
  const InverseMap::Lists all = run([&] {
    const ThreadCount count(threads);
    return inverse.locate_all(points, run.stop());
  });
  const auto count = static_cast<Index>(all.preimages.size());
  Eigen::VectorXi row(count), face(count);
  Points3 barycentric(count, 3);
  Flags undecided(count);
  for (Index k = 0; k < static_cast<Index>(points.rows()); ++k)
    for (Index i = all.begin[to_size(k)]; i < all.begin[to_size(k) + 1]; ++i) {
      const Preimage& one = all.preimages[to_size(i)];
      row[i] = k;
      face[i] = one.face;
      barycentric.row(i) = one.barycentric;
      undecided[i] = !one.proven;
    }
  return py::make_tuple(moved(std::move(row)), moved(std::move(face)),
                        moved(std::move(barycentric)), moved(std::move(undecided)));
}

std::unique_ptr<SurfaceTree> tree_of(const Doubles& positions, const Integers& faces) {
  return std::make_unique<SurfaceTree>(matrix<Points3>(positions), matrix<Cells>(faces));
}

// Returns for each row of `points`: face, barycentric coordinates, distance.
py::tuple nearest(const SurfaceTree& tree, const Doubles& points, int threads) {
  const auto places = matrix<Points3>(points);
  Run run;
  const std::vector<NearestPoint> found = run([&] {
    const ThreadCount count(threads);
    return tree.locate(places, run.stop());
  });
  const auto count = static_cast<Index>(found.size());
  Eigen::VectorXi face(count);
  Points3 barycentric(count, 3);
  Eigen::VectorXd distance(count);
  for (Index k = 0; k < count; ++k) {
    face[k] = found[to_size(k)].face;
    barycentric.row(k) = found[to_size(k)].barycentric;
    distance[k] = found[to_size(k)].distance;
  }
  return py::make_tuple(moved(std::move(face)), moved(std::move(barycentric)),
                        moved(std::move(distance)));
}

}  // namespace

void bind_places(py::module_& module) {
  py::class_<InverseMap>(module, "InverseMap")
      .def(py::init(&inverse_of), py::arg("file"))
      .def("locate", &locate, py::arg("uv"), py::arg("threads"))
      .def("locate_all", &locate_all, py::arg("uv"), py::arg("threads"));
  py::class_<SurfaceTree>(module, "SurfaceTree")
      .def(py::init(&tree_of), py::arg("positions"), py::arg("faces"))
      .def("nearest", &nearest, py::arg("points"), py::arg("threads"));
}

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
