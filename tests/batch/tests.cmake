# SPDX-License-Identifier: MIT
# Tests of `shaftcull batch`: of its parts and of jobs in one process, in C++; of the program and of ranks, by Python.

shaftcull_test(batch
  batch/array_file.cpp
  batch/block_store.cpp
  batch/dealing.cpp
  batch/dealt_bounds.cpp
  batch/interrupted_job.cpp
  batch/job.cpp
  batch/progress_lines.cpp
  batch/share_plan.cpp)
target_link_libraries(test_batch PRIVATE shaftcull_batch HDF5::HDF5 nlohmann_json::nlohmann_json)
add_dependencies(test_batch shaftcull_cli)  # which the tests below run

# Where NumPy, h5py or MPI is missing, these are skipped.
if(SHAFTCULL_SYSTEM_PYTHON)
  set(launcher "")
  if(MPI_CXX_FOUND AND NOT CMAKE_CXX_FLAGS MATCHES "-fsanitize")  # Open MPI leaves memory behind, which would be told
    set(launcher ${MPIEXEC_EXECUTABLE})
  endif()
  foreach(case IN ITEMS model numpy doubles ranks killed trees memory errors sees sees_csv sees_ended sees_refused
      sees_turned factors factors_ended factors_refused sun sun_ended)
    if(case STREQUAL memory AND CMAKE_CXX_FLAGS MATCHES "-fsanitize")
      continue()  # they write to memory of their own
    endif()
    add_test(NAME batch.${case}
      COMMAND ${SHAFTCULL_SYSTEM_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/run.py ${case} $<TARGET_FILE:shaftcull_cli> "${launcher}")
    set_tests_properties(batch.${case} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 600)
  endforeach()
else()
  message(STATUS "No tests batch.…: there is no python3 on this machine")
endif()
