# SPDX-License-Identifier: MIT
# s390x, a big-endian processor (Debian's libraries: libtbb-dev:s390x and so on).
set(CMAKE_SYSTEM_PROCESSOR s390x)
include(${CMAKE_CURRENT_LIST_DIR}/debian-cross.cmake)
