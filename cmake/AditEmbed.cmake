# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Text files that are compiled into a program:
#   adit_embed(OUT HEADER h TYPE t FUNCTION f FILES ...)
# generates the source OUT in the build folder. It includes HEADER and defines `std::vector<TYPE> FUNCTION()`
# in namespace adit, which returns {name without extension, text} of each file, sorted by path.

function(adit_embed out)
  cmake_parse_arguments(ARG "" "HEADER;TYPE;FUNCTION" "FILES" ${ARGN})
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_files.cmake)
  list(JOIN ARG_FILES "|" files)
  add_custom_command(OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${out}
    COMMAND ${CMAKE_COMMAND} -DFILES=${files} -DHEADER=${ARG_HEADER} -DTYPE=${ARG_TYPE}
            -DFUNCTION=${ARG_FUNCTION} -DOUT=${CMAKE_CURRENT_BINARY_DIR}/${out} -P ${script}
    DEPENDS ${ARG_FILES} ${script}
    COMMENT "Embedding the files of ${ARG_FUNCTION}()" VERBATIM)
endfunction()
