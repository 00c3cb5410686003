# Checks that object files hold the instructions that fetch memory into the second-level cache: g++ 12 leaves out calls of
# functions that do nothing else, and all answers stay as they are. Given: OBJDUMP, OBJECTS (the object files), UNITS (the
# ends of the names of those that fetch).
cmake_minimum_required(VERSION 3.22)

foreach(unit IN LISTS UNITS)
  set(found FALSE)
  foreach(object IN LISTS OBJECTS)
    if(NOT object MATCHES "${unit}\\.(o|obj)$")
      continue()
    endif()
    set(found TRUE)
    execute_process(COMMAND ${OBJDUMP} -d --no-show-raw-insn ${object} RESULT_VARIABLE result OUTPUT_VARIABLE output)
    if(NOT result EQUAL 0)
      message(FATAL_ERROR "${OBJDUMP} cannot read ${object}")
    endif()
    if(NOT output MATCHES "prefetcht1")
      message(FATAL_ERROR "${object} fetches nothing: the compiler has left it out")
    endif()
  endforeach()
  if(NOT found)
    message(FATAL_ERROR "no object file ends in ${unit}; there are: ${OBJECTS}")
  endif()
endforeach()
