# Shows that tests can fail: each fault in the library must be noticed by wrong answers, not by a crash, in every area and
# form that it concerns. Arguments: TEST (the mutant executable), ISA.
function(run fault filter)
  execute_process(
    COMMAND ${CMAKE_COMMAND} -E env SHAFTCULL_MUTANT=${fault} SHAFTCULL_ISA=${ISA} ${TEST} --gtest_filter=${filter} ${ARGN}
    RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  set(result ${result} PARENT_SCOPE)
  set(output "${output}" PARENT_SCOPE)
endfunction()

# Whether the last run gave wrong answers in all of the forms.
function(noticed_in result_name)
  set(${result_name} TRUE PARENT_SCOPE)
  foreach(form IN LISTS ARGN)
    if(NOT result EQUAL 1 OR NOT output MATCHES "on ${ISA}, form ${form};[^;]* is (outside|overlap|inside|blocking|not blocking), answered ")
      set(${result_name} FALSE PARENT_SCOPE)
    endif()
  endforeach()
endfunction()

# The first test that fails is enough if it fails in all forms; else all of them are tried.
function(must_notice fault filter)
  list(JOIN ARGN " and " forms)
  run(${fault} ${filter} --gtest_fail_fast)
  noticed_in(noticed ${ARGN})
  if(NOT noticed)
    run(${fault} ${filter})
    noticed_in(noticed ${ARGN})
  endif()
  if(NOT noticed)
    message(SEND_ERROR "With the fault ${fault}, ${filter} should give wrong answers in ${forms} form on ${ISA}, "
                       "but ended with ${result}:\n${output}")
  endif()
  string(REGEX MATCHALL "\\[  FAILED  \\] [A-Za-z0-9.]+ \\(" failed "${output}")
  string(REGEX REPLACE "\\[  FAILED  \\] ([A-Za-z0-9.]+) \\(" "\\1" failed "${failed}")
  set(failing ${failing} ${failed} PARENT_SCOPE)
  list(JOIN failed ", " failed)
  message(STATUS "${fault}: ${failed} fail, in ${forms} form")
endfunction()

run(none -*)
if(result EQUAL 77)
  message(STATUS "Skipped: this machine does not have ${ISA}")
  return()
endif()

set(added_boxes "AddedPlanes.*Boxes*")
set(added_spheres "AddedPlanes.*Spheres*")
must_notice(slab_margin ExactBoxes.* slab)
must_notice(slab_margin ExactSpheres.* slab)
must_notice(relative_margin ExactBoxes.* slab)
must_notice(joining_margin ExactBoxes.* planes)
must_notice(joining_margin ExactSpheres.* planes)
if(ISA MATCHES "^avx")  # where a few boxes are tested for being inside with the margin in the sum
  must_notice(joining_margin ExactBoxes.* slab)
endif()
must_notice(accept_margin ExactSpheres.* slab planes)
if(ISA MATCHES "^(scalar|portable128|sse4_2)$")  # with fused multiply-adds, errors stay within a tenth of this margin in all cases tried
  must_notice(bound_margin ExactSpheres.* planes)
endif()
must_notice(radius_margin ExactSpheres.* planes)
if(NOT ISA MATCHES "^(scalar|portable128)$")  # which have no grid
  must_notice(slab_margin ExactBoxes.* grid)
  must_notice(grid_slack ExactBoxes.* grid)
  must_notice(grid_slack ExactSpheres.* grid)
  must_notice(grid_limit ExactBoxes.* grid)
endif()
must_notice(blocking_margin Blocked.* blocking)
must_notice(no_exact_step Blocked.* blocking)
must_notice(measured_error ExactSpheres.* slab planes)
must_notice(added_margin ${added_boxes} slab planes)
must_notice(added_margin ${added_spheres} slab planes)
foreach(filter IN ITEMS ExactBoxes.* ExactSpheres.* ${added_boxes} ${added_spheres})
  must_notice(no_exact_step ${filter} slab planes grid)
endforeach()

# It is the faults that they notice.
list(REMOVE_DUPLICATES failing)
list(JOIN failing ":" filter)
run(none ${filter})
if(NOT result EQUAL 0)
  message(SEND_ERROR "Without a fault ${filter} should pass, but ended with ${result}:\n${output}")
endif()
