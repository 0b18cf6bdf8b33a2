# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# What every target of this project shares, and the three ways to declare one:
#   adit_library(NAME SOURCES ... DEPS ...)      static library adit_NAME, alias adit::NAME
#   adit_executable(NAME SOURCES ... DEPS ...)   program NAME in <build>/bin
#   adit_test(NAME SOURCES ... DEPS ...)         GoogleTest program, each case known to CTest

include(GNUInstallDirs)

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)

add_library(adit_settings INTERFACE)
target_compile_features(adit_settings INTERFACE cxx_std_20)
target_include_directories(adit_settings INTERFACE ${PROJECT_SOURCE_DIR})
# No contraction into fused multiply-adds: the same log gives the same bytes on every build.
target_compile_options(adit_settings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -ffp-contract=off
  $<$<BOOL:${ADIT_WERROR}>:-Werror>)
if(ADIT_SANITIZE)
  target_compile_options(adit_settings INTERFACE -fsanitize=${ADIT_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all)
  target_link_options(adit_settings INTERFACE -fsanitize=${ADIT_SANITIZE})
endif()

function(adit_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_library(adit_${name} STATIC ${ARG_SOURCES})
  add_library(adit::${name} ALIAS adit_${name})
  target_link_libraries(adit_${name} PUBLIC adit_settings ${ARG_DEPS})
endfunction()

function(adit_executable name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE adit_settings ${ARG_DEPS})
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

function(adit_test name)
  cmake_parse_arguments(ARG "" "" "SOURCES;DEPS" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE adit_settings ${ARG_DEPS} GTest::gmock GTest::gtest_main)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60)
endfunction()
