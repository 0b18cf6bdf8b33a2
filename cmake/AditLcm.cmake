# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# LCM, and code from its types:
#   adit_lcm_library(NAME PACKAGE p TYPES a_t ...)   C++ headers "p/a_t.hpp", target adit::NAME
#   adit_lcm_jar(NAME PACKAGE p TYPES a_t ...)       <build>/share/java/NAME.jar, where a JDK is
#   adit_java_jar(NAME JARS n ... SOURCES ...)       the same from Java that uses the jars of those names
# The types are the files a_t.lcm of the calling folder. The C++ goes through guard_decoding.cmake.
# LCM 1.4 brings a CMake package; 1.3.1 of Debian 12 is looked for by hand, without pkg-config, which
# would ask for GLib's headers that nothing here includes.

find_package(lcm QUIET)
if(TARGET lcm::lcm)
  add_library(adit_lcm INTERFACE)
  target_link_libraries(adit_lcm INTERFACE lcm::lcm)
  set(ADIT_LCM_GEN $<TARGET_FILE:lcm::lcm-gen>)
else()
  find_path(ADIT_LCM_INCLUDE lcm/lcm-cpp.hpp)
  find_library(ADIT_LCM_LIBRARY lcm)
  find_program(ADIT_LCM_GEN lcm-gen)
  if(NOT ADIT_LCM_INCLUDE OR NOT ADIT_LCM_LIBRARY OR NOT ADIT_LCM_GEN)
    message(FATAL_ERROR "LCM is missing: apt install liblcm-dev liblcm-bin")
  endif()
  add_library(adit_lcm INTERFACE)
  target_include_directories(adit_lcm SYSTEM INTERFACE ${ADIT_LCM_INCLUDE})
  target_link_libraries(adit_lcm INTERFACE ${ADIT_LCM_LIBRARY})
endif()
add_library(adit::lcm ALIAS adit_lcm)

find_program(ADIT_JAVAC javac)
find_program(ADIT_JAR jar)
find_file(ADIT_LCM_JAR lcm.jar PATHS /usr/share/java /usr/local/share/java)

function(adit_lcm_library name)
  cmake_parse_arguments(ARG "" "PACKAGE" "TYPES" ${ARGN})
  set(raw ${CMAKE_CURRENT_BINARY_DIR}/${name}_raw)
  set(include ${CMAKE_CURRENT_BINARY_DIR}/${name}_include)
  set(guard ${PROJECT_SOURCE_DIR}/cmake/guard_decoding.cmake)
  foreach(type ${ARG_TYPES})
    set(source ${CMAKE_CURRENT_SOURCE_DIR}/${type}.lcm)
    set(header ${ARG_PACKAGE}/${type}.hpp)
    add_custom_command(OUTPUT ${include}/${header}
      COMMAND ${ADIT_LCM_GEN} -x --cpp-std=c++11 --cpp-hpath ${raw} ${source}
      COMMAND ${CMAKE_COMMAND} -DIN=${raw}/${header} -DOUT=${include}/${header} -P ${guard}
      DEPENDS ${source} ${guard}
      COMMENT "Generating ${header}" VERBATIM)
    list(APPEND headers ${include}/${header})
  endforeach()
  add_custom_target(adit_${name}_headers DEPENDS ${headers})
  add_library(adit_${name} INTERFACE)
  add_library(adit::${name} ALIAS adit_${name})
  add_dependencies(adit_${name} adit_${name}_headers)
  target_include_directories(adit_${name} SYSTEM INTERFACE ${include})
  target_link_libraries(adit_${name} INTERFACE adit_settings adit::lcm)
endfunction()

function(adit_lcm_jar name)
  if(NOT ADIT_JAVAC OR NOT ADIT_JAR OR NOT ADIT_LCM_JAR)
    message(STATUS "${name}.jar is left out, adit spy will not decode: "
                   "apt install default-jdk-headless liblcm-java")
    return()
  endif()
  cmake_parse_arguments(ARG "" "PACKAGE" "TYPES" ${ARGN})
  set(java ${CMAKE_CURRENT_BINARY_DIR}/${name}_java)
  set(classes ${CMAKE_CURRENT_BINARY_DIR}/${name}_classes)
  set(jar ${PROJECT_BINARY_DIR}/share/java/${name}.jar)
  list(TRANSFORM ARG_TYPES REPLACE "(.+)" "${CMAKE_CURRENT_SOURCE_DIR}/\\1.lcm" OUTPUT_VARIABLE sources)
  list(TRANSFORM ARG_TYPES REPLACE "(.+)" "${java}/${ARG_PACKAGE}/\\1.java" OUTPUT_VARIABLE javas)
  add_custom_command(OUTPUT ${jar}
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${java} ${classes}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${java} ${classes} ${PROJECT_BINARY_DIR}/share/java
    COMMAND ${ADIT_LCM_GEN} -j --jpath ${java} ${sources}
    COMMAND ${ADIT_JAVAC} --release 8 -Xlint:-options -cp ${ADIT_LCM_JAR} -d ${classes} ${javas}
    COMMAND ${ADIT_JAR} cf ${jar} -C ${classes} .
    DEPENDS ${sources}
    COMMENT "Building ${name}.jar" VERBATIM)
  add_custom_target(${name}_jar ALL DEPENDS ${jar})
  install(FILES ${jar} DESTINATION share/java)
endfunction()

function(adit_java_jar name)
  if(NOT ADIT_JAVAC OR NOT ADIT_JAR OR NOT ADIT_LCM_JAR)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "JARS;SOURCES" ${ARGN})
  set(classes ${CMAKE_CURRENT_BINARY_DIR}/${name}_classes)
  set(jar ${PROJECT_BINARY_DIR}/share/java/${name}.jar)
  list(TRANSFORM ARG_JARS REPLACE "(.+)" "${PROJECT_BINARY_DIR}/share/java/\\1.jar" OUTPUT_VARIABLE jars)
  list(JOIN jars ":" class_path)
  list(TRANSFORM ARG_SOURCES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/ OUTPUT_VARIABLE sources)
  add_custom_command(OUTPUT ${jar}
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${classes}
    COMMAND ${CMAKE_COMMAND} -E make_directory ${classes}
    COMMAND ${ADIT_JAVAC} --release 8 -Xlint:-options -cp ${ADIT_LCM_JAR}:${class_path} -d ${classes} ${sources}
    COMMAND ${ADIT_JAR} cf ${jar} -C ${classes} .
    DEPENDS ${sources} ${jars}
    COMMENT "Building ${name}.jar" VERBATIM)
  add_custom_target(${name}_jar ALL DEPENDS ${jar})
  foreach(used ${ARG_JARS})
    add_dependencies(${name}_jar ${used}_jar)
  endforeach()
  install(FILES ${jar} DESTINATION share/java)
endfunction()
