# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# Boost.Multiprecision, which is header-only. Defines BoostHeaders::BoostHeaders.
find_path(BOOST_MULTIPRECISION_INCLUDE_DIR boost/multiprecision/cpp_int.hpp)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(BoostHeaders DEFAULT_MSG BOOST_MULTIPRECISION_INCLUDE_DIR)
if(BoostHeaders_FOUND AND NOT TARGET BoostHeaders::BoostHeaders)
  add_library(BoostHeaders::BoostHeaders INTERFACE IMPORTED)
  set_target_properties(BoostHeaders::BoostHeaders PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES ${BOOST_MULTIPRECISION_INCLUDE_DIR})
endif()
mark_as_advanced(BOOST_MULTIPRECISION_INCLUDE_DIR)
