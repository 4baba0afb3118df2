// What is said of a check of a mesh of volumes, and of how it was optimized: words, and sections of
// the JSON report.
#pragma once

#include <limits>
#include <string>

#include "majorant/apps/jobs/report.h"
#include "majorant/framework/run_record.h"
#include "majorant/volumes/check_volume_mesh.h"
#include "majorant/volumes/optimize_volume_mesh.h"

namespace majorant {

// "384 tetrahedra of degree 2, 8 wedges of degree 1": of the cells that are checked.
std::string elements_in_words(const VolumeMesh& mesh);
// The number of an element in its file.
std::string name_of(const VolumeMesh& mesh, CellName name);
const char* status_of(const VolumeCheck& check);  // "valid", "invalid", "undecided"
// What is wrong, in words; empty where nothing is.
std::string faults_in_words(const VolumeMesh& mesh, const VolumeCheck& check);
// "; 6 shared sides are the same up to a translation (a periodic mesh)"; empty where there are
// none.
std::string periodic_in_words(const VolumeCheck& check);

struct Extremes {
  double low = std::numeric_limits<double>::infinity(), high = low, largest = -low;
};
Extremes extremes_of(const VolumeCheck& check);

// "mesh" of the report; listed: elements in its lists, at most.
Json mesh_section(const VolumeMesh& mesh, const VolumeCheck& check, int listed);
// "element 12 (tetrahedra, region 7): min det J in [-1, -1] at (0, 0, 0), scaled Jacobian -0.8".
std::string element_in_words(const VolumeMesh& mesh, const CheckedCell& cell);
// Lines of the elements that are not proven to be valid, the worst first.
std::string bad_elements_in_words(const VolumeMesh& mesh, const VolumeCheck& check, int listed);

// The report of a check. Input of it: the file as the mesh names it.
RunReport volume_check_report(const VolumeMesh& mesh, const VolumeCheck& check, int listed);
// The report of a mesh that was optimized, but for its options and the number of elements that were
// turned before, "turned" of its input.
RunReport optimized_mesh_report(const VolumeMesh& mesh, const VolumeResult& result,
                                const RunRecord& record, int listed);

}  // namespace majorant

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
