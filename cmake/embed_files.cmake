# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# cmake "-DFILES=a.css|b.html" -DHEADER=h -DTYPE=t -DFUNCTION=f [-DBESIDE=suffix] -DOUT=files.cpp
#       -P embed_files.cmake
#
# Each file becomes a raw string literal. The SPDX comments of HTML, CSS and JavaScript are left out, because
# the text becomes part of the user's files.

string(REPLACE "|" ";" files "${FILES}")
list(SORT files)
string(CONCAT code "#include \"${HEADER}\"\n\nnamespace adit {\n"
       "std::vector<${TYPE}> ${FUNCTION}() {\n  return {\n")
foreach(file ${files})
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} text)
  string(REGEX REPLACE "(<!--|/\\*|//) SPDX-[^\n]*\n" "" text "${text}")
  set(beside "")
  if(BESIDE)
    get_filename_component(folder ${file} DIRECTORY)
    set(text_beside "")
    if(EXISTS ${folder}/${name}${BESIDE})
      file(READ ${folder}/${name}${BESIDE} text_beside)
    endif()
    set(beside ", R\"embedded(${text_beside})embedded\"")
  endif()
  string(APPEND code "      {\"${name}\", R\"embedded(${text})embedded\"${beside}},\n")
endforeach()
string(APPEND code "  };\n}\n}  // namespace adit\n")
file(WRITE ${OUT} "${code}")
