# SPDX-License-Identifier: MIT
# A program that compares hashes of answers with those on record.
file(GLOB hashes ${SHAFTCULL}/bench/hashes/*.cpp)
add_executable(hashes ${SHAFTCULL}/tests/embedding/hashes.cpp ${hashes})
target_include_directories(hashes PRIVATE ${SHAFTCULL}/bench ${SHAFTCULL}/tests)
target_link_libraries(hashes PRIVATE shaftcull::shaftcull)
