# majorant_module(FOLDER [PUBLIC target...] [PRIVATE target...])
#
# One room of the house = one static library `majorant_ROOM` (alias majorant::ROOM; ROOM is the last
# part of FOLDER), made of every .cpp of FOLDER and FOLDER/internal. Headers are included as
# "majorant/FOLDER/x.h", inside the tree as after install; a link in the build tree makes that path,
# one include root per room. Those of FOLDER/internal are not installed, those of FOLDER/detail are,
# because templates in public headers need them.

# Eigen's heap alignment is part of the binary interface: fixed, so that a consumer compiled with
# wider vector instructions frees what we allocate.
set(MAJORANT_ABI_DEFINITIONS EIGEN_MAX_ALIGN_BYTES=16 EIGEN_MALLOC_ALREADY_ALIGNED=0)

function(majorant_module folder)
  cmake_parse_arguments(ARG "" "" "PUBLIC;PRIVATE" ${ARGN})
  get_filename_component(name ${folder} NAME)
  set(source_dir ${PROJECT_SOURCE_DIR}/${folder})
  file(GLOB sources CONFIGURE_DEPENDS ${source_dir}/*.cpp ${source_dir}/internal/*.cpp)
  set(root ${PROJECT_BINARY_DIR}/include/${name})
  get_filename_component(parent ${root}/majorant/${folder} DIRECTORY)
  file(MAKE_DIRECTORY ${parent})
  if(NOT EXISTS ${root}/majorant/${folder})
    file(CREATE_LINK ${source_dir} ${root}/majorant/${folder} SYMBOLIC)
  endif()

  add_library(majorant_${name} STATIC ${sources})
  add_library(majorant::${name} ALIAS majorant_${name})
  target_compile_features(majorant_${name} PUBLIC cxx_std_20)
  target_compile_options(majorant_${name} PRIVATE -Wall -Wextra -Wpedantic -Wshadow)
  set_target_properties(majorant_${name} PROPERTIES EXPORT_NAME ${name} CXX_EXTENSIONS OFF
                                                    POSITION_INDEPENDENT_CODE ON)
  target_compile_definitions(majorant_${name} PUBLIC ${MAJORANT_ABI_DEFINITIONS})
  target_include_directories(majorant_${name} PUBLIC $<BUILD_INTERFACE:${root}>
                                                     $<INSTALL_INTERFACE:include>)
  target_link_libraries(majorant_${name} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  if("OpenMP::OpenMP_CXX" IN_LIST ARG_PRIVATE)
    majorant_use_precompiled(majorant_${name} threaded_library)
  else()
    majorant_use_precompiled(majorant_${name} library)
  endif()
  install(TARGETS majorant_${name} EXPORT majorantTargets
          ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY ${source_dir}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/majorant/${folder}
          FILES_MATCHING PATTERN "*.h" PATTERN internal EXCLUDE PATTERN densities EXCLUDE
          PATTERN kernels EXCLUDE)
endfunction()

# The exported package: find_package(majorant) gives majorant::majorant (everything) and one target
# per room.
function(majorant_install_package)
  include(CMakePackageConfigHelpers)
  add_library(majorant INTERFACE)
  add_library(majorant::majorant ALIAS majorant)
  target_link_libraries(majorant INTERFACE majorant_results majorant_terms)
  set(root ${PROJECT_BINARY_DIR}/include/majorant)
  file(MAKE_DIRECTORY ${root}/majorant)
  file(CREATE_LINK ${PROJECT_SOURCE_DIR}/majorant.h ${root}/majorant/majorant.h SYMBOLIC)
  target_include_directories(majorant INTERFACE $<BUILD_INTERFACE:${root}>
                                                $<INSTALL_INTERFACE:include>)
  install(FILES majorant.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/majorant)
  install(TARGETS majorant EXPORT majorantTargets)
  set(destination ${CMAKE_INSTALL_LIBDIR}/cmake/majorant)
  install(EXPORT majorantTargets NAMESPACE majorant:: DESTINATION ${destination})
  configure_package_config_file(cmake/majorantConfig.cmake.in
                                ${PROJECT_BINARY_DIR}/majorantConfig.cmake
                                INSTALL_DESTINATION ${destination})
  write_basic_package_version_file(${PROJECT_BINARY_DIR}/majorantConfigVersion.cmake
                                   COMPATIBILITY SameMinorVersion)
  install(FILES ${PROJECT_BINARY_DIR}/majorantConfig.cmake
                ${PROJECT_BINARY_DIR}/majorantConfigVersion.cmake
                cmake/FindCHOLMOD.cmake cmake/FindNest2D.cmake cmake/FindXsimdHeaders.cmake
          DESTINATION ${destination})
endfunction()
