# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# cmake "-DFILES=a.yaml|b.yaml" -DOUT=files.cpp -P embed_worlds.cmake
#
# The text of each file goes into a raw string; its name is that of the file without its ending.

string(REPLACE "|" ";" files "${FILES}")
list(SORT files)
set(code "#include \"sim/world/built_in_world_files.hpp\"\n\nnamespace adit {\n"
         "std::vector<WorldFileText> built_in_world_files() {\n  return {\n")
foreach(file ${files})
  get_filename_component(name ${file} NAME_WE)
  file(READ ${file} text)
  string(APPEND code "      {\"${name}\", R\"world(${text})world\"},\n")
endforeach()
string(APPEND code "  };\n}\n}  // namespace adit\n")
file(WRITE ${OUT} "${code}")
