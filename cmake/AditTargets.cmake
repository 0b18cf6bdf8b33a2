# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# What every target of this project shares, and the functions that declare one:
#   adit_library(NAME SOURCES ... DEPS ...)      static library adit_NAME, alias adit::NAME
#   adit_executable(NAME SOURCES ... DEPS ...)   program NAME in <build>/bin
#   adit_test(NAME [QUICK] SOURCES ... DEPS ...) GoogleTest program, each case known to CTest; QUICK: compiled without
#                                                optimization, for tests whose time goes into the libraries
# All presets but dev compile the SOURCES of a target as one (CMAKE_UNITY_BUILD), which parses shared headers once.
# Sources that cannot be compiled together with the others, mostly because their unnamed namespaces share a name
# (CONTRIBUTING.md), are listed under APART.

include(GNUInstallDirs)

set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/bin)

add_library(adit_settings INTERFACE)
target_compile_features(adit_settings INTERFACE cxx_std_20)
target_include_directories(adit_settings INTERFACE ${PROJECT_SOURCE_DIR})
target_link_libraries(adit_settings INTERFACE fmt::fmt)
# No contraction into fused multiply-adds: the same log gives the same bytes on every build. No strict aliasing:
# LCM's inline code reads a float through an int32_t pointer.
target_compile_options(adit_settings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual -ffp-contract=off
  -fno-strict-aliasing $<$<BOOL:${ADIT_WERROR}>:-Werror>)
if(ADIT_SANITIZE)
  target_compile_options(adit_settings INTERFACE -fsanitize=${ADIT_SANITIZE} -fno-omit-frame-pointer
    -fno-sanitize-recover=all)
  target_link_options(adit_settings INTERFACE -fsanitize=${ADIT_SANITIZE})
endif()

# Precompiled library headers, a quarter of the build time. A source still includes what it uses;
# deploy/lint.sh reads the sources without these.
function(adit_precompiled name)
  add_library(${name} STATIC ${PROJECT_SOURCE_DIR}/cmake/precompiled.cpp)
  target_link_libraries(${name} PRIVATE adit_settings Eigen3::Eigen)
  target_precompile_headers(${name} PRIVATE
    <algorithm> <array> <chrono> <cmath> <cstdint> <deque> <filesystem> <fstream> <functional> <iostream>
    <limits> <map> <memory> <numeric> <optional> <random> <set> <span> <sstream> <string> <string_view>
    <utility> <variant> <vector> <Eigen/Core> <Eigen/Geometry> <fmt/format.h> ${ARGN})
endfunction()
adit_precompiled(adit_precompiled)

function(adit_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;APART;DEPS" ${ARGN})
  set_source_files_properties(${ARG_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  add_library(adit_${name} STATIC ${ARG_SOURCES} ${ARG_APART})
  add_library(adit::${name} ALIAS adit_${name})
  target_link_libraries(adit_${name} PUBLIC adit_settings ${ARG_DEPS})
  target_precompile_headers(adit_${name} REUSE_FROM adit_precompiled)
endfunction()

function(adit_executable name)
  cmake_parse_arguments(ARG "" "" "SOURCES;APART;DEPS" ${ARGN})
  set_source_files_properties(${ARG_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  add_executable(${name} ${ARG_SOURCES} ${ARG_APART})
  target_link_libraries(${name} PRIVATE adit_settings ${ARG_DEPS})
  target_precompile_headers(${name} REUSE_FROM adit_precompiled)
  install(TARGETS ${name} RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endfunction()

function(adit_test name)
  cmake_parse_arguments(ARG "QUICK" "" "SOURCES;APART;DEPS" ${ARGN})
  set_source_files_properties(${ARG_APART} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  if(ARG_QUICK)
    set(kind quick)
  else()
    set(kind test)
  endif()
  add_executable(${name} ${ARG_SOURCES} ${ARG_APART})
  target_link_libraries(${name} PRIVATE adit_settings adit_${kind}_settings ${ARG_DEPS}
    GTest::gmock GTest::gtest_main)
  target_precompile_headers(${name} REUSE_FROM adit_${kind}_precompiled)
  set_target_properties(${name} PROPERTIES RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/tests)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60)
endfunction()
