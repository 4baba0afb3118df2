// Symmetric cuts of symmetric surfaces.
//
//   const Vec cost = cut_costs(*mesh, {});
//   const MirroredCuts halves(*mesh, *mirror_plane(*mesh), cost);
//   is_cut = halves.cut({0}, MirroredCuts::Half::Above, MirroredCuts::Ends::OfHalf);
//
// The surface is divided along edges near the plane, the spine. A cut graph (cut_graph.h) runs
// through one half and the spine, whose edges cost half. In the other half it runs along the images
// of these cuts, over that half's own edges. Where both halves would close a loop, one of its sides
// is left out.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "majorant/framework/stop_check.h"
#include "majorant/mesh/surface_mesh.h"
#include "majorant/parametrization/seams/internal/mirror_plane.h"

namespace majorant {

class MirroredCuts {
 public:
  enum class Half { Above, Below };  // the plane
  // The ends of cuts: those of the half that is mirrored, or also those of the other half whose
  // images are not near any of them.
  enum class Ends { OfHalf, OfBoth };

  // cost: 3 #F, positive. mesh and cost outlive this object. Stopped.
  MirroredCuts(const SurfaceMesh& mesh, const MirrorPlane& plane, const Vec& cost,
               const StopCheck& stop = {});
  // Returns whether there are two halves, each in one piece, and a border.
  bool is_parted() const { return halves_[0].mesh && halves_[1].mesh; }

  const MirrorPlane& plane() const { return plane_; }

  // Returns 3 #F flags, both sides, that leave one planar piece. through: any vertices. Stopped.
  std::vector<char> cut(const std::vector<Index>& through, Half mirrored, Ends ends) const;

  // Shortens these cuts from their ends inside the surface up to `part`, a part of the cuts, or to
  // its image.
  std::vector<char> with_images(const std::vector<char>& cuts, const std::vector<char>& part) const;
  // Returns the vertices inside the surface where cuts end.
  std::vector<Index> ends_of(const std::vector<char>& is_cut) const;

 private:
  struct HalfSurface {
    std::shared_ptr<const SurfaceMesh> mesh;
    std::vector<Index> face, vertex;  // of the surface
    std::vector<Index> number;        // #V of the surface: vertex of the half, or -1
    std::vector<char> is_border;      // #V of the half: on the border between both
    Vec cost;
  };

  void part(const std::vector<char>& border);
  std::vector<char> border_of_sides() const;
  void straighten(std::vector<char>& border) const;
  Vec cost_near_plane() const;
  std::vector<Index> terminals(const std::vector<Index>& through, Half half, Ends ends) const;
  Index snapped(const HalfSurface& half, Index v) const;
  Vec cost_near_images(const HalfSurface& of, const std::vector<char>& cuts,
                       const HalfSurface& on) const;
  void add_cuts_of(const HalfSurface& half, const std::vector<char>& cuts,
                   std::vector<char>& is_cut) const;

  bool is_in_plane(Index v) const;
  Vector3 place(Index v) const { return mesh_.positions().row(v); }

  const SurfaceMesh& mesh_;
  const MirrorPlane plane_;
  const Vec& cost_;
  const StopCheck stop_;
  const double edge_;  // mean length
  std::array<HalfSurface, 2> halves_;
  std::vector<char> is_spine_;  // 3 #F, both sides: edges in the plane, which have no image
};

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
