// Written means certified: a data file is read back through the public reader and proven before it
// takes its name.
//
//   write_vtu("bunny.vtu", file, certification("bunny.vtu", {.surface = &polygons}));
//
// Not for pictures and pages, which promise nothing.
#pragma once

#include <functional>
#include <string>

#include "majorant/certify/map_proof.h"
#include "majorant/parametrization/maps/map_file.h"

namespace majorant {

// Judges the complete bytes of a file before they take its name. The path given is that of another
// file with the same extension. Throws when the file must not be written.
using FileVerification = std::function<void(const std::string& temporary_path)>;

// path: of the file to be, for messages; its extension says how to read. wanted: what must be
// proven; where seams are allowed and the file does not claim any, its cones must not need them
// either. image_of: of a .msh that is an image, the map that it shows: as the image has no surface,
// the map with the image's digits is proven, and the image as a map of the plane. What these refer
// to must outlive the verification. Throws Error(Invalid) naming the file, the question and the
// place when it is not.
FileVerification certification(std::string path, ProofRequest wanted,
                               const MapFile* image_of = nullptr);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
