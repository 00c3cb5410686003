# SPDX-License-Identifier: MIT
# Libraries of headers alone are the same for every system, so those of this machine do for others, too.

# shaftcull_header_library(TARGET FOLDER): the imported target TARGET, if this machine has its headers, as FOLDER/…. Its include
# path leads to a folder that has them and nothing else: /usr/include would come before the compiler's own headers. For modules of
# find_package(): the package is found if the target exists.
function(shaftcull_header_library target folder)
  find_path(SHAFTCULL_HEADERS_${folder} ${folder} PATHS /usr/local/include /usr/include NO_DEFAULT_PATH NO_CMAKE_FIND_ROOT_PATH)
  mark_as_advanced(SHAFTCULL_HEADERS_${folder})
  if(SHAFTCULL_HEADERS_${folder} AND NOT TARGET ${target})
    set(include ${CMAKE_BINARY_DIR}/headers/${folder})
    file(MAKE_DIRECTORY ${include})
    file(CREATE_LINK ${SHAFTCULL_HEADERS_${folder}}/${folder} ${include}/${folder} SYMBOLIC)
    add_library(${target} INTERFACE IMPORTED GLOBAL)
    target_include_directories(${target} INTERFACE ${include})
  endif()
  if(TARGET ${target})
    set(${CMAKE_FIND_PACKAGE_NAME}_FOUND TRUE PARENT_SCOPE)
  endif()
endfunction()
