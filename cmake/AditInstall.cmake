# SPDX-FileCopyrightText: The Adit authors
# SPDX-License-Identifier: BSD-3-Clause
#
# What `cmake --install` installs besides the programs and the jar, and the Debian package of `cpack -G DEB`. Files
# that an operator edits go into etc (/etc for the prefix /usr), unless they exist.

set(share ${CMAKE_INSTALL_DATAROOTDIR})
install(PROGRAMS deploy/bin/adit-record DESTINATION ${CMAKE_INSTALL_BINDIR})
install(FILES deploy/config/groundhog.yaml deploy/config/skid_steered.yaml deploy/config/spinning_lidar.yaml deploy/config/simulated.yaml DESTINATION ${share}/adit/config)
install(FILES deploy/processes/simulated.cfg DESTINATION ${share}/adit/processes)
install(DIRECTORY sim/worlds/ DESTINATION ${share}/adit/worlds FILES_MATCHING PATTERN *.yaml PATTERN *.txt)
install(FILES deploy/sysctl/60-adit-lcm.conf DESTINATION lib/sysctl.d)
install(FILES README.md DESTINATION ${share}/doc/adit)
install(FILES deploy/README.md DESTINATION ${share}/doc/adit RENAME deploy.md)
install(FILES LICENSE DESTINATION ${share}/doc/adit RENAME copyright)

install(CODE "
  set(root \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}\")
  set(etc \"\${root}/etc\")
  if(CMAKE_INSTALL_PREFIX STREQUAL \"/usr\")
    set(etc \"\$ENV{DESTDIR}/etc\")
  endif()
  function(install_once source target)
    if(NOT EXISTS \${etc}/\${target})
      message(STATUS \"Installing: \${etc}/\${target}\")
      configure_file(${PROJECT_SOURCE_DIR}/deploy/\${source} \${etc}/\${target} COPYONLY)
    endif()
  endfunction()
  install_once(config/robot.yaml adit/robot.yaml)
  install_once(processes/robot.cfg adit/robot.cfg)
  install_once(debian/default default/adit)

  foreach(unit adit-guard adit-supervisor adit-loopback)
    file(READ ${PROJECT_SOURCE_DIR}/deploy/systemd/\${unit}.service text)
    string(REPLACE /usr/ \${CMAKE_INSTALL_PREFIX}/ text \"\${text}\")
    file(WRITE \${root}/lib/systemd/system/\${unit}.service \"\${text}\")
  endforeach()
  file(MAKE_DIRECTORY \${root}/${share}/bash-completion/completions)
  execute_process(COMMAND $<TARGET_FILE:adit> completion bash COMMAND_ERROR_IS_FATAL ANY
    OUTPUT_FILE \${root}/${share}/bash-completion/completions/adit)
  execute_process(COMMAND ${PROJECT_SOURCE_DIR}/deploy/man_pages.sh \${root}/${CMAKE_INSTALL_BINDIR}
    \${root}/${CMAKE_INSTALL_MANDIR}/man1 COMMAND_ERROR_IS_FATAL ANY)
")

set(CPACK_PACKAGE_VENDOR "The Adit authors")
set(CPACK_PACKAGE_CONTACT "The Adit authors <adit@localhost>")
set(CPACK_GENERATOR DEB)
set(CPACK_SET_DESTDIR ON)
set(CPACK_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "adduser, fonts-dejavu-core, iproute2, liblcm-bin")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "chrony")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "default-jre, liblcm-java, libjchart2d-java, slurm-client, sqlite3")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_EXTRA
  ${PROJECT_SOURCE_DIR}/deploy/debian/conffiles ${PROJECT_SOURCE_DIR}/deploy/debian/postinst)
include(CPack)
