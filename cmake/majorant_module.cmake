# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# majorant_library(NAME)
# majorant_module(FOLDER [NAME module] [PUBLIC target...] [PRIVATE target...])
#
# A module is an archive `majorant_MODULE` (MODULE is NAME, or the last part of FOLDER) of every
# .cpp of FOLDER and FOLDER/internal. Headers are included as "majorant/FOLDER/x.h", in the tree as
# after install: a link in the build tree makes that path, with one include root per module.
# cmake/public_headers.txt lists the installed headers; those of FOLDER/detail are for templates in
# public headers. Other headers in FOLDER are for other modules, those in FOLDER/internal for the
# module itself. Without MAJORANT_GPL, internal/no_x.cpp replaces internal/x.cpp if it exists.
#
# A module belongs to the last library before it: the framework, solvers of other projects, or
# everything else. With BUILD_SHARED_LIBS the objects of a library are one shared library, which
# programs and the installed package link; tests then link the archives, since they use internal
# symbols. Programs name modules as majorant::MODULE in either case.

set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
             ${CMAKE_CURRENT_LIST_DIR}/public_headers.txt)

# Eigen's heap alignment is part of the binary interface. It is fixed, so that a consumer compiled
# with wider vector instructions can free memory of the library. The value is Eigen's default
# without such instructions, so that archives with the same inline functions, such as Ceres', agree.
set(MAJORANT_ABI_DEFINITIONS EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MALLOC_ALREADY_ALIGNED=1)

# While the major version is 0, every minor version may break programs, so it is part of the name.
set(MAJORANT_SOVERSION ${PROJECT_VERSION_MAJOR})
if(PROJECT_VERSION_MAJOR EQUAL 0)
  string(APPEND MAJORANT_SOVERSION .${PROJECT_VERSION_MINOR})
endif()

# Installed binaries have one search path, which is the same in the build tree: the folders
# ORIGIN... of a target of BUILD_SHARED_LIBS, relative to the binary, and the folders of libraries
# from outside of the project (PETSc from a module of a cluster). `cmake --install` would end a path
# that it changes with an empty entry, which loaders take for the current directory.
function(majorant_search_path target)
  set(path)
  if(BUILD_SHARED_LIBS)
    set(path ${ARGN})
    list(TRANSFORM path PREPEND "$ORIGIN/")
  endif()
  set_target_properties(${target} PROPERTIES INSTALL_RPATH "${path}" BUILD_WITH_INSTALL_RPATH ON
                                             INSTALL_RPATH_USE_LINK_PATH ON)
endfunction()

macro(majorant_library name)
  set(MAJORANT_LIBRARY lib${name})
  set(${MAJORANT_LIBRARY}_modules)
  if(BUILD_SHARED_LIBS)
    add_library(${MAJORANT_LIBRARY} SHARED)
    set_target_properties(${MAJORANT_LIBRARY} PROPERTIES
      OUTPUT_NAME ${name} VERSION ${PROJECT_VERSION} SOVERSION ${MAJORANT_SOVERSION}
      LINKER_LANGUAGE CXX
      # The same relative folder as after install.
      LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/${CMAKE_INSTALL_LIBDIR})
    majorant_search_path(${MAJORANT_LIBRARY} .)
    target_compile_features(${MAJORANT_LIBRARY} PUBLIC cxx_std_20)
    target_compile_definitions(${MAJORANT_LIBRARY} PUBLIC ${MAJORANT_ABI_DEFINITIONS})
    target_include_directories(${MAJORANT_LIBRARY} PUBLIC $<INSTALL_INTERFACE:include>)
    # Only symbols of namespace majorant are exported, none of CGAL, Ceres or Eigen.
    set(map ${PROJECT_SOURCE_DIR}/cmake/exported_symbols.map)
    target_link_options(${MAJORANT_LIBRARY} PRIVATE LINKER:--version-script=${map}
                        LINKER:--no-undefined LINKER:--as-needed)
    set_property(TARGET ${MAJORANT_LIBRARY} APPEND PROPERTY LINK_DEPENDS ${map})
    install(TARGETS ${MAJORANT_LIBRARY} EXPORT ${MAJORANT_LIBRARY}Targets
            LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT libraries
            NAMELINK_COMPONENT development)
  endif()
