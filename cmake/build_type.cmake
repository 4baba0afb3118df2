# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# Without a build type compilers optimize nothing, and energies that a program compiles itself run
# 26 times slower (docs/library.md). Where nobody has chosen one it is Release, for a project that
# includes this one, too.
get_property(is_multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if(NOT is_multi_config AND NOT CMAKE_BUILD_TYPE)
  message(NOTICE "majorant: no CMAKE_BUILD_TYPE was chosen, so it is Release")
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug, RelWithDebInfo or MinSizeRel" FORCE)
endif()
