# SPDX-License-Identifier: MIT
# What is true of the sources, the documents and the build itself, whatever processor it is for: included where programs run on this
# machine, and so in all presets but those that are for another processor.

add_test(NAME dependencies
  COMMAND ${CMAKE_COMMAND} -D PROJECT_CMAKE=${PROJECT_SOURCE_DIR}/cmake -D WORK=${CMAKE_CURRENT_BINARY_DIR}/dependencies
          -D GENERATOR=${CMAKE_GENERATOR} -P ${CMAKE_CURRENT_SOURCE_DIR}/dependencies/check.cmake)
add_test(NAME headers
  COMMAND ${CMAKE_COMMAND} -D INCLUDE=${PROJECT_SOURCE_DIR}/include -P ${CMAKE_CURRENT_SOURCE_DIR}/headers.cmake)
add_test(NAME architecture
  COMMAND ${CMAKE_COMMAND} -D KERNEL=${PROJECT_SOURCE_DIR}/kernel
          -D BINDINGS=${PROJECT_SOURCE_DIR}/bindings -D PAGE=${PROJECT_SOURCE_DIR}/docs/architecture.md
          -P ${CMAKE_CURRENT_SOURCE_DIR}/architecture.cmake)
add_test(NAME documents
  COMMAND ${CMAKE_COMMAND} -D ROOT=${PROJECT_SOURCE_DIR} -P ${CMAKE_CURRENT_SOURCE_DIR}/documents.cmake)
add_test(NAME packages.licences
  COMMAND ${CMAKE_COMMAND} -D ROOT=${PROJECT_SOURCE_DIR} -P ${CMAKE_CURRENT_SOURCE_DIR}/packages/licences.cmake)
add_test(NAME packages.spdx
  COMMAND ${CMAKE_COMMAND} -D ROOT=${PROJECT_SOURCE_DIR} -P ${CMAKE_CURRENT_SOURCE_DIR}/packages/spdx.cmake)
# They configure the project with options of their own, so one preset's run says all.
if(CMAKE_BUILD_TYPE STREQUAL "Release" AND NOT CMAKE_CXX_FLAGS AND SHAFTCULL_WITH_TBB AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_test(NAME packages.vcpkg
    COMMAND ${CMAKE_COMMAND} -D ROOT=${PROJECT_SOURCE_DIR} -D VERSION=${PROJECT_VERSION} -D DESCRIPTION=${PROJECT_DESCRIPTION}
            -D WORK=${CMAKE_CURRENT_BINARY_DIR}/vcpkg -D GENERATOR=${CMAKE_GENERATOR}
            -P ${CMAKE_CURRENT_SOURCE_DIR}/packages/vcpkg.cmake)
  if(SHAFTCULL_SYSTEM_PYTHON)
    add_test(NAME packages.conan
      COMMAND ${SHAFTCULL_SYSTEM_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/packages/conan_recipe.py ${PROJECT_SOURCE_DIR} ${PROJECT_VERSION}
              ${PROJECT_DESCRIPTION} ${CMAKE_CURRENT_BINARY_DIR}/conan ${CMAKE_GENERATOR})
  else()
    message(STATUS "No test packages.conan: there is no python3 on this machine")
  endif()
endif()
# The page of plots of the benchmark.
if(SHAFTCULL_SYSTEM_PYTHON)
  add_test(NAME report COMMAND ${SHAFTCULL_SYSTEM_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/bench/report_test.py)
  set_tests_properties(report PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 300 ENVIRONMENT MPLCONFIGDIR=${CMAKE_CURRENT_BINARY_DIR}/matplotlib)
  # Every time in the README and the headers is listed with its row of the benchmark.
  add_test(NAME documents.figures COMMAND ${SHAFTCULL_SYSTEM_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/bench/figures_test.py)
  set_tests_properties(documents.figures PROPERTIES TIMEOUT 60)
else()
  message(STATUS "No tests report and documents.figures: there is no python3 on this machine")
endif()

add_test(NAME compilers COMMAND ${CMAKE_COMMAND} -D ROOT=${PROJECT_SOURCE_DIR} -P ${CMAKE_CURRENT_SOURCE_DIR}/compilers.cmake)
add_test(NAME units COMMAND ${CMAKE_COMMAND} -D KERNEL=${PROJECT_SOURCE_DIR}/kernel -P ${CMAKE_CURRENT_SOURCE_DIR}/units.cmake)

if(SHAFTCULL_BASH)
  add_test(NAME first_command COMMAND ${SHAFTCULL_BASH} ${CMAKE_CURRENT_SOURCE_DIR}/first_command.sh)
  add_test(NAME check_steps COMMAND ${SHAFTCULL_BASH} ${CMAKE_CURRENT_SOURCE_DIR}/check_steps.sh)
  add_test(NAME packages.release COMMAND ${SHAFTCULL_BASH} ${CMAKE_CURRENT_SOURCE_DIR}/packages/release.sh)
  set_tests_properties(first_command check_steps packages.release PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 60)
endif()

# The documentation site is made without a warning: every public name is documented, and no page is missing. Twenty seconds.
if(SHAFTCULL_BASH)
  add_test(NAME docs
    COMMAND ${SHAFTCULL_BASH} ${PROJECT_SOURCE_DIR}/cmake/site/build.sh ${CMAKE_CURRENT_BINARY_DIR}/docs-work
            ${CMAKE_CURRENT_BINARY_DIR}/docs)
  set_tests_properties(docs PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 120)
  # Links and their anchors lead somewhere, in the repository and in the site.
  add_test(NAME documents.links
    COMMAND ${SHAFTCULL_BASH} ${CMAKE_CURRENT_SOURCE_DIR}/links.sh ${PROJECT_SOURCE_DIR} 150)
  add_test(NAME docs.links
    COMMAND ${SHAFTCULL_BASH} ${CMAKE_CURRENT_SOURCE_DIR}/links.sh ${CMAKE_CURRENT_BINARY_DIR}/docs 10000)
  set_tests_properties(documents.links docs.links PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 60)
  set_tests_properties(docs.links PROPERTIES DEPENDS docs)
  # Every environment variable and option is on the page about tuning, and nothing else is.
  add_test(NAME documents.tuning COMMAND ${SHAFTCULL_BASH} ${CMAKE_CURRENT_SOURCE_DIR}/tuning.sh)
endif()
