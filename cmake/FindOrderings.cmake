# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# The libraries that order sparse matrices: AMD and CAMD (BSD-3-Clause) of SuiteSparse, whose Debian
# package ships no CMake config, and METIS (Apache-2.0). Variables with the libraries' own names
# belong to the find modules of Ceres. Defines Orderings::Orderings.
find_path(ORDERING_AMD_INCLUDE_DIR amd.h PATH_SUFFIXES suitesparse)
find_library(ORDERING_AMD_LIBRARY amd)
find_library(ORDERING_CAMD_LIBRARY camd)
find_path(ORDERING_METIS_INCLUDE_DIR metis.h)
find_library(ORDERING_METIS_LIBRARY metis)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Orderings DEFAULT_MSG ORDERING_AMD_LIBRARY ORDERING_CAMD_LIBRARY ORDERING_AMD_INCLUDE_DIR
                                  ORDERING_METIS_LIBRARY ORDERING_METIS_INCLUDE_DIR)
if(Orderings_FOUND AND NOT TARGET Orderings::Orderings)
  add_library(Orderings::Orderings INTERFACE IMPORTED)
  set_target_properties(Orderings::Orderings PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${ORDERING_AMD_INCLUDE_DIR};${ORDERING_METIS_INCLUDE_DIR}"
    INTERFACE_LINK_LIBRARIES "${ORDERING_AMD_LIBRARY};${ORDERING_CAMD_LIBRARY};${ORDERING_METIS_LIBRARY}")
endif()
mark_as_advanced(ORDERING_AMD_INCLUDE_DIR ORDERING_AMD_LIBRARY ORDERING_CAMD_LIBRARY ORDERING_METIS_INCLUDE_DIR ORDERING_METIS_LIBRARY)
