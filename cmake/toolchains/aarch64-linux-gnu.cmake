# SPDX-License-Identifier: MIT
# 64-bit ARM (Debian's libraries: libtbb-dev:arm64 and so on).
set(CMAKE_SYSTEM_PROCESSOR aarch64)
include(${CMAKE_CURRENT_LIST_DIR}/debian-cross.cmake)