endmacro()

function(majorant_module folder)
  cmake_parse_arguments(ARG "" "NAME" "PUBLIC;PRIVATE" ${ARGN})
  get_filename_component(name ${folder} NAME)
  if(ARG_NAME)
    set(name ${ARG_NAME})
  endif()
  set(source_dir ${PROJECT_SOURCE_DIR}/${folder})
  file(GLOB sources CONFIGURE_DEPENDS ${source_dir}/*.cpp ${source_dir}/internal/*.cpp)
  foreach(source IN LISTS sources)
    if(source MATCHES "^(.*/)no_([^/]+)$")
      if(MAJORANT_GPL)
        list(REMOVE_ITEM sources ${source})
      else()
        list(REMOVE_ITEM sources ${CMAKE_MATCH_1}${CMAKE_MATCH_2})
      endif()
    endif()
  endforeach()
  set(root ${PROJECT_BINARY_DIR}/include/${name})
  get_filename_component(parent ${root}/majorant/${folder} DIRECTORY)
  file(MAKE_DIRECTORY ${parent})
  if(NOT EXISTS ${root}/majorant/${folder})
    file(CREATE_LINK ${source_dir} ${root}/majorant/${folder} SYMBOLIC)
  endif()

  set(others ${ARG_PUBLIC})
  list(TRANSFORM ARG_PUBLIC REPLACE "^majorant::" "majorant_")
  add_library(majorant_${name} STATIC ${sources})
  target_compile_features(majorant_${name} PUBLIC cxx_std_20)
  target_compile_options(majorant_${name} PRIVATE -Wall -Wextra -Wpedantic -Wshadow)
  # CMAKE_UNITY_BUILD: templates of Eigen are instantiated once per unit. The sixteen files of
  # volumes take 34.5 CPU seconds and 1.5 GB as one unit, 40 s as two units of eight.
  set_target_properties(majorant_${name} PROPERTIES EXPORT_NAME ${name} CXX_EXTENSIONS OFF
                                                    POSITION_INDEPENDENT_CODE ON
                                                    UNITY_BUILD_BATCH_SIZE 16)
  target_compile_definitions(majorant_${name} PUBLIC ${MAJORANT_ABI_DEFINITIONS})
  target_include_directories(majorant_${name} PUBLIC $<BUILD_INTERFACE:${root}>
                                                     $<INSTALL_INTERFACE:include>)
  target_link_libraries(majorant_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  majorant_use_precompiled(majorant_${name} library)

  set(module majorant_${name})
  if(BUILD_SHARED_LIBS)
    target_sources(${MAJORANT_LIBRARY} PRIVATE $<TARGET_OBJECTS:majorant_${name}>)
    target_include_directories(${MAJORANT_LIBRARY} PUBLIC $<BUILD_INTERFACE:${root}>)
    list(FILTER others EXCLUDE REGEX "^majorant::")
    target_link_libraries(${MAJORANT_LIBRARY} PUBLIC ${others} PRIVATE ${ARG_PRIVATE})
    set(module majorant_${name}_of_library)
    add_library(${module} INTERFACE)
    set_target_properties(${module} PROPERTIES EXPORT_NAME ${name})
    target_link_libraries(${module} INTERFACE ${MAJORANT_LIBRARY})
  endif()
  add_library(majorant::${name} ALIAS ${module})
  install(TARGETS ${module} EXPORT ${MAJORANT_LIBRARY}Targets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  file(STRINGS ${PROJECT_SOURCE_DIR}/cmake/public_headers.txt headers
       REGEX "^majorant/${folder}/((detail|materials)/)?[^/]+$")
  if(NOT MAJORANT_GPL)
    list(FILTER headers EXCLUDE REGEX "/ceres_(minimizer|methods).h$")
  endif()
  if(NOT CHOLMOD_FOUND)
    list(FILTER headers EXCLUDE REGEX "/cholmod_(solver|methods).h$")
  endif()
  foreach(header IN LISTS headers)
    get_filename_component(below ${header} DIRECTORY)
    string(REPLACE "majorant/" "${PROJECT_SOURCE_DIR}/" header ${header})
    install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/${below} COMPONENT development)
  endforeach()
  set(${MAJORANT_LIBRARY}_modules ${name} ${${MAJORANT_LIBRARY}_modules} PARENT_SCOPE)
endfunction()

# A library that the command loads on demand (apps/plugins/plugin.h): lib${target}.so, beside the
# command in the build tree, in its own folder after install. It is not installed if only the
# command was built.
function(majorant_plugin target component)
  cmake_parse_arguments(ARG "" "" "LINK" ${ARGN})
  add_library(${target}_plugin MODULE ${ARG_UNPARSED_ARGUMENTS})
  set_target_properties(${target}_plugin PROPERTIES
                        OUTPUT_NAME ${target} LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/apps
                        CXX_EXTENSIONS OFF)
  target_compile_definitions(${target}_plugin PRIVATE MAJORANT_VERSION="${PROJECT_VERSION}")
  target_compile_options(${target}_plugin PRIVATE -Wall -Wextra -Wpedantic -Wshadow)
  target_include_directories(${target}_plugin PRIVATE ${PROJECT_SOURCE_DIR})
  target_link_libraries(${target}_plugin PRIVATE ${ARG_LINK})
  set(symbols ${PROJECT_SOURCE_DIR}/cmake/plugin_symbols.map)
  target_link_options(${target}_plugin PRIVATE LINKER:--version-script=${symbols}
                                               LINKER:--no-undefined LINKER:--as-needed)
  set_property(TARGET ${target}_plugin APPEND PROPERTY LINK_DEPENDS ${symbols})
  add_dependencies(majorant_command ${target}_plugin)
  file(RELATIVE_PATH libraries /${CMAKE_INSTALL_BINDIR} /${CMAKE_INSTALL_LIBDIR})
  majorant_search_path(${target}_plugin .. ${libraries})
  install(TARGETS ${target}_plugin LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/majorant
          COMPONENT ${component} OPTIONAL)
endfunction()

# Objects that are compiled separately from the others of a module.
function(majorant_add_objects name objects)
  target_sources(majorant_${name} PRIVATE $<TARGET_OBJECTS:${objects}>)
  if(BUILD_SHARED_LIBS)
    target_sources(${MAJORANT_LIBRARY} PRIVATE $<TARGET_OBJECTS:${objects}>)
  endif()
endfunction()

# majorant::majorant, for programs: every module of both libraries.
function(majorant_umbrella)
  add_library(majorant INTERFACE)
  add_library(majorant::majorant ALIAS majorant)
  if(BUILD_SHARED_LIBS)
    target_link_libraries(libmajorant PUBLIC libmajorant_framework)
    target_link_libraries(majorant INTERFACE libmajorant)
    if(TARGET libmajorant_solvers)
      target_link_libraries(libmajorant_solvers PUBLIC libmajorant_framework)
      target_link_libraries(majorant INTERFACE libmajorant_solvers)
    endif()
  else()
    set(modules ${libmajorant_modules} ${libmajorant_solvers_modules} ${libmajorant_framework_modules})
    list(TRANSFORM modules PREPEND majorant_)
    target_link_libraries(majorant INTERFACE ${modules})
  endif()
  set(root ${PROJECT_BINARY_DIR}/include/majorant)
  file(MAKE_DIRECTORY ${root}/majorant/parametrization)
  foreach(name majorant.h parametrization/adapters parametrization/parametrization.h)
    file(CREATE_LINK ${PROJECT_SOURCE_DIR}/${name} ${root}/majorant/${name} SYMBOLIC)
  endforeach()
  target_include_directories(majorant INTERFACE $<BUILD_INTERFACE:${root}>
                                                $<INSTALL_INTERFACE:include>)
endfunction()
