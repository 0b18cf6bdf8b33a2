# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# Text files within a program:
#   adit_embed_worlds(OUT FILES ...)   makes the source OUT in the folder of the build, which defines
#                                      built_in_world_files(), sorted by name

function(adit_embed_worlds out)
  cmake_parse_arguments(ARG "" "" "FILES" ${ARGN})
  set(script ${PROJECT_SOURCE_DIR}/cmake/embed_worlds.cmake)
  list(JOIN ARG_FILES "|" files)
  list(TRANSFORM ARG_FILES REPLACE "\\.yaml$" "_drive.txt" OUTPUT_VARIABLE drives)
  foreach(drive ${drives})
    if(NOT EXISTS ${drive})
      list(REMOVE_ITEM drives ${drive})
    endif()
  endforeach()
  add_custom_command(OUTPUT ${CMAKE_CURRENT_BINARY_DIR}/${out}
    COMMAND ${CMAKE_COMMAND} -DFILES=${files} -DOUT=${CMAKE_CURRENT_BINARY_DIR}/${out} -P ${script}
    DEPENDS ${ARG_FILES} ${drives} ${script}
    COMMENT "Embedding the worlds" VERBATIM)
endfunction()
