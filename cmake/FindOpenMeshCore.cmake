# Debian's OpenMesh config lists library paths only. Defines OpenMeshCore::OpenMeshCore.
find_path(OPENMESH_INCLUDE_DIR OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh)
find_library(OPENMESH_CORE_LIBRARY OpenMeshCore)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(OpenMeshCore DEFAULT_MSG OPENMESH_CORE_LIBRARY
                                  OPENMESH_INCLUDE_DIR)
if(OpenMeshCore_FOUND AND NOT TARGET OpenMeshCore::OpenMeshCore)
  add_library(OpenMeshCore::OpenMeshCore UNKNOWN IMPORTED)
  set_target_properties(OpenMeshCore::OpenMeshCore PROPERTIES
    IMPORTED_LOCATION ${OPENMESH_CORE_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${OPENMESH_INCLUDE_DIR})
endif()
mark_as_advanced(OPENMESH_INCLUDE_DIR OPENMESH_CORE_LIBRARY)
