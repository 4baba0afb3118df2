// Values of surfaces as functions of their points: positions, normals, numbers of faces, tables of
// faces, vertices and corners, colours, textures.
#include <limits>
#include <memory>
#include <utility>

#include "majorant/pictures/baking/bake.h"
#include "majorant/pictures/baking/internal/position_at.h"

namespace majorant {
namespace {

constexpr float kNothing = std::numeric_limits<float>::quiet_NaN();

void write_vector(const Vector3& v, float* value) {
  for (Index k = 0; k < 3; ++k) value[k] = static_cast<float>(v[k]);
}

}  // namespace

SurfaceValues position_values(const SurfaceMesh& mesh) {
  return {3,
          [&mesh](const SurfacePlace& place, float* value) {
            write_vector(position_at(mesh, place), value);
          },
          kNothing};
}

SurfaceValues normal_values(const SurfaceMesh& mesh) {
  return {3,
          [&mesh](const SurfacePlace& place, float* value) {
            const auto p = [&](Index k) -> Vector3 {
              return mesh.positions().row(mesh.faces()(place.face, k));
            };
            write_vector((p(1) - p(0)).cross(p(2) - p(0)).stableNormalized(), value);
          },
          0, Continuation::OfFaces};
}

SurfaceValues normal_values(Eigen::Matrix<double, Eigen::Dynamic, 9, Eigen::RowMajor> corners) {
  const auto kept = std::make_shared<const decltype(corners)>(std::move(corners));
  return {3,
          [kept](const SurfacePlace& place, float* value) {
            Vector3 normal = Vector3::Zero();
            for (Index k = 0; k < 3; ++k)
              normal += place.barycentric[k] * kept->row(place.face).segment<3>(3 * k).transpose();
            write_vector(normal.stableNormalized(), value);
          },
          0};
}

SurfaceValues face_values(const SurfaceMesh& mesh) {
  return {1,
          [&mesh](const SurfacePlace& place, float* value) {
            *value = static_cast<float>(mesh.input_face(place.face));
          },
          -1, Continuation::OfFaces};
}

SurfaceValues table_of_faces(RowMatrix rows) {
  const auto kept = std::make_shared<const RowMatrix>(std::move(rows));
  return {static_cast<int>(kept->cols()),
          [kept](const SurfacePlace& place, float* value) {
            for (Index c = 0; c < kept->cols(); ++c)
              value[c] = static_cast<float>((*kept)(place.face, c));
          },
          kNothing, Continuation::OfFaces};
}

SurfaceValues table_of_vertices(const SurfaceMesh& mesh, RowMatrix rows) {
  const auto kept = std::make_shared<const RowMatrix>(std::move(rows));
  return {static_cast<int>(kept->cols()),
          [&mesh, kept](const SurfacePlace& place, float* value) {
            for (Index c = 0; c < kept->cols(); ++c) {
              double sum = 0;
              for (Index k = 0; k < 3; ++k)
                sum += place.barycentric[k] * (*kept)(mesh.faces()(place.face, k), c);
              value[c] = static_cast<float>(sum);
            }
          },
          kNothing};
}

SurfaceValues table_of_corners(RowMatrix rows) {
  const auto kept = std::make_shared<const RowMatrix>(std::move(rows));
  return {static_cast<int>(kept->cols()),
          [kept](const SurfacePlace& place, float* value) {
            for (Index c = 0; c < kept->cols(); ++c) {
              double sum = 0;
              for (Index k = 0; k < 3; ++k)
                sum += place.barycentric[k] * (*kept)(3 * place.face + k, c);
              value[c] = static_cast<float>(sum);
            }
          },
          kNothing};
}

SurfaceValues color_values(RowMatrix corners) {
  SurfaceValues values = table_of_corners(std::move(corners));
  values.background = 0;
  values.seen = Transfer::Srgb;
  return values;
}

SurfaceValues texture_values(const BezierMap& layout, const Raster& image, Transfer transfer,
                             Filter filter, const Wraps& wraps) {
  const auto decoder = std::make_shared<const ColorDecoder>(image, transfer);
  return {image.channels(),
          [&layout, &image, decoder, filter, wraps](const SurfacePlace& place, float* value) {
            sample(image, *decoder, layout.evaluate(place.face, place.barycentric), filter, value,
                   wraps);
          },
          0, filter == Filter::Nearest ? Continuation::OfFaces : Continuation::Picture, transfer};
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
