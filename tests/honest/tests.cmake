# SPDX-License-Identifier: MIT
# What `shaftcull sees` proves of meshes as they come, against rays: 100,000 pairs of each mesh, 64 rays a pair. Skipped without NumPy.
if(SHAFTCULL_SYSTEM_PYTHON AND assimp_FOUND)
  foreach(mesh IN ITEMS turned_rooms l_rooms t_junctions sheets mirrored scan hall facades open_blocks city overlapping)
    add_test(NAME honest.${mesh}
      COMMAND ${SHAFTCULL_SYSTEM_PYTHON} ${CMAKE_CURRENT_LIST_DIR}/run.py $<TARGET_FILE:shaftcull_cli> ${mesh})
    set_tests_properties(honest.${mesh} PROPERTIES SKIP_RETURN_CODE 77 TIMEOUT 1500)
  endforeach()
endif()
