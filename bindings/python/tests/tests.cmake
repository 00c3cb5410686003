# SPDX-License-Identifier: MIT
# Tests of the Python package, the area `python`. Included by tests/CMakeLists.txt.

set(python_tests ${PROJECT_SOURCE_DIR}/bindings/python/tests)

add_custom_target(test_python)
add_dependencies(test_python shaftcull_python)
add_dependencies(shaftcull_tests test_python)

# shaftcull_python_test(NAME FILE…): the CTest entry python.NAME, which runs these files with pytest. Without pytest it is skipped.
function(shaftcull_python_test name)
  list(TRANSFORM ARGN PREPEND ${python_tests}/)
  add_test(NAME python.${name}
    COMMAND ${CMAKE_COMMAND} -D PYTHON=${Python3_EXECUTABLE} "-DFILES=${ARGN}" -P ${python_tests}/run.cmake)
  set_tests_properties(python.${name} PROPERTIES
    SKIP_REGULAR_EXPRESSION "no module named pytest"
    ENVIRONMENT "PYTHONPATH=${PROJECT_BINARY_DIR}/python;PYTHONDONTWRITEBYTECODE=1" TIMEOUT 600)
endfunction()

shaftcull_python_test(documents test_documents.py)
shaftcull_python_test(questions test_questions.py)
shaftcull_python_test(inputs test_inputs.py test_volumes.py)
shaftcull_python_test(processes test_processes.py)
shaftcull_python_test(stubs test_stubs.py)
shaftcull_python_test(wheel test_wheel.py)
shaftcull_python_test(examples test_examples.py)
shaftcull_python_test(visibility test_visibility.py)
shaftcull_python_test(dynamic test_dynamic.py)
