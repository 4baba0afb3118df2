# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# majorant_precompiled_headers(KIND [OPTIONS flag...] [LINK target...] HEADERS header...)
# majorant_use_precompiled(TARGET KIND)
#
# Precompiles the headers that almost every source of a kind includes. They are headers of other
# projects, so that no change of this project recompiles them. A source still includes what it uses;
# with MAJORANT_PRECOMPILED_HEADERS=OFF nothing is precompiled. Targets of one kind have the same
# compiler flags; definitions that the headers read (fmt's) belong to the kind.
option(MAJORANT_PRECOMPILED_HEADERS "Read Eigen, fmt, gtest and std once per kind of target"
       ${PROJECT_IS_TOP_LEVEL})

# ccache accepts objects with precompiled headers only if it may ignore their macros; clang must not
# write the time of day into the file.
if(MAJORANT_PRECOMPILED_HEADERS AND CMAKE_CXX_COMPILER_LAUNCHER MATCHES "ccache$")
  set(CMAKE_CXX_COMPILER_LAUNCHER
      ${CMAKE_COMMAND} -E env
      CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
      ${CMAKE_CXX_COMPILER_LAUNCHER})
endif()
set(pch_options $<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>)

function(majorant_precompiled_headers kind)
  cmake_parse_arguments(ARG "" "" "OPTIONS;LINK;HEADERS" ${ARGN})
  if(NOT MAJORANT_PRECOMPILED_HEADERS)
    return()
  endif()
  set(source ${PROJECT_BINARY_DIR}/generated/precompiled_${kind}.cpp)
  file(CONFIGURE OUTPUT ${source} CONTENT "// The headers alone.\n")
  set(owner majorant_precompiled_${kind})
  add_library(${owner} OBJECT ${source})
  target_compile_features(${owner} PRIVATE cxx_std_20)
  set_target_properties(${owner} PROPERTIES CXX_EXTENSIONS OFF)
  target_compile_definitions(${owner} PRIVATE ${MAJORANT_ABI_DEFINITIONS})
  target_compile_options(${owner} PRIVATE ${ARG_OPTIONS} ${pch_options})
  target_link_libraries(${owner} PRIVATE Eigen3::Eigen fmt::fmt ${ARG_LINK})
  target_precompile_headers(${owner} PRIVATE ${ARG_HEADERS})
endfunction()

function(majorant_use_precompiled target kind)
  if(NOT MAJORANT_PRECOMPILED_HEADERS)
    return()
  endif()
  target_compile_options(${target} PRIVATE ${pch_options})
  target_link_libraries(${target} PRIVATE fmt::fmt)
  set_target_properties(${target} PROPERTIES CXX_EXTENSIONS OFF)
  target_precompile_headers(${target} REUSE_FROM majorant_precompiled_${kind})
endfunction()
