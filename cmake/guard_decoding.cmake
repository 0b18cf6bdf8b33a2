# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# cmake -DIN=raw.hpp -DOUT=guarded.hpp -P guard_decoding.cmake
#
# The code that lcm-gen generates trusts the counts in a message: it resizes an array to any count, even a negative
# one, and reads a string of length 0 or less out of bounds. This script inserts, before each resize, a check
# that the count fits the remaining bytes (an element takes at least one byte, so an array of empty rows is
# rejected), and completes the check of each string length. Written for LCM 1.3.1 and verified with 1.5; if the
# output has another form, so that an array or a string would stay unchecked, the build fails here.

file(READ ${IN} code)

set(count_check "if (\\2 < 0 || \\2 > maxlen - pos) return -1;")
string(REGEX REPLACE "(this->[][a-zA-Z_0-9]+\\.resize\\(([^()]*)\\);)" "${count_check}\n        \\1"
       guarded "${code}")
string(REGEX REPLACE "if ?\\((__[a-zA-Z_0-9]+) > maxlen - pos\\) return -1;"
       "if (\\1 < 1 || \\1 > maxlen - pos) return -1;" guarded "${guarded}")

function(count_of pattern text result)
  string(REGEX MATCHALL "${pattern}" matches "${text}")
  list(LENGTH matches length)
  set(${result} ${length} PARENT_SCOPE)
endfunction()

function(require_equal what expected_pattern guard_pattern)
  count_of("${expected_pattern}" "${code}" expected)
  count_of("${guard_pattern}" "${guarded}" found)
  if(NOT expected EQUAL found)
    message(FATAL_ERROR "${IN}: ${expected} ${what}, but ${found} could be guarded. "
                        "This lcm-gen writes another shape: amend cmake/guard_decoding.cmake.")
  endif()
endfunction()

require_equal("dimensions of variable length" "std::vector *<" " < 0 \\|\\| [^()]* > maxlen - pos")
require_equal("calls of resize" "resize *\\(" " < 0 \\|\\| [^()]* > maxlen - pos")
require_equal("strings" "std::string" " < 1 \\|\\| [^()]* > maxlen - pos")
require_equal("calls of assign" "assign *\\(" " < 1 \\|\\| [^()]* > maxlen - pos")

file(WRITE ${OUT} "${guarded}")
