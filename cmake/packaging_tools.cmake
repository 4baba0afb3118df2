# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# cpack reads this file before packing. Without these two tools it would make packages without
# dependencies.
if(CPACK_GENERATOR STREQUAL "DEB")
  set(missing)
  foreach(entry dpkg-shlibdeps/dpkg-dev file/file)
    string(REPLACE "/" ";" entry ${entry})
    list(GET entry 0 program)
    find_program(packaging_${program} ${program} NO_CACHE NO_CMAKE_SYSTEM_PATH)
    if(NOT packaging_${program})
      list(GET entry 1 package)
      string(APPEND missing " ${package}")
    endif()
  endforeach()
  if(missing)
    message(FATAL_ERROR " cpack -G DEB asks other programs what ours depend on: apt-get install${missing}")
  endif()
endif()
