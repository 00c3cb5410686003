# SPDX-License-Identifier: MIT
# Three layers of tests, as labels of CTest entries:
#   quick   ./cmake/run test: every promise of the headers once, on the best instruction set and on scalar; C and Python; documents
#   ci      .ci/run has these, too: other instruction sets, the program, memory, a part of other processors and other people's builds
#   none    only ./cmake/run test --all runs it: it takes long and seldom finds what the others miss
# docs/testing.md says what each layer would miss. Included by CMakeLists.txt.

# Regular expressions of whole names of entries.
set(quick_tests
  # The library, against exact arithmetic and answers on record.
  executor cull[.].* hull[.].* visibility[.].* view_factors solids formation interface streams isa
  "(same_bits|simd)[.].*"
  "(dynamic|many|many_tree|options|tree|tree_building|allocation)[.](scalar|${shaftcull_best_set})" calls[.]${shaftcull_best_set}
  # Its bindings and what its pages show.
  "c[.](gcc|example|header|symbols|ten_minutes|sights)" "python[.](documents|questions|inputs|visibility|dynamic|examples)" examples[.].* consumer
  # The sources and the build.
  architecture check_steps compilers dependencies documents "documents[.](figures|links|tuning)" exports fetches first_command headers "packages[.](licences|spdx)"
  symbols[.].* units)
set(ci_tests
  wide allocation.* calls[.]aarch64 dynamic_threads many_tree[.].* mesh_reader out_of_memory tree_memory visibility_memory
  "cli([.].*)?" "batch|batch[.](model|numpy|doubles|ranks|trees|sees_turned|factors|sun_ended)" budget[.].* docs "docs[.]links" "c([._].*)?" python[.].* "packages[.](conan|release|vcpkg)" hash.best
  "emulated[.][^.]*[.]isa"
  "embedding[.](neon|strict|optimisation|refused|cross|package|recipe|embree)")
if(CMAKE_CXX_FLAGS MATCHES "-fsanitize=[a-z,]*address")
  # Where memory is touched. The corpus asks about visibility, too; its own area and agreement of the C interface take long, and find
  # no planted fault that these miss.
  set(quick_tests "")
  set(ci_tests
    "(calls|dynamic|many|many_tree|tree)[.]${shaftcull_best_set}" tree_building[.].* streams c_memory fuzz_corpus)
elseif(CMAKE_CXX_FLAGS MATCHES "-fsanitize=[a-z,]*thread")
  # Where threads are, which share work in one way on all instruction sets. `executor` has each kind of parallel call.
  set(quick_tests "")
  set(ci_tests "(many|many_tree)[.](${shaftcull_best_set}|planted_race[.].*)" dynamic_threads executor)
endif()
set(layer_expressions ${quick_tests} ${ci_tests})
list(JOIN quick_tests "|" quick_tests)
list(JOIN ci_tests "|" ci_tests)

# Entries that do not run the library have the label `sources`: planted faults do not concern them (mutation/mutate.py).
set(sources_tests architecture check_steps compilers dependencies docs "docs[.]links" documents "documents[.](figures|links|tuning)" exports fetches first_command
  headers packages[.].* symbols[.].* units c[.]header c[.]symbols cli[.]manual python[.]stubs budget[.].* report)
list(JOIN sources_tests "|" sources_tests)

# All that CTest runs, and what the layers run of it.
add_custom_target(shaftcull_tests)
add_custom_target(shaftcull_quick_tests)
add_custom_target(shaftcull_ci_tests)
add_dependencies(shaftcull_ci_tests shaftcull_quick_tests)

# shaftcull_layers(): gives the tests of this folder their labels, and has the layers' targets build what they run. Called at the end
# of each folder's CMakeLists.txt.
function(shaftcull_layers)
  get_property(tests DIRECTORY PROPERTY TESTS)
  set_property(GLOBAL APPEND PROPERTY SHAFTCULL_TESTS ${tests})
  foreach(test IN LISTS tests)
    if(test MATCHES "^(${sources_tests})$")
      set_property(TEST ${test} APPEND PROPERTY LABELS sources)
    endif()
    foreach(layer IN ITEMS quick ci)
      if(test MATCHES "^(${${layer}_tests})$")
        set_property(TEST ${test} APPEND PROPERTY LABELS ${layer})
        # An entry is named after its area; one that is emulated is so at its end.
        string(REGEX REPLACE "^emulated[.].*[.]" "" area ${test})
        string(REGEX REPLACE "[.].*" "" area ${area})
        if(layer STREQUAL "quick" AND test MATCHES "^c[.]")
          string(REPLACE "." "_" area ${test})  # each is a program of its own; the area's own program belongs to ci
        endif()
        if(TARGET test_${area})
          add_dependencies(shaftcull_${layer}_tests test_${area})
        endif()
        if(test MATCHES "planted_race")
          add_dependencies(shaftcull_${layer}_tests test_planted_race)
        endif()
        break()
      endif()
    endforeach()
  endforeach()
endfunction()

# shaftcull_check_layers(): an expression above that no entry has is an error where everything is built, so that none is left out by a
# name that was changed. Called when all entries are there.
function(shaftcull_check_layers)
  get_property(tests GLOBAL PROPERTY SHAFTCULL_TESTS)
  foreach(expression IN LISTS layer_expressions)
    set(found ${tests})
    list(FILTER found INCLUDE REGEX "^(${expression})$")
    if(NOT found)
      message(SEND_ERROR "tests/layers.cmake names ${expression}, which no test is called")
    endif()
  endforeach()
endfunction()
