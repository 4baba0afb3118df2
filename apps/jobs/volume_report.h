// Summaries and report sections about the check and the optimization of a volume mesh.
#pragma once

#include <limits>
#include <string>

#include "majorant/apps/jobs/report.h"
#include "majorant/framework/run_record.h"
#include "majorant/volumes/check_volume_mesh.h"
#include "majorant/volumes/optimize_volume_mesh.h"

namespace majorant {

// Returns "384 tetrahedra of degree 2, 8 wedges of degree 1", the cells that are checked.
std::string elements_in_words(const VolumeMesh& mesh);
// Returns the number of an element in its file.
std::string name_of(const VolumeMesh& mesh, CellName name);
const char* status_of(const VolumeCheck& check);  // returns "valid", "invalid" or "undecided"
// Returns the faults in words; empty without faults.
std::string faults_in_words(const VolumeMesh& mesh, const VolumeCheck& check);
// Returns "; 6 shared sides are the same up to a translation (a periodic mesh)"; empty if there are
// none.
std::string periodic_in_words(const VolumeCheck& check);

struct Extremes {
  double low = std::numeric_limits<double>::infinity(), high = low, largest = -low;
};
Extremes extremes_of(const VolumeCheck& check);

// Returns "mesh" of the report; listed: largest number of elements in its lists.
Json mesh_section(const VolumeMesh& mesh, const VolumeCheck& check, int listed);
// Returns "element 12 (tetrahedra, region 7): min det J in [-1, -1] at (0, 0, 0), scaled Jacobian
// -0.8".
std::string element_in_words(const VolumeMesh& mesh, const CheckedCell& cell);
// Returns lines about the elements that are not proven valid, the worst first.
std::string bad_elements_in_words(const VolumeMesh& mesh, const VolumeCheck& check, int listed);

// Returns the report of a check. Its input is the file that the mesh names.
RunReport volume_check_report(const VolumeMesh& mesh, const VolumeCheck& check, int listed);
// Returns the report of an optimized mesh, without its options and without "turned", the number of
// elements that were turned over first.
RunReport optimized_mesh_report(const VolumeMesh& mesh, const VolumeResult& result,
                                const RunRecord& record, int listed);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
