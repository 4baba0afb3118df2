#include "apps/parts.h"

#include <fmt/format.h>

#include "majorant/io/read_mesh.h"
#include "majorant/pictures/images/image_file.h"

namespace majorant::app {
namespace {

enum class In { Every, Gpl, Exr, Draco, Meshopt };  // the builds that contain the part

struct Part {
  std::string_view name, licence, use;
  In in = In::Every;
};

constexpr Part kParts[] = {
    {"majorant", "BSD-3-Clause", "this program"},
    {"AMD (SuiteSparse)", "BSD-3-Clause", "orderings of sparse matrices"},
    {"METIS", "Apache-2.0", "orderings of large sparse matrices"},
    {"Eigen", "MPL-2.0", "small and sparse matrices"},
    {"xsimd", "BSD-3-Clause", "vector instructions"},
    {"Boost", "BSL-1.0", "integers of any length, nearest points"},
    {"fmt", "MIT", "texts and numbers"},
    {"nlohmann-json", "MIT", "reports"},
    {"CLI11", "BSD-3-Clause", "this command line"},
    {"zlib", "Zlib", "compressed files"},
    {"libpng", "Libpng", "pictures"},
    {"libjpeg-turbo", "IJG, BSD-3-Clause, Zlib", "pictures to bake"},
    {"OpenEXR, with its Iex and IlmThread, and Imath", "BSD-3-Clause", "pictures to bake", In::Exr},
    {"Draco", "Apache-2.0", "compressed glTF", In::Draco},
    {"meshoptimizer", "MIT", "compressed glTF", In::Meshopt},
    {"cairo, pixman", "MPL-1.1 or LGPL-2.1, MIT", "pictures"},
    {"DejaVu Sans", "Bitstream-Vera", "the letters of pictures"},
    {"FreeType, Fontconfig, Expat, Brotli, X11 (libX11, libxcb and their parts), libuuid, libbsd, "
     "libmd",
     "FTL, MIT, BSD-3-Clause", "of cairo"},
    {"three.js", "MIT", "the pages that it writes"},
    {"GCC's runtime (libstdc++, libgomp)", "GPL-3.0 with GCC-exception-3.1", "C++"},
    {"GNU C library", "LGPL-2.1-or-later", "the system"},
    {"CGAL", "GPL-3.0-or-later", "constrained triangulations", In::Gpl},
    {"libnest2d", "LGPL-3.0", "packing of few charts", In::Gpl},
    {"Clipper (polyclipping)", "BSL-1.0", "of libnest2d", In::Gpl},
    {"NLopt", "LGPL-2.1-or-later", "of libnest2d", In::Gpl},
    {"Ceres", "BSD-3-Clause", "solvers to compare with", In::Gpl},
    {"SuiteSparse (CHOLMOD, CXSparse)", "GPL-2.0-or-later, LGPL-2.1-or-later",
     "--linear-solver cholmod, and of Ceres", In::Gpl},
    {"glog, gflags", "BSD-3-Clause", "of Ceres", In::Gpl},
    {"libunwind, liblzma", "MIT, public domain", "of glog", In::Gpl},
    {"OpenBLAS (BLAS, LAPACK), GCC's libgfortran and libquadmath",
     "BSD-3-Clause, GPL-3.0 with GCC-exception-3.1, LGPL-2.1-or-later", "of CHOLMOD", In::Gpl},
};

bool is_in(const Part& part) {
  switch (part.in) {
    case In::Every:
      return true;
    case In::Gpl:
      return has_gpl_parts();
    case In::Exr:
      return has_exr();
    case In::Draco:
      return has_draco();
    case In::Meshopt:
      return has_meshopt();
  }
  return false;
}

}  // namespace

bool has_gpl_parts() { return MAJORANT_GPL != 0; }

std::string licences() {
  std::string text =
      fmt::format("As a whole: {}\n\n", has_gpl_parts() ? "GPL-3.0-or-later, because of CGAL"
                                                        : "BSD-3-Clause; nothing in it is "
                                                          "under the GPL or LGPL but the system's "
                                                          "libraries");
  for (const Part& part : kParts)
    if (is_in(part)) text += fmt::format("{}: {}; {}\n", part.name, part.licence, part.use);
  text.pop_back();
  return text;
}

}  // namespace majorant::app

// SPDX-FileCopyrightText: 2026 the majorant developers
// SPDX-License-Identifier: BSD-3-Clause
