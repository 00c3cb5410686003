# SPDX-License-Identifier: MIT
# The tests on processors that this machine is not: emulated by qemu-user, with the very binaries that run here. An instruction
# that such a processor lacks ends the test, so this also shows that no AVX code leaked into what everybody runs.

if(NOT CMAKE_SYSTEM_NAME STREQUAL "Linux" OR NOT "avx2" IN_LIST isas)
  return()
endif()
if("${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${CMAKE_BUILD_TYPE}}" MATCHES "-fsanitize")
  return()  # sanitizers lay out memory as qemu-user does not allow
endif()
if(CMAKE_BUILD_TYPE STREQUAL "Debug")
  return()  # these tests are of the optimised code that is shipped
endif()
find_program(SHAFTCULL_QEMU qemu-x86_64)

# shaftcull_emulated_test(CPU ISA AREA [argument…]): emulated.<cpu>.<area>, which must find that ISA is the best there is. CPU may
# take features away: Haswell,-xsave is one whose operating system does not save AVX registers.
function(shaftcull_emulated_test cpu isa area)
  string(TOLOWER "emulated.${cpu}" label)
  string(REPLACE "," "" label ${label})
  if(SHAFTCULL_QEMU)
    add_test(NAME ${label}.${area} COMMAND ${SHAFTCULL_QEMU} -cpu ${cpu} $<TARGET_FILE:test_${area}> ${ARGN})
  else()
    add_test(NAME ${label}.${area}
      COMMAND sh -c "echo 'Skipped: qemu-x86_64 was not found when this was configured (Debian: qemu-user).'; exit 77")
  endif()
  set_tests_properties(${label}.${area} PROPERTIES
    LABELS ${label} ENVIRONMENT SHAFTCULL_EXPECTED_ISA=${isa} SKIP_RETURN_CODE 77 TIMEOUT 900)
endfunction()

# What has no code of its own for an instruction set is run on the older processor alone. Left out are the tests that spend most
# of their time on rationals, which emulation slows down the most, and what runs in other floating-point modes, which it does in
# software: answers on record (same_bits) stand in for them.
set(slow Oracle.* QuickHull.* FloatEnvironment.Answers* GoldenAnswers.EverySphere* *.EveryMagnitude* *.EveryColouring* *.*FarFrom*
  ExactSpheres.*Huge* ExactSpheres.*Touch* ExactSpheres.Radii* ExactSpheres.Random* ExactSpheres.*OnAGridOf* ExactSpheres.*Joining*
  ExactBoxes.SweepsThatEnd* AddedPlanes.SpheresAt* AddedPlanes.Huge* Kinds.*Exactly Kinds.*Away Kinds.ShadowsThatLeave* Occluded.*Exactly FirstContact*.*ExactArithmetic*
  OpenContact.*Exactly OpenContactVerbs.* Triangles.*Exactly Triangles.AddedPlanes* Triangles.Counts*)
list(JOIN slow ":" slow)
# Guard pages are left to real processors: qemu 7.2 reads all lanes of a masked load, also those that are masked out.
set(guarded Views.EveryCountOf* Occluded.NothingBehind* Views.NothingBehind* Triangles.EveryCount*)
list(JOIN guarded ":" guarded)
shaftcull_emulated_test(core2duo portable128 isa)
shaftcull_emulated_test(core2duo portable128 simd)
shaftcull_emulated_test(core2duo portable128 same_bits)
shaftcull_emulated_test(Nehalem sse4_2 isa)
shaftcull_emulated_test(Nehalem sse4_2 same_bits)
shaftcull_emulated_test(Nehalem sse4_2 cull --gtest_filter=-${slow})
shaftcull_emulated_test(Nehalem sse4_2 hull --gtest_filter=Hull.GoesWhere*:Hull.OfCastersTowards*:HullGolden*)
shaftcull_emulated_test(Nehalem sse4_2 formation)
shaftcull_emulated_test(Nehalem sse4_2 streams)
shaftcull_emulated_test(Nehalem sse4_2 many --gtest_filter=Many*:SetBits*:Outputs.ListMany*)  # one output: each takes a quarter of a minute
shaftcull_emulated_test(Nehalem sse4_2 allocation)
shaftcull_emulated_test(Nehalem sse4_2 tree --gtest_filter=Refine*)
shaftcull_emulated_test(Nehalem sse4_2 tree_building --gtest_filter=Split*:TreeOrder*-SplitEntries.*Largest*:SplitEntries.*FewValues*:SplitEntries.*Sample*)
shaftcull_emulated_test(Haswell,-xsave sse4_2 isa)
shaftcull_emulated_test(Haswell,-xsave sse4_2 same_bits)
shaftcull_emulated_test(Haswell avx2 isa)
shaftcull_emulated_test(Haswell avx2 same_bits)
shaftcull_emulated_test(Haswell avx2 cull --gtest_filter=-${slow}:${guarded})
shaftcull_emulated_test(Haswell avx2 hull --gtest_filter=Hull.GoesWhere*:Hull.OfCastersTowards*:HullGolden*)
shaftcull_emulated_test(Haswell avx2 many --gtest_filter=Many*:SetBits*)
shaftcull_emulated_test(Haswell avx2 tree --gtest_filter=Refine*)
shaftcull_emulated_test(Haswell avx2 tree_building --gtest_filter=Split*:TreeOrder*-SplitEntries.*Largest*:SplitEntries.*FewValues*:SplitEntries.*Sample*)
