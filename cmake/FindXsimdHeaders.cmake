# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# Debian's xsimd config links a library xtl that does not exist; only the headers are needed.
# Defines XsimdHeaders::XsimdHeaders.
find_path(XSIMD_INCLUDE_DIR xsimd/xsimd.hpp)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(XsimdHeaders DEFAULT_MSG XSIMD_INCLUDE_DIR)
if(XsimdHeaders_FOUND AND NOT TARGET XsimdHeaders::XsimdHeaders)
  add_library(XsimdHeaders::XsimdHeaders INTERFACE IMPORTED)
  set_target_properties(XsimdHeaders::XsimdHeaders PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES ${XSIMD_INCLUDE_DIR})
endif()
mark_as_advanced(XSIMD_INCLUDE_DIR)
