# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# libnest2d 5 is header-only; Debian's config requires modules that it does not ship. It needs
# Clipper, NLopt and Boost's headers. Its threads are those of OpenMP, which is off here. Defines
# Nest2D::Nest2D.
find_path(NEST2D_INCLUDE_DIR libnest2d/libnest2d.hpp)
find_path(POLYCLIPPING_INCLUDE_DIR clipper.hpp PATH_SUFFIXES polyclipping)
find_path(NLOPT_INCLUDE_DIR nlopt.hpp)
find_path(NEST2D_BOOST_INCLUDE_DIR boost/geometry.hpp)
find_library(POLYCLIPPING_LIBRARY polyclipping)
find_library(NLOPT_CXX_LIBRARY nlopt_cxx)
find_library(NLOPT_LIBRARY nlopt)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Nest2D DEFAULT_MSG NEST2D_INCLUDE_DIR POLYCLIPPING_INCLUDE_DIR
                                  NLOPT_INCLUDE_DIR NEST2D_BOOST_INCLUDE_DIR POLYCLIPPING_LIBRARY
                                  NLOPT_CXX_LIBRARY NLOPT_LIBRARY)
if(Nest2D_FOUND AND NOT TARGET Nest2D::Nest2D)
  find_package(Threads REQUIRED)
  add_library(Nest2D::Nest2D INTERFACE IMPORTED)
  set_target_properties(Nest2D::Nest2D PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES
    "${NEST2D_INCLUDE_DIR};${POLYCLIPPING_INCLUDE_DIR};${NLOPT_INCLUDE_DIR};${NEST2D_BOOST_INCLUDE_DIR}"
    INTERFACE_COMPILE_DEFINITIONS
    "LIBNEST2D_GEOMETRIES_clipper;LIBNEST2D_OPTIMIZER_nlopt;LIBNEST2D_THREADING_omp"
    INTERFACE_LINK_LIBRARIES
    "${POLYCLIPPING_LIBRARY};${NLOPT_CXX_LIBRARY};${NLOPT_LIBRARY};Threads::Threads")
endif()
mark_as_advanced(NEST2D_INCLUDE_DIR POLYCLIPPING_INCLUDE_DIR NLOPT_INCLUDE_DIR
                 NEST2D_BOOST_INCLUDE_DIR POLYCLIPPING_LIBRARY NLOPT_CXX_LIBRARY NLOPT_LIBRARY)
