# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# cmake "-DFILES=a.yaml|b.yaml" -DOUT=files.cpp -P embed_worlds.cmake
#
# The text of each world file goes into a raw string, and that of `<name>_drive.txt` beside it where there is one.

string(REPLACE "|" ";" files "${FILES}")
list(SORT files)
set(code "#include \"sim/world/built_in_world_files.hpp\"\n\nnamespace adit {\n"
         "std::vector<WorldFileText> built_in_world_files() {\n  return {\n")
foreach(file ${files})
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} text)
  get_filename_component(folder ${file} DIRECTORY)
  set(drive "")
  if(EXISTS ${folder}/${name}_drive.txt)
    file(READ ${folder}/${name}_drive.txt drive)
  endif()
  string(APPEND code "      {\"${name}\", R\"world(${text})world\",\n       R\"drive(${drive})drive\"},\n")
endforeach()
string(APPEND code "  };\n}\n}  // namespace adit\n")
file(WRITE ${OUT} "${code}")
