# Debian packages, by `cpack` in the build folder: twin (program, shared library, machine files, programs), libtwin-dev
# (headers, CMake package, pkg-config), python3-twin; and twin-linuxcnc (components of LinuxCNC's HAL) where they are built.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME twin)
set(CPACK_PACKAGE_VENDOR "twin")
set(CPACK_PACKAGE_CONTACT "twin maintainers <noreply@users.noreply.github.com>")
set(CPACK_PACKAGE_VERSION "${PROJECT_VERSION}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_OUTPUT_FILE_PREFIX packages)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS "${PROJECT_BINARY_DIR}/lib")
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(components program devel python)
if(TARGET twin_linuxcnc_modules)
  list(APPEND components linuxcnc)
endif()
set(CPACK_COMPONENTS_ALL ${components})

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME twin)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION science)
# MuJoCo is loaded when a table is simulated, so that no library names it; gnuplot is a program.
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libmujoco2.2.2, python3:any")  # scripts start LinuxCNC
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot")
file(WRITE "${PROJECT_BINARY_DIR}/package/triggers" "activate-noawait ldconfig\n")
file(WRITE "${PROJECT_BINARY_DIR}/package/shlibs"
  "libtwin ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR} twin (>= ${PROJECT_VERSION})\n")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_CONTROL_EXTRA
  "${PROJECT_BINARY_DIR}/package/triggers;${PROJECT_BINARY_DIR}/package/shlibs")
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "digital twin of a servo XY table and its CNC controller
 It reads NC programs of many short blocks, makes paths of continuous curvature
 of them, plans a jerk-limited feedrate, closes the position loops and moves a
 simulated table or a real one. Every run leaves a trace, figures and plots.")

set(CPACK_DEBIAN_DEVEL_PACKAGE_NAME libtwin-dev)
set(CPACK_DEBIAN_DEVEL_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVEL_PACKAGE_DEPENDS "twin (= ${PROJECT_VERSION}-1)")
set(CPACK_DEBIAN_DEVEL_DESCRIPTION "digital twin of a servo XY table: headers for C++ programs
 The headers twin/..., with packages for CMake and pkg-config.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-twin)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "twin (= ${PROJECT_VERSION}-1), python3 (>= 3.11), python3 (<< 3.12), python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-distributed")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "digital twin of a servo XY table: Python package
 Plans, runs and identifies from Python; traces are NumPy arrays.")

set(CPACK_DEBIAN_LINUXCNC_PACKAGE_NAME twin-linuxcnc)
set(CPACK_DEBIAN_LINUXCNC_PACKAGE_SECTION misc)
set(CPACK_DEBIAN_LINUXCNC_PACKAGE_DEPENDS "twin (= ${PROJECT_VERSION}-1), linuxcnc-uspace")
set(CPACK_DEBIAN_LINUXCNC_DESCRIPTION "digital twin of a servo XY table: components of LinuxCNC's HAL
 With them LinuxCNC drives the simulated table, and twin drives what LinuxCNC's
 HAL drives. They are under the GNU General Public License, version 2 or later.")

# What every Debian package has: licence and changes.
string(TIMESTAMP package_date "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(package_docs "${PROJECT_BINARY_DIR}/package")
file(WRITE "${package_docs}/changelog" "twin (${PROJECT_VERSION}-1) unstable; urgency=medium

  * See CHANGELOG.md of the sources.

 -- ${CPACK_PACKAGE_CONTACT}  ${package_date}
")
find_program(GZIP gzip REQUIRED)
execute_process(COMMAND "${GZIP}" -9nf "${package_docs}/changelog")
file(WRITE "${package_docs}/copyright" "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: twin

Files: *
Copyright: 2026 the twin authors
License: Apache-2.0
 On Debian systems the full text of this licence is in
 /usr/share/common-licenses/Apache-2.0.

Files: hal/linuxcnc/shim/*
Copyright: 2026 the twin authors
License: GPL-2+
 Sources of components of LinuxCNC's HAL, and scripts that run LinuxCNC.
 On Debian systems the full text of this licence is in
 /usr/share/common-licenses/GPL-2.

Files: hal/linuxcnc/segment.h
Copyright: 2026 the twin authors
License: MIT
 The text of this licence is at the top of the file.
")
set(program_package twin)
set(devel_package libtwin-dev)
set(python_package python3-twin)
set(linuxcnc_package twin-linuxcnc)
foreach(component IN LISTS components)
  install(FILES "${package_docs}/copyright" DESTINATION share/doc/${${component}_package} COMPONENT ${component})
  install(FILES "${package_docs}/changelog.gz" RENAME changelog.Debian.gz
    DESTINATION share/doc/${${component}_package} COMPONENT ${component})
endforeach()

# Man pages, one for each command, from the program's own help.
find_program(TWIN_HELP2MAN help2man)
if(TWIN_HELP2MAN)
  add_custom_target(twin_man
    COMMAND "${PROJECT_SOURCE_DIR}/cmake/make_man_pages" "$<TARGET_FILE:twin_program>" "${PROJECT_BINARY_DIR}/man"
    DEPENDS twin_program VERBATIM)
  install(DIRECTORY "${PROJECT_BINARY_DIR}/man/" DESTINATION share/man/man1 COMPONENT program OPTIONAL)
endif()
install(FILES "${PROJECT_SOURCE_DIR}/cmake/completion/twin.bash" RENAME twin
  DESTINATION share/bash-completion/completions COMPONENT program)
install(FILES "${PROJECT_SOURCE_DIR}/cmake/completion/_twin" DESTINATION share/zsh/vendor-completions COMPONENT program)
install(FILES "${PROJECT_SOURCE_DIR}/cmake/completion/twin.fish"
  DESTINATION share/fish/vendor_completions.d COMPONENT program)

include(CPack)
cpack_add_component_group(program)
cpack_add_component_group(devel)
cpack_add_component_group(python)
cpack_add_component_group(linuxcnc)
foreach(component IN LISTS components)
  cpack_add_component(${component} GROUP ${component})
endforeach()
