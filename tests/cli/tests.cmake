# SPDX-License-Identifier: MIT
# Tests of the program shaftcull, from outside.

set(shaftcull_cli_to_run $<TARGET_FILE:shaftcull_cli>)
set(shaftcull_cli_for_tests $<TARGET_FILE:shaftcull_cli>)
if(shaftcull_emulator)
  set(shaftcull_cli_to_run ${CMAKE_CURRENT_BINARY_DIR}/shaftcull-emulated)
  file(GENERATE OUTPUT ${shaftcull_cli_to_run}
    CONTENT "#!/bin/sh\nexec '${shaftcull_emulator}' '$<TARGET_FILE:shaftcull_cli>' \"$@\"\n"
    FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
  if(NOT WIN32)  # where tests, being programs of Windows themselves, run it as it is
    set(shaftcull_cli_for_tests ${shaftcull_cli_to_run})
  endif()
endif()
shaftcull_test(cli
  cli/crc32_test.cpp
  cli/draw_test.cpp
  cli/file_names_test.cpp
  cli/hash_test.cpp
  cli/interrupt_test.cpp
  cli/mesh_parts_test.cpp
  cli/name_pattern_test.cpp
  cli/no_mesh_reader_test.cpp
  cli/options_test.cpp
  cli/printable_test.cpp
  cli/program.cpp
  cli/program_${shaftcull_system}.cpp
  cli/program_test.cpp
  cli/progress_test.cpp
  cli/sees_test.cpp
  cli/shaft_choice_test.cpp
  cli/stats_test.cpp
  ${PROJECT_SOURCE_DIR}/programs/shaftcull/${shaftcull_system}/file_path.cpp
  ${PROJECT_SOURCE_DIR}/programs/shaftcull/${shaftcull_system}/interrupt.cpp
  ${PROJECT_SOURCE_DIR}/programs/shaftcull/${shaftcull_system}/standard_streams.cpp
  ${PROJECT_SOURCE_DIR}/programs/shaftcull/mesh_parts.cpp
  ${PROJECT_SOURCE_DIR}/programs/shaftcull/name_pattern.cpp
  ${PROJECT_SOURCE_DIR}/programs/shaftcull/no_mesh_reader.cpp
  ${PROJECT_SOURCE_DIR}/programs/shaftcull/printable.cpp
  ${PROJECT_SOURCE_DIR}/programs/shaftcull/progress.cpp)
if(NOT WIN32)
  target_sources(test_cli PRIVATE
    cli/interrupted_program_test.cpp
    cli/output_test.cpp
    cli/running_program.cpp
    cli/sees_posix_test.cpp)
endif()
target_include_directories(test_cli PRIVATE ${PROJECT_SOURCE_DIR}/programs/shaftcull)
if(assimp_FOUND)
  target_sources(test_cli PRIVATE
    cli/cull_errors_test.cpp
    cli/cull_parts_test.cpp
    cli/cull_test.cpp
    cli/factors_test.cpp
    cli/sun_test.cpp
    cli/mesh_import_test.cpp
    cli/sees_mesh_test.cpp
    cli/small_scenes_test.cpp)
endif()
if(assimp_FOUND AND NOT WIN32)
  # It has a reader of its own in place of the program's.
  shaftcull_test(mesh_reader cli/mesh_reader_test.cpp ${PROJECT_SOURCE_DIR}/programs/shaftcull/isolated_mesh.cpp)
  target_include_directories(test_mesh_reader PRIVATE ${PROJECT_SOURCE_DIR}/programs/shaftcull)
  target_link_libraries(test_mesh_reader PRIVATE fmt::fmt)
endif()
target_link_libraries(test_cli PRIVATE shaftcull_hashes fmt::fmt nlohmann_json::nlohmann_json ZLIB::ZLIB)
target_compile_definitions(test_cli PRIVATE
  SHAFTCULL_CLI="${shaftcull_cli_for_tests}"
  SHAFTCULL_DOCS="${PROJECT_SOURCE_DIR}/docs"
  SHAFTCULL_SMALL_SCENES="${CMAKE_CURRENT_SOURCE_DIR}/cli/scenes")
add_dependencies(test_cli shaftcull_cli)
# Hashes of all cases; same_bits asks about the first ones. Half a minute where the program is optimised, a quarter of it on one
# instruction set, and minutes for one where the processor is emulated.
if(CMAKE_BUILD_TYPE STREQUAL "Release")
  add_test(NAME hash.best COMMAND ${shaftcull_cli_to_run} hash --isa ${shaftcull_best_set})
  set_tests_properties(hash.best PROPERTIES TIMEOUT ${shaftcull_test_seconds})
  if(NOT shaftcull_emulates_processor)
    add_test(NAME hash COMMAND ${shaftcull_cli_to_run} hash)
    set_tests_properties(hash PROPERTIES TIMEOUT ${shaftcull_test_seconds})
  endif()
endif()
if(assimp_FOUND AND SHAFTCULL_SYSTEM_PYTHON AND NOT CMAKE_CROSSCOMPILING)
  add_test(NAME cli.openfoam
    COMMAND ${SHAFTCULL_SYSTEM_PYTHON} ${CMAKE_CURRENT_SOURCE_DIR}/cli/openfoam_test.py
            ${PROJECT_SOURCE_DIR}/docs/examples/openfoam.py $<TARGET_FILE:shaftcull_cli>)
  set_tests_properties(cli.openfoam PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT ${shaftcull_test_seconds})
endif()
add_test(NAME cli.manual
  COMMAND ${CMAKE_COMMAND} -D PROGRAM=${shaftcull_cli_to_run} -D PAGE=${PROJECT_SOURCE_DIR}/docs/shaftcull.1
          -D VERSION=${PROJECT_VERSION} -P ${CMAKE_CURRENT_SOURCE_DIR}/cli/manual.cmake)
