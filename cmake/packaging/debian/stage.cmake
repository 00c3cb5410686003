# SPDX-License-Identifier: MIT
# Run by CPack when the files of the packages lie in folders of their own: adds what each package of Debian has, its
# copyright and changelog, and compresses changelogs and manual pages.
cmake_minimum_required(VERSION 3.22)

# compress(file): without the time and the name, so that the same sources give the same package.
function(compress file)
  execute_process(COMMAND gzip -9nf ${file} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "gzip -9nf ${file} ended with ${result}")
  endif()
endfunction()

foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} upper)
  set(package ${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component})
  if(NOT IS_DIRECTORY ${root}/usr)
    message(FATAL_ERROR "nothing was staged for ${package} in ${root}/usr")
  endif()
  set(documents ${root}/usr/share/doc/${package})
  # Not file(INSTALL), which puts the folder of CPack's last installation before every path.
  configure_file(${CMAKE_CURRENT_LIST_DIR}/copyright ${documents}/copyright COPYONLY)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/changelog ${documents}/changelog.Debian COPYONLY)
  configure_file(${CPACK_SHAFTCULL_SOURCE}/CHANGELOG.md ${documents}/changelog COPYONLY)
  compress(${documents}/changelog.Debian)
  compress(${documents}/changelog)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/lintian-overrides ${root}/usr/share/lintian/overrides/${package} COPYONLY)
  file(GLOB pages ${root}/usr/share/man/man*/*.[1-9])
  foreach(page IN LISTS pages)
    compress(${page})
  endforeach()
endforeach()
