# SPDX-License-Identifier: MIT
# A program that compares hashes of answers with those on record.
file(GLOB hashes ${SHAFTCULL}/conformance/hashes/*.cpp)
add_executable(hashes ${SHAFTCULL}/tests/embedding/hashes.cpp ${hashes})
target_include_directories(hashes PRIVATE ${SHAFTCULL}/conformance)
target_link_libraries(hashes PRIVATE shaftcull::shaftcull)
