# SPDX-FileCopyrightText: 2026 the majorant developers
# SPDX-License-Identifier: BSD-3-Clause

# The target `docs` makes pages of the public headers, build/PRESET/api/html/index.html, with
# doxygen; without doxygen there is a message. Undocumented declarations are listed in
# api/warnings.txt.
find_program(MAJORANT_DOXYGEN doxygen)
find_package(Python3 COMPONENTS Interpreter QUIET)
if(NOT MAJORANT_DOXYGEN OR NOT Python3_FOUND)
  message(NOTICE "majorant: no doxygen, so no target docs (make test installs it)")
  return()
endif()

file(STRINGS cmake/public_headers.txt headers REGEX "^majorant/")
list(FILTER headers EXCLUDE REGEX "/detail/")
list(TRANSFORM headers REPLACE "^majorant/" "${PROJECT_SOURCE_DIR}/")
list(JOIN headers " " MAJORANT_API_INPUT)
string(PREPEND MAJORANT_API_INPUT "${PROJECT_SOURCE_DIR}/docs/library.md ")
configure_file(cmake/Doxyfile.in ${PROJECT_BINARY_DIR}/api/Doxyfile @ONLY)
add_custom_target(docs COMMAND ${MAJORANT_DOXYGEN} ${PROJECT_BINARY_DIR}/api/Doxyfile
                  COMMENT "API pages: ${PROJECT_BINARY_DIR}/api/html/index.html" VERBATIM)
