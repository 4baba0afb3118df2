# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# Kernels that are compiled for several instruction sets from one source each and chosen at run
# time: those of the built-in densities (the baseline's are compiled in named_energies.cpp), those
# of formulas that users compile, and those of the sparse factorization.
set(sets)
# With sanitizers g++ 12 needs many minutes to optimize these files, so only the baseline is
# compiled, without optimization.
if(CMAKE_CXX_FLAGS MATCHES "fsanitize")
  set_source_files_properties(energies/named_energies.cpp energies/kernels/point_kernels.cpp
                              PROPERTIES COMPILE_OPTIONS -O0 SKIP_PRECOMPILE_HEADERS ON)
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  list(APPEND sets avx2 avx512)
  set(flags_avx2 -mavx2 -mfma)
  set(flags_avx512 -mavx512f -mavx512dq -mavx512bw -mavx512cd -mavx512vl -mfma)
  set(name_avx2 "AVX2")
  set(name_avx512 "AVX-512")
  target_compile_definitions(majorant_energies PRIVATE MAJORANT_X86_KERNELS)
  target_compile_definitions(majorant_framework PRIVATE MAJORANT_X86_KERNELS)
  target_compile_definitions(majorant_terms PRIVATE MAJORANT_X86_KERNELS)
endif()
set(name_baseline "baseline")
# Kernels of the framework: the tables of framework/kernels and framework/terms/kernels.
function(majorant_table_kernels module folder name set)
  set(target majorant_${name}_${set})
  add_library(${target} OBJECT ${PROJECT_SOURCE_DIR}/${folder}/kernels/${name}.cpp)
  target_link_libraries(${target} PRIVATE Eigen3::Eigen XsimdHeaders::XsimdHeaders)
  target_include_directories(${target} PRIVATE ${PROJECT_BINARY_DIR}/include/framework
                                               ${PROJECT_BINARY_DIR}/include/${module})
  target_compile_features(${target} PRIVATE cxx_std_20)
  target_compile_options(${target} PRIVATE ${flags_${set}} -Wall -Wextra
                         $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized -Wno-uninitialized>)
  target_compile_definitions(${target} PRIVATE MAJORANT_KERNEL_NAME=${name}_${set}
                                               MAJORANT_INSTRUCTION_SET="${name_${set}}"
                                               ${MAJORANT_ABI_DEFINITIONS})
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_EXTENSIONS OFF)
  majorant_add_objects(${module} ${target})
endfunction()
foreach(set baseline ${sets})
  majorant_table_kernels(framework framework front_kernels ${set})
  majorant_table_kernels(terms framework/terms tape_kernels ${set})
endforeach()
# Kernels of the energies: built-in densities, and formulas that users compile.
function(majorant_energy_kernels name set)
  set(target majorant_${name}_${set})
  add_library(${target} OBJECT ${PROJECT_SOURCE_DIR}/energies/kernels/${name}.cpp)
  target_link_libraries(${target} PRIVATE majorant_elements XsimdHeaders::XsimdHeaders)
  target_include_directories(${target} PRIVATE ${PROJECT_BINARY_DIR}/include/energies)
  # g++ 12 warns of its own _mm512_undefined_pd (GCC bug 105593).
  target_compile_options(${target} PRIVATE ${flags_${set}} -Wall -Wextra
                         $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized -Wno-uninitialized>)
  target_compile_definitions(${target} PRIVATE MAJORANT_KERNEL_NAME=${name}_${set}
                             $<$<NOT:$<STREQUAL:${set},baseline>>:MAJORANT_USUAL_MODELS>)
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON CXX_EXTENSIONS OFF)
  majorant_add_objects(energies ${target})
endfunction()
foreach(set ${sets})
  majorant_energy_kernels(builtin_kernels ${set})
endforeach()
foreach(set baseline ${sets})
  majorant_energy_kernels(point_kernels ${set})
  majorant_energy_kernels(solid_invariant_kernels ${set})
endforeach()
