# SPDX-License-Identifier: MIT
# Whether the Python package can be built: SHAFTCULL_HAS_PYTHON. It needs a Python with its headers and NumPy, and pybind11.

# The `python3` in the PATH may lack what the system's has, as those of version managers do. The first one that has all is taken,
# with pytest for the tests rather than without.
if(NOT Python3_EXECUTABLE)
  foreach(modules IN ITEMS "numpy, pytest" numpy)
    foreach(candidate IN ITEMS python3 /usr/bin/python3)
      if(NOT Python3_EXECUTABLE)
        execute_process(
          COMMAND ${candidate} -c
                  "import os, sys, sysconfig, ${modules}; assert os.path.exists(sysconfig.get_path('include') + '/Python.h'); print(sys.executable)"
          RESULT_VARIABLE status OUTPUT_VARIABLE executable ERROR_QUIET OUTPUT_STRIP_TRAILING_WHITESPACE)
        if(status EQUAL 0)
          set(Python3_EXECUTABLE ${executable} CACHE FILEPATH "The Python that the package is built for")
        endif()
      endif()
    endforeach()
  endforeach()
endif()
set(SHAFTCULL_HAS_PYTHON FALSE)
if(Python3_EXECUTABLE)
  find_package(Python3 3.9 QUIET COMPONENTS Interpreter Development.Module NumPy)
  find_package(pybind11 2.10 QUIET)
  if(Python3_FOUND AND pybind11_FOUND)
    set(SHAFTCULL_HAS_PYTHON TRUE)
  endif()
endif()
