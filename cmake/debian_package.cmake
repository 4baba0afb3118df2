# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# CPack makes majorant, the command with its manual; libmajorant-dev, headers and archives; with
# BUILD_SHARED_LIBS also a package of the shared libraries. Run `cpack -G DEB` in the build tree.
# Dependencies are determined from the binaries (dpkg-shlibdeps); without it, packing fails.
set(CPACK_GENERATOR DEB)
set(CPACK_PROJECT_CONFIG_FILE ${PROJECT_SOURCE_DIR}/cmake/packaging_tools.cmake)
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # tests and examples are not packed
set(CPACK_PACKAGE_VENDOR "the majorant developers")
set(CPACK_PACKAGE_CONTACT "the majorant developers <majorant@localhost>" CACHE STRING
    "Who maintains the Debian packages")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "low-distortion, injective maps of surfaces onto the plane")
set(about "Flattens surfaces: texture layouts without overlaps, or one map made of
Bezier triangles, proven to be injective.")
set(CPACK_COMPONENT_COMMAND_DESCRIPTION "${about}
This is the command.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "${about}
These are the headers and libraries to compile programs with.")
set(CPACK_COMPONENT_LIBRARIES_DESCRIPTION "${about}
These are the shared libraries.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL command development)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_COMMAND_PACKAGE_NAME majorant)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libmajorant-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)
set(development_depends libeigen3-dev libxsimd-dev)
if(BUILD_SHARED_LIBS)
  set(libraries libmajorant${MAJORANT_SOVERSION})
  list(APPEND CPACK_COMPONENTS_ALL libraries)
  set(CPACK_DEBIAN_LIBRARIES_PACKAGE_NAME ${libraries})
  set(CPACK_DEBIAN_LIBRARIES_PACKAGE_SECTION libs)
  set(CPACK_DEBIAN_LIBRARIES_PACKAGE_GENERATE_SHLIBS ON)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR})
  set(CPACK_DEBIAN_COMMAND_PACKAGE_DEPENDS "${libraries} (= ${PROJECT_VERSION})")
  list(APPEND development_depends "${libraries} (= ${PROJECT_VERSION})")
else()
  list(APPEND development_depends libfmt-dev libsuitesparse-dev libmetis-dev nlohmann-json3-dev
                                  zlib1g-dev libpng-dev libjpeg-dev libcairo2-dev)
  if(OpenEXR_FOUND)
    list(APPEND development_depends libopenexr-dev)
  endif()
  foreach(codec draco meshoptimizer)
    if(${codec}_FOUND)
      list(APPEND development_depends lib${codec}-dev)
    endif()
  endforeach()
  if(MAJORANT_GPL)
    list(APPEND development_depends libceres-dev libnest2d-dev libpolyclipping-dev
                                    libnlopt-cxx-dev)
  endif()
endif()
list(JOIN development_depends ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)

# Debian requires the licence of each package as share/doc/PACKAGE/copyright, and its changelog.
set(copyright_comment "The program links what `majorant --licenses` lists.")
if(MAJORANT_GPL)
  string(APPEND copyright_comment " CGAL among it makes the binary as a whole one under the GPL-3.0-or-later,
 whose text is in /usr/share/common-licenses/GPL-3.")
endif()
file(READ LICENSES/BSD-3-Clause.txt bsd_text)
file(READ LICENSES/MIT.txt mit_text)
foreach(text bsd_text mit_text)  # as continuation lines
  string(STRIP "${${text}}" ${text})
  string(REGEX REPLACE "\n" "\n " ${text} " ${${text}}")
  string(REPLACE "\n \n" "\n .\n" ${text} "${${text}}")
endforeach()
configure_file(cmake/copyright.in ${PROJECT_BINARY_DIR}/copyright @ONLY)
execute_process(COMMAND gzip -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md
                OUTPUT_FILE ${PROJECT_BINARY_DIR}/changelog.gz)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  install(FILES ${PROJECT_BINARY_DIR}/copyright ${PROJECT_BINARY_DIR}/changelog.gz
          DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME}
          COMPONENT ${component})
endforeach()
include(CPack)
