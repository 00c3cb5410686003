# SPDX-License-Identifier: MIT
# A library of the parent's own that it installs and exports, and two plugins with a program that loads them.
add_library(scene STATIC ${CMAKE_CURRENT_LIST_DIR}/scene.cpp)
target_link_libraries(scene PUBLIC shaftcull::shaftcull)
install(TARGETS scene EXPORT scene)
install(EXPORT scene NAMESPACE parent:: FILE scene-targets.cmake DESTINATION lib/cmake/scene)
file(WRITE ${CMAKE_CURRENT_BINARY_DIR}/scene-config.cmake
  "include(CMakeFindDependencyMacro)\nfind_dependency(shaftcull)\n"
  "include(\"\${CMAKE_CURRENT_LIST_DIR}/scene-targets.cmake\")\nadd_library(scene::scene ALIAS parent::scene)\n")
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/scene-config.cmake DESTINATION lib/cmake/scene)

foreach(plugin IN ITEMS first second)
  add_library(${plugin} MODULE ${CMAKE_CURRENT_LIST_DIR}/plugin.cpp)
  set_target_properties(${plugin} PROPERTIES PREFIX "")
  target_link_libraries(${plugin} PRIVATE shaftcull::shaftcull)
endforeach()
add_executable(host ${CMAKE_CURRENT_LIST_DIR}/host.cpp)
target_compile_features(host PRIVATE cxx_std_20)
target_link_libraries(host PRIVATE ${CMAKE_DL_LIBS})
