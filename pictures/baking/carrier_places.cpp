// Correspondences between the surface that is baked for and the one with the values: equal polygons
// of a file, or nearest points on the visible side.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <memory>
#include <unordered_map>

#include "majorant/mesh/polygon_mesh.h"
#include "majorant/pictures/baking/bake.h"
#include "majorant/pictures/baking/internal/position_at.h"

namespace majorant {
namespace {

// Finds faces of `carrier` that are polygons of another mesh of the same file.
class SamePolygons {
 public:
  SamePolygons(const SurfaceMesh& surface, const SurfaceMesh& carrier)
      : surface_(surface), carrier_(carrier) {
    const Vector3 extent =
        (carrier.positions().colwise().maxCoeff() - carrier.positions().colwise().minCoeff())
            .transpose();
    tolerance_ = kTenDigits * extent.norm();
    for (Index f = 0; f < carrier.face_count(); ++f) faces_of_[carrier.input_face(f)].push_back(f);
    for (Index f = 0; f < surface.face_count(); ++f) ++count_of_[surface.input_face(f)];
    same_.resize(to_size(surface.face_count()));
  }

  // Returns false if a face of the surface is not in the carrier.
  bool find() {
    for (Index f = 0; f < surface_.face_count(); ++f)
      if (!find(f)) return false;
    return true;
  }

  SurfacePlace place(const SurfacePlace& of) const {
    const Same& match = same_[to_size(of.face)];
    if (match.face < 0) return nearest(of);
    SurfacePlace place{match.face, Barycentric::Zero()};
    for (Index k = 0; k < 3; ++k) place.barycentric[match.corner[to_size(k)]] += of.barycentric[k];
    return place;
  }

 private:
  struct Same {
    Index face = -1;                    // -1: the carrier has triangulated the polygon differently
    std::array<Index, 3> corner = {0};  // its corner, by corner of the surface's face
  };

  bool find(Index f) {
    const auto faces = faces_of_.find(surface_.input_face(f));
    if (faces == faces_of_.end()) return false;
    for (const Index other : faces->second)
      if (matches(f, other, same_[to_size(f)])) return true;
    same_[to_size(f)].face = -1;
    if (static_cast<Index>(faces->second.size()) != count_of_[surface_.input_face(f)]) return false;
    for (Index k = 0; k < 3; ++k)
      if (std::none_of(faces->second.begin(), faces->second.end(),
                       [&](Index other) { return corner_of(f, k, other) >= 0; }))
        return false;
    return true;
  }

  bool matches(Index f, Index other, Same& match) const {
    match.face = other;
    for (Index k = 0; k < 3; ++k) {
      match.corner[to_size(k)] = corner_of(f, k, other);
      if (match.corner[to_size(k)] < 0) return false;
    }
    return true;
  }

  // Returns the corner of the carrier's face that corner k of a face of the surface is; -1: none.
  Index corner_of(Index f, Index k, Index other) const {
    const Index v = surface_.faces()(f, k);
    for (Index l = 0; l < 3; ++l) {
      const Index w = carrier_.faces()(other, l);
      if (surface_.input_vertex(v) == carrier_.input_vertex(w) &&
          (surface_.input_position(v) - carrier_.input_position(w)).norm() <= tolerance_)
        return l;
    }
    return -1;
  }

  SurfacePlace nearest(const SurfacePlace& of) const {
    const Vector3 p = position_at(surface_, of);
    NearestPoint best;
    best.distance = std::numeric_limits<double>::infinity();
    for (const Index f : faces_of_.at(surface_.input_face(of.face))) {
      const auto corner = [&](Index k) { return carrier_.input_position(carrier_.faces()(f, k)); };
      NearestPoint found = nearest_of_triangle(corner(0), corner(1), corner(2), p);
      found.face = f;
      if (found.distance < best.distance) best = found;
    }
    return {best.face, best.barycentric};
  }

