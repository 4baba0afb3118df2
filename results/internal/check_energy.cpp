#include "majorant/results/internal/check_energy.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "majorant/energies/named_energies.h"
#include "majorant/io/layout_scale.h"
#include "majorant/parametrization/maps/energy_text.h"
#include "majorant/parametrization/maps/rest_shapes_of.h"

namespace majorant {
namespace {

EnergySum energy_of(const Claims& claims, Findings& findings) {
  std::optional<EnergySum> energy = find_energy_sum(claimed_energy(claims));
  if (energy) return *std::move(energy);
  findings.add_violation(
      fmt::format("majorant_claims: no energy is called '{}'", claimed_energy(claims)));
  return {{symmetric_dirichlet(), 1.0}};
}

// What was measured tells a scale as claims do.
bool says_nothing_of_scale(const MapFile& file) {
  return has_assumed_scale(file) && file.distortion.size() == 0 && file.min_det.size() == 0 &&
         file.face_distortion.rows() == 0;
}

// Means over the faces that have an area.
class OtherFaces {
 public:
  explicit OtherFaces(const SurfaceMesh& mesh) : weight_(rest_shapes(mesh).measure) {
    for (const RestTriangle& rest : mesh.rest_triangles()) weight_[rest.face] = 0;
  }
  double mean(const Vec& face_value) const { return weight_.dot(face_value) / weight_.sum(); }

 private:
  Vec weight_;
};

// Times uv, at which the mean of symmetric Dirichlet is least. It is a t^2 + b / t^2 of the map t
// times as large: a + b at 1, 4 a + b / 4 at 2, and least where t^4 = b / a.
double best_scale(const MapFile& file, const BezierMap& map, const OtherFaces& others,
                  const StopCheck& stop) {
  const double first = layout_scale(file);
  if (stop() != Directive::Continue) return first;
  const EnergySum energy{{symmetric_dirichlet(), 1.0}};
  const RestShapes rest = rest_shapes(map.mesh());
  const auto mean = [&](double scale) {
    Vec of_faces;
    mean_density(map.with(map.shared_space(), scale * map.control_points()), rest, energy,
                 of_faces);
    return others.mean(of_faces);
  };
  const double once = mean(first), twice = mean(2 * first);
  const double a = (4 * twice - once) / 15;
  const double scale = first * std::pow((once - a) / a, 0.25);
  return scale > 0 && std::isfinite(scale) ? scale : first;
}

}  // namespace

std::string claimed_energy(const Claims& claims) {
  return claims.energy.value_or("symmetric-dirichlet");
}

CheckedEnergy measure_as_claimed(const MapFile& file, const BezierMap& map, const Claims& claims,
                                 const StopCheck& stop, Findings& findings, MapMeasures& measures) {
  const OtherFaces others(map.mesh());
  CheckedEnergy out;
  out.name = claimed_energy(claims);
  out.is_best_scale = says_nothing_of_scale(file);
  out.scale = out.is_best_scale   ? best_scale(file, map, others, stop)
              : claims.normalized ? claims.normalized->size
                                  : 1;
  measures = measure_normalized(map, out.scale, energy_of(claims, findings), stop);
  out.without_area = static_cast<Index>(map.mesh().rest_triangles().size());
  if (out.without_area < map.mesh().face_count()) out.value = others.mean(measures.face_value);
  return out;
}

std::string describe(const CheckedEnergy& energy) {
  std::string text = energy.name;
  const std::string scale =
      energy.is_best_scale ? fmt::format(" at the best scale, uv times {:.6g}", energy.scale) : "";
  if (energy.without_area == 0) return fmt::format("{} {:.9g}{}", text, energy.value, scale);
  text += fmt::format(
      " infinite, since {} no area",
      energy.without_area == 1 ? "1 face has" : fmt::format("{} faces have", energy.without_area));
  if (std::isnan(energy.value)) return text;
  return text + fmt::format(" ({:.9g} over the others{})", energy.value, scale);
}

void add_energy(const CheckedEnergy& energy, Json& section) {
  section["layout_scale"] = 1 / energy.scale;
  section["scale_is_assumed"] = energy.is_best_scale;
  section["faces_without_area"] = energy.without_area;
  if (energy.without_area == 0) return;
  section["value"] = nullptr;  // infinite, as the largest density and stretch
  section["max_density"] = nullptr;
  section["sigma_max"] = nullptr;
  section["value_over_others"] = energy.value;
}

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
