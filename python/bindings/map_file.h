// Finished maps: what files hold, as arrays.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <tuple>

#include "majorant/certify/map_proof.h"
#include "majorant/maps/map_file.h"

namespace majorant::python {

using SharedMap = std::shared_ptr<MapFile>;

// The properties that a file made of a map must be proven to have, in a form that can be pickled:
// the cuts it may have (CutRule), whether it is injective as a whole, whether the surface and the
// labels of vertices and faces are compared with those of the mesh, whether defects of the mesh are
// repaired with Orientation::AsGiven, whether charts may lie exactly on others, whether objects
// have layouts of their own (all else is as proof_of_objects() has it then).
using Promise = std::tuple<int, bool, bool, bool, bool, bool, bool>;
Promise promise_from(const ProofRequest& request);
Promise promise_of_objects();

}  // namespace majorant::python

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