  const SurfaceMesh& surface_;
  const SurfaceMesh& carrier_;
  double tolerance_ = 0;
  std::unordered_map<Index, std::vector<Index>> faces_of_;  // faces of the carrier by polygon
  std::unordered_map<Index, Index> count_of_;               // faces of the surface by polygon
  std::vector<Same> same_;                                  // by face of the surface
};

// Normals of a surface, interpolated between angle-weighted means at vertices. Copies of a vertex
// along cuts share one normal, so that both sides of a cut have the same direction.
class InterpolatedNormals {
 public:
  explicit InterpolatedNormals(const SurfaceMesh& mesh) : mesh_(mesh), flat_(mesh.face_count(), 3) {
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      const Index input = mesh.input_vertex(v);
      first_copy_.push_back(input >= 0 ? mesh.find_input_vertex(input) : v);
    }
    const Index vertices = mesh.vertex_count();
    at_vertex_ = Points3::Zero(vertices, 3);
    Vec weights = Vec::Zero(vertices);
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const auto p = [&](Index k) -> Vector3 { return mesh.positions().row(mesh.faces()(f, k)); };
      const Vector3 normal = (p(1) - p(0)).cross(p(2) - p(0)).stableNormalized();
      flat_.row(f) = normal;
      for (Index k = 0; k < 3; ++k) {
        const Vector3 a = p((k + 1) % 3) - p(k), b = p((k + 2) % 3) - p(k);
        const double angle = std::atan2(a.cross(b).norm(), a.dot(b));
        const Index v = first_copy_[to_size(mesh.faces()(f, k))];
        at_vertex_.row(v) += angle * normal;
        weights[v] += angle;
      }
    }
    for (Index v = 0; v < vertices; ++v)
      if (weights[v] > 0) at_vertex_.row(v) /= weights[v];
  }

  // Returns the unit normal, or 0 if the surface has none there. Where the interpolated normal
  // vanishes or lies in the face, it is that of the flat face.
  Vector3 at(const SurfacePlace& place) const {
    Vector3 normal = Vector3::Zero();
    for (Index k = 0; k < 3; ++k)
      normal += place.barycentric[k] *
                at_vertex_.row(first_copy_[to_size(mesh_.faces()(place.face, k))]).transpose();
    const Vector3 flat = flat_.row(place.face);
    constexpr double kLeast = 0.1;
    if (flat.isZero(0)) return normal.norm() > kLeast ? Vector3(normal.normalized()) : flat;
    return normal.dot(flat) > kLeast ? Vector3(normal.normalized()) : flat;
  }

 private:
  const SurfaceMesh& mesh_;
  std::vector<Index> first_copy_;  // by vertex: its first copy along cuts
  Points3 flat_, at_vertex_;
};

}  // namespace

std::optional<Correspondence> same_places(const SurfaceMesh& surface, const SurfaceMesh& carrier) {
  const auto same = std::make_shared<SamePolygons>(surface, carrier);
  if (!same->find()) return std::nullopt;
  return [same](const SurfacePlace& of, Index) {
    return std::optional(CarrierPlace{same->place(of), false});
  };
}

Sense sense_of(const SurfaceMesh& surface, const SurfaceTree& tree, double distance) {
  constexpr Index kSamples = 2000;
  const Index step = std::max(Index{1}, surface.face_count() / kSamples);
  double agreeing = 0;
  for (Index f = 0; f < surface.face_count(); f += step) {
    const auto p = [&](Index k) { return surface.input_position(surface.faces()(f, k)); };
    const Vector3 doubled = (p(1) - p(0)).cross(p(2) - p(0));
    const NearestPoint nearest = tree.nearest((p(0) + p(1) + p(2)) / 3);
    if (!(nearest.distance <= distance)) continue;
    agreeing += doubled.dot(tree.doubled_normal(nearest.face).stableNormalized());
  }
  return agreeing < 0 ? Sense::Reversed : Sense::Equal;
}

Correspondence nearest_places(const SurfaceMesh& surface, const SurfaceTree& tree, double distance,
                              Sense sense) {
  const auto normals = std::make_shared<const InterpolatedNormals>(surface);
  const double sign = sense == Sense::Equal ? 1 : -1;
  return [&surface, &tree, distance, sign, normals](const SurfacePlace& of,
                                                    Index likely) -> std::optional<CarrierPlace> {
    constexpr double kFartherAlong = 2;
    const Vector3 p = position_at(surface, of), normal = sign * normals->at(of);
    const NearestPoint facing = tree.nearest_facing(p, normal, distance, likely);
    if (facing.face >= 0) {
      const NearestPoint along = tree.along(p, normal, kFartherAlong * facing.distance);
      const NearestPoint& found = along.face >= 0 && along.distance <= distance ? along : facing;
      return CarrierPlace{{found.face, found.barycentric}, false};
    }
    const NearestPoint nearest = tree.nearest(p, likely);
    if (!(nearest.distance <= distance)) return std::nullopt;
    const bool is_opposed = tree.doubled_normal(nearest.face).dot(normal) < 0;
    return CarrierPlace{{nearest.face, nearest.barycentric}, is_opposed};
  };
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
