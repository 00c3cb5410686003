# SPDX-License-Identifier: MIT
# Debian packages by CPack, one for each component of install.cmake. Included where the library is shared and this
# project is the top level. ./cmake/run package builds them; docs/packages.md says what each holds.

if(NOT PROJECT_IS_TOP_LEVEL OR NOT shaftcull_type STREQUAL "SHARED_LIBRARY" OR NOT CMAKE_SYSTEM_NAME STREQUAL "Linux")
  return()
endif()

# The version of the packages is that of the first entry of the changelog, as with all of Debian's.
set(shaftcull_debian ${CMAKE_CURRENT_LIST_DIR}/debian)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${shaftcull_debian}/changelog)
file(STRINGS ${shaftcull_debian}/changelog shaftcull_entry LIMIT_COUNT 1)
if(NOT shaftcull_entry MATCHES "^shaftcull \\((.+)-(.+)\\) ")
  message(FATAL_ERROR "${shaftcull_debian}/changelog begins with \"${shaftcull_entry}\", which names no version")
endif()
set(CPACK_DEBIAN_PACKAGE_RELEASE ${CMAKE_MATCH_2})
if(NOT CMAKE_MATCH_1 VERSION_EQUAL PROJECT_VERSION)
  message(FATAL_ERROR "${shaftcull_debian}/changelog is of ${CMAKE_MATCH_1}, the library is ${PROJECT_VERSION}")
endif()
set(shaftcull_debian_version ${CMAKE_MATCH_1}-${CMAKE_MATCH_2})

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME shaftcull)
set(CPACK_DEBIAN_PACKAGE_SOURCE shaftcull)
if(NOT CPACK_PACKAGE_CONTACT)
  set(CPACK_PACKAGE_CONTACT "shaftcull contributors <shaftcull@packages.invalid>")  # whoever distributes packages says who
endif()
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_STRIP_FILES ON)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS ${shaftcull_debian}/stage.cmake)
set(CPACK_POST_BUILD_SCRIPTS ${shaftcull_debian}/finish.cmake)

# What the libraries and programs link is found by dpkg-shlibdeps, but for shaftcull's own libraries: no package of theirs is
# installed yet. They need the very version that they were built with.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/kernel ${PROJECT_BINARY_DIR}/bindings/c)
# Within a minor version functions are added only, so what was built with one release runs with that or a later one.
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")

set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # CPack would put it before those below
set(shaftcull_about "
shaftcull tells for every bounding box, sphere or triangle of a scene whether
it is outside, inside or overlapping a shaft: the convex hull of two boxes,
what a moving box sweeps over, a shadow, or a view. Answers are those of real
arithmetic, and the same on every processor. The kernels for SSE4.2, AVX2 and
AVX-512 are all built in, and chosen when the program runs.

")

# shaftcull_debian_package(COMPONENT NAME SECTION DEPENDS SUMMARY TEXT): COMPONENT becomes the package NAME.
set(CPACK_COMPONENTS_ALL "")
macro(shaftcull_debian_package component name section depends summary text)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  string(TOUPPER ${component} component_upper)
  set(CPACK_DEBIAN_${component_upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${component_upper}_PACKAGE_SECTION ${section})
  set(CPACK_DEBIAN_${component_upper}_PACKAGE_DEPENDS "${depends}")
  set(CPACK_DEBIAN_${component_upper}_DESCRIPTION "${summary}${shaftcull_about}${text}")
endmacro()

# A library's package has the name of its soname, so that packages of two that do not fit each other are installed side by side.
# The one of the C interface always changes together with that of the C++ library.
get_target_property(shaftcull_soversion shaftcull SOVERSION)
set(shaftcull_runtime_package libshaftcull${shaftcull_soversion})
set(shaftcull_same "${shaftcull_runtime_package} (= ${shaftcull_debian_version})")

shaftcull_debian_package(shaftcull_runtime ${shaftcull_runtime_package} libs ""
  "exact culling of boxes by shafts - shared libraries"
  "This package has the shared libraries for C++ and for C.")
set(CPACK_DEBIAN_SHAFTCULL_RUNTIME_PACKAGE_CONTROL_EXTRA ${shaftcull_debian}/triggers)

shaftcull_debian_package(shaftcull_development libshaftcull-dev libdevel "${shaftcull_same}"
  "exact culling of boxes by shafts - development files"
  "This package has the headers for C++20 and for C11, the CMake package, and
the files that pkg-config reads.")
set(CPACK_DEBIAN_SHAFTCULL_DEVELOPMENT_PACKAGE_SHLIBDEPS OFF)

if(TARGET shaftcull_cli)
  shaftcull_debian_package(shaftcull_program shaftcull graphics "${shaftcull_same}"
    "exact culling of boxes by shafts - program"
    "This package has a program that culls mesh files, draws shafts, gathers
statistics, and compares answers with exact rational arithmetic.")
endif()

# The module is built for one version of Python. The preset `package` names Debian's folder for it.
if(TARGET shaftcull_python)
  find_package(Python3 COMPONENTS Interpreter QUIET)
  math(EXPR shaftcull_next_python "${Python3_VERSION_MINOR} + 1")
  shaftcull_debian_package(shaftcull_python python3-shaftcull python
    "${shaftcull_same}, python3 (>= 3.${Python3_VERSION_MINOR}~), python3 (<< 3.${shaftcull_next_python}), python3-numpy"
    "exact culling of boxes by shafts - Python module"
    "This package has the module for Python 3, which takes and gives NumPy arrays.")
  set(CPACK_DEBIAN_SHAFTCULL_PYTHON_PACKAGE_CONTROL_EXTRA ${shaftcull_debian}/python/postinst ${shaftcull_debian}/python/prerm)
endif()

# Which package whoever links a library needs. It concerns libraries with a soname, and so not the Python module.
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)

set(CPACK_SHAFTCULL_SOURCE ${PROJECT_SOURCE_DIR})
include(CPack)
