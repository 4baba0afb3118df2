# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# Without a build type, compilers do not optimize, and energies that a program compiles itself run
# 26 times slower (docs/library.md). The default is Release, also for a project that includes this
# one.
get_property(is_multi_config GLOBAL PROPERTY GENERATOR_IS_MULTI_CONFIG)
if(NOT is_multi_config AND NOT CMAKE_BUILD_TYPE)
  message(NOTICE "majorant: no CMAKE_BUILD_TYPE was chosen, so it is Release")
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Release, Debug, RelWithDebInfo or MinSizeRel" FORCE)
endif()
