# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# awk -v out=DIR -v skipped=SKIPPED -f lint_batches.awk COMMANDS
# Prepares clang-tidy, which spends most of its time on shared headers, to check many sources at once. To be called in the
# root of the tree. COMMANDS has a line `directory TAB command TAB source` for each source. DIR/compile_commands.json gets
# these commands, and those of the batches: DIR/batch_N.cpp includes the sources that DIR/batch_N.list names. Prints the
# names of the batches, the slowest first. Sources that match SKIPPED are in no batch.
#
# The sources of a batch have the same options, definitions and include folders excepted, and no name of an unnamed
# namespace of one is also in that of another, or in a header that another includes; each `main` gets a name of its own.
# A batch probably compiles; of one that fails lint.sh checks each source alone.

# The name that a line declares, of a function with the parameters, where clang-format begins the declaration at the start of
# the line; otherwise nothing.
function declared(line,    parameters) {
  if (line !~ /^[a-zA-Z_]/ || line ~ /^(namespace|template|friend)/) return ""
  sub(/ (final )?: .*/, "", line)
  sub(/ *[={;].*/, "", line)
  if (match(line, /\([^)]*/)) parameters = substr(line, RSTART, RLENGTH)
  sub(/\(.*/, "", line)
  sub(/\[.*/, "", line)
  gsub(/ /, "", parameters)
  return match(line, /[a-zA-Z_0-9]+$/) ? substr(line, RSTART) parameters : ""
}

function without_parameters(name) {
  sub(/\(.*/, "", name)
  return name
}

# Reads the headers that a file includes, and the names that they declare.
function read_header(file,    line, name) {
  if (file in included_by) return
  included_by[file] = declared_by[file] = ""
  while ((getline line < file) > 0) {
    if (line ~ /^#include "/) {
      split(line, quoted, "\"")
      included_by[file] = included_by[file] " " quoted[2]
    } else if ((name = without_parameters(declared(line))) != "") {
      declared_by[file] = declared_by[file] " " name
    }
  }
  close(file)
}

# Collects the names that a source sees in headers.
function see(file, seen,    headers, count, k, name, list, n) {
  read_header(file)
  count = split(included_by[file], headers, " ")
  for (k = 1; k <= count; ++k) {
    if (headers[k] in visited) continue
    visited[headers[k]] = 1
    see(headers[k], seen)
    n = split(declared_by[headers[k]], list, " ")
    for (; n > 0; --n) seen[list[n]] = 1
  }
}

# Collects the names that a source declares in unnamed namespaces. Returns "slow" if it includes CLI11:
# performance-unnecessary-value-param searches the whole batch for the uses of each of its many functions that take copies.
function read_names(source, names,    line, unnamed, name, separate) {
  while ((getline line < source) > 0) {
    if (line ~ /^#include .*(CLI\/|topic_options)/) separate = "slow"
    if (line ~ /^namespace \{/) unnamed = 1
    else if (line ~ /^}  \/\/ namespace/) unnamed = 0
    if (unnamed && (name = declared(line)) != "") names[name] = 1
  }
  close(source)
  return separate
}

function entry(directory, command, source) {
  entries = entries (entries == "" ? "" : ",\n") "{\n  \"directory\": \"" directory "\",\n  \"command\": \"" command \
            "\",\n  \"file\": \"" source "\"\n}"
}

function fits(batch, names, seen,    name) {
  if (sizes[batch] >= largest) return 0
  for (name in names) if ((batch, name) in taken || (batch, without_parameters(name)) in shown) return 0
  for (name in seen) if ((batch, name) in hidden) return 0
  return 1
}

BEGIN { FS = "\t"; largest = 30 }

{
  entry($1, $2, $3)
  if ($3 !~ /\.cpp$/ || $3 ~ skipped) next
  # What is merged, in the order of its appearance; the rest separates batches.
  count = split($2, words, " ")
  merged = options = ""
  for (k = 1; k <= count; ++k) {
    if (words[k] == "-isystem") merged = merged " -isystem " words[++k]
    else if (words[k] ~ /^-[DI]/) merged = merged " " words[k]
    else if (words[k] == "-o" || words[k] == "-c") ++k
    else options = options " " words[k]
  }
  delete names
  delete seen
  delete visited
  group = options read_names($3, names)
  see($3, seen)
  for (batch = 1; batch <= batches; ++batch) {
    if (group_of[batch] == group && fits(batch, names, seen)) break
  }
  if (batch > batches) {
    batches = batch
    group_of[batch] = group
    options_of[batch] = options
    directory_of[batch] = $1
  }
  for (name in names) taken[batch, name] = hidden[batch, without_parameters(name)] = 1
  for (name in seen) shown[batch, name] = 1
  members[batch, ++sizes[batch]] = $3
  count = split(merged, words, " ")
  for (k = 1; k <= count; ++k) {
    option = words[k]
    if (option == "-isystem") option = option " " words[++k]
    if ((batch, option) in known) continue
    known[batch, option] = 1
    merged_of[batch] = merged_of[batch] " " option
  }
}

END {
  for (batch = 1; batch <= batches; ++batch) {
    file = out "/batch_" batch ".cpp"
    list = out "/batch_" batch ".list"
    for (k = 1; k <= sizes[batch]; ++k) {
      source = members[batch, k]
      print source >list
      if (source ~ /main\.cpp$/) print "#define main main_" k >file
      print "#include \"" source "\"" >file
      if (source ~ /main\.cpp$/) print "#undef main" >file
    }
    # GCC warns of shadowing; here it may be by a name of another source.
    if (group_of[batch] ~ /slow$/) slow = slow file "\n"
    else fast = fast file "\n"
    entry(directory_of[batch], options_of[batch] merged_of[batch] " -Wno-shadow -c " file, file)
  }
  printf "%s%s", slow, fast
  print "[\n" entries "\n]" >(out "/compile_commands.json")
}
