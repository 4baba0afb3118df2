// Finished maps, the content of map files, as arrays.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <tuple>

#include "majorant/certify/map_proof.h"
#include "majorant/maps/map_file.h"

namespace majorant::python {

using SharedMap = std::shared_ptr<MapFile>;

// The properties that must be proven of a file, in a form that can be pickled: the permitted cuts
// (CutRule); global injectivity; comparison with the surface; comparison of the labels of vertices
// and faces; repair of the mesh with Orientation::AsGiven; permission for charts to lie exactly on
// others; separate layouts of objects (the rest is then that of proof_of_objects()).
using PackedRequest = std::tuple<int, bool, bool, bool, bool, bool, bool>;
PackedRequest packed_request(const ProofRequest& request);
PackedRequest packed_request_of_objects();

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
