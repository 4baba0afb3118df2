# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# The package: find_package(majorant [COMPONENTS framework]), pkg-config, licence, CITATION.cff.
include(CMakePackageConfigHelpers)
install(TARGETS majorant EXPORT libmajorantTargets COMPONENT development)
install(FILES majorant.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/majorant COMPONENT development)
install(FILES parametrization/parametrization.h
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/majorant/parametrization COMPONENT development)
install(DIRECTORY parametrization/adapters
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/majorant/parametrization COMPONENT development)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/majorant)
set(libraries libmajorant_framework libmajorant)
if(MAJORANT_GPL)
  list(APPEND libraries libmajorant_solvers)
endif()
foreach(library IN LISTS libraries)
  install(EXPORT ${library}Targets NAMESPACE majorant:: DESTINATION ${package_dir}
          COMPONENT development)
endforeach()
configure_package_config_file(cmake/majorantConfig.cmake.in
                              ${PROJECT_BINARY_DIR}/majorantConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/majorantConfigVersion.cmake
                                 COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/majorantConfig.cmake
              ${PROJECT_BINARY_DIR}/majorantConfigVersion.cmake
              cmake/FindCairo.cmake cmake/FindOrderings.cmake cmake/FindXsimdHeaders.cmake
        DESTINATION ${package_dir} COMPONENT development)
if(MAJORANT_GPL)
  install(FILES cmake/FindNest2D.cmake cmake/FindCHOLMOD.cmake DESTINATION ${package_dir}
          COMPONENT development)
endif()

# pkg-config. Shared libraries name their dependencies; with archives, all dependencies are listed.
file(RELATIVE_PATH MAJORANT_PREFIX_FROM_PC /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
list(JOIN MAJORANT_ABI_DEFINITIONS " -D" MAJORANT_PC_DEFINITIONS)
set(framework_packages "fmt")
set(framework_libraries "-lamd -lcamd -lmetis -pthread")
set(majorant_packages "zlib, libpng, libjpeg, cairo")
if(OpenEXR_FOUND)
  string(APPEND majorant_packages ", OpenEXR")
endif()
if(draco_FOUND)
  string(APPEND majorant_packages ", draco")
endif()
set(majorant_libraries "")
if(meshoptimizer_FOUND)
  string(APPEND majorant_libraries " -lmeshoptimizer")
endif()
set(MAJORANT_LICENCE "BSD-3-Clause")
if(MAJORANT_GPL)
  string(APPEND majorant_libraries " -lceres -lnlopt_cxx -lnlopt -lpolyclipping")
  set(MAJORANT_LICENCE "GPL-3.0-or-later")
  if(CHOLMOD_FOUND)
    string(APPEND majorant_libraries " -lcholmod")
  endif()
endif()
set(libmajorant_modules ${libmajorant_modules} ${libmajorant_solvers_modules})
foreach(name framework majorant)
  set(packages "${${name}_packages}")
  set(libraries "${${name}_libraries}")
  if(BUILD_SHARED_LIBS)
    set(file majorant_framework)
    if(name STREQUAL "majorant")
      set(file majorant)
    endif()
    if(name STREQUAL "majorant" AND MAJORANT_GPL)
      string(APPEND file " -lmajorant_solvers")
    endif()
    set(MAJORANT_PC_${name} "Libs: -L\${libdir} -l${file}
Requires.private: ${packages}
Libs.private: ${libraries}")
  else()
    set(library libmajorant)
    if(name STREQUAL "framework")
      set(library libmajorant_framework)
    endif()
    list(TRANSFORM ${library}_modules PREPEND -lmajorant_ OUTPUT_VARIABLE modules)
    list(JOIN modules " " modules)
    set(MAJORANT_PC_${name} "Libs: -L\${libdir} ${modules} ${libraries}")
    set(MAJORANT_PC_${name}_PACKAGES ", ${packages}")
  endif()
endforeach()
foreach(file majorant majorant-framework)
  configure_file(cmake/${file}.pc.in ${PROJECT_BINARY_DIR}/${file}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${file}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig
          COMPONENT development)
endforeach()

install(FILES LICENSE CITATION.cff README.md
        DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/majorant COMPONENT command)
