# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# CGAL 5 is header-only. Its own config links GMP and MPFR and adds flags to everything that links
# it. The triangulations need neither, since exact arithmetic is Boost.Multiprecision's; so only the
# sources that include CGAL depend on it. Defines CGALHeaders::CGALHeaders.
find_path(CGAL_INCLUDE_DIR CGAL/Constrained_Delaunay_triangulation_2.h)
find_path(BOOST_MULTIPRECISION_INCLUDE_DIR boost/multiprecision/cpp_int.hpp)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CGALHeaders DEFAULT_MSG CGAL_INCLUDE_DIR
                                  BOOST_MULTIPRECISION_INCLUDE_DIR)
if(CGALHeaders_FOUND AND NOT TARGET CGALHeaders::CGALHeaders)
  add_library(CGALHeaders::CGALHeaders INTERFACE IMPORTED)
  set_target_properties(CGALHeaders::CGALHeaders PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${CGAL_INCLUDE_DIR};${BOOST_MULTIPRECISION_INCLUDE_DIR}"
    INTERFACE_COMPILE_DEFINITIONS CGAL_DISABLE_GMP)
endif()
mark_as_advanced(CGAL_INCLUDE_DIR BOOST_MULTIPRECISION_INCLUDE_DIR)
