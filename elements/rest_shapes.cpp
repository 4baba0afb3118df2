#include <Eigen/Geometry>
#include <cmath>

#include "majorant/elements/element_space.h"

namespace majorant {

RestShapes flat_triangles(const Points3& positions, const Cells& faces) {
  RestShapes rest;
  rest.inverse.resize(static_cast<std::size_t>(faces.rows()));
  rest.measure.resize(faces.rows());
  for (Index f = 0; f < faces.rows(); ++f) {
    const Vector3 e0 = positions.row(faces(f, 0)) - positions.row(faces(f, 2));
    const Vector3 e1 = positions.row(faces(f, 1)) - positions.row(faces(f, 2));
    const double length = e0.norm();
    const double along = e1.dot(e0) / length;
    const double height = e0.cross(e1).norm() / length;
    rest.inverse[static_cast<std::size_t>(f)] << 1 / length, -along / (length * height), 0,
        1 / height;
    rest.measure[f] = 0.5 * length * height;
  }
  return rest;
}

}  // namespace majorant
