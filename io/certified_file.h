// Written means certified: a data file is read back through the public reader and proven before it
// takes its name.
//
//   write_vtu("bunny.vtu", file, certification("bunny.vtu", {.surface = &polygons}));
#pragma once

#include <string>

#include "majorant/io/atomic_file.h"
#include "majorant/io/map_proof.h"

namespace majorant {

// path: of the file to be, for messages; its extension says how to read. wanted: what must be
// proven (what it refers to must outlive the verification). Throws Error(Invalid) naming the file,
// the question and the place when it is not.
FileVerification certification(std::string path, ProofRequest wanted);

}  // namespace majorant
