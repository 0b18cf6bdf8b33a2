# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Text files that are compiled into a program:
#   adit_embed(OUT HEADER h TYPE t FUNCTION f [BESIDE suffix] FILES ...)
# generates the source OUT in the build folder. It includes HEADER and defines `std::vector<TYPE> FUNCTION()`
# in namespace adit, which returns {name without extension, text} of each file, sorted by path. With BESIDE a third
# member is the text of the file <name><suffix> in the same folder, empty where there is none.

function(adit_embed out)
  cmake_parse_arguments(ARG "" "HEADER;TYPE;FUNCTION;BESIDE" "FILES" ${ARGN})
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_files.cmake)
  list(JOIN ARG_FILES "|" files)
  set(depends ${ARG_FILES})
  if(ARG_BESIDE)
    foreach(file ${ARG_FILES})
      get_filename_component(stem ${file} NAME_WE)
      get_filename_component(folder ${file} DIRECTORY)
      if(EXISTS ${folder}/${stem}${ARG_BESIDE})
        list(APPEND depends ${folder}/${stem}${ARG_BESIDE})
      endif()
    endforeach()
  endif()
  add_custom_command(OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${out}
    COMMAND ${CMAKE_COMMAND} -DFILES=${files} -DHEADER=${ARG_HEADER} -DTYPE=${ARG_TYPE} -DBESIDE=${ARG_BESIDE}
            -DFUNCTION=${ARG_FUNCTION} -DOUT=${CMAKE_CURRENT_BINARY_DIR}/${out} -P ${script}
    DEPENDS ${depends} ${script}
    COMMENT "Embedding the files of ${ARG_FUNCTION}()" VERBATIM)
endfunction()
