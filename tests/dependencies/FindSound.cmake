# SPDX-License-Identifier: MIT
# A library of a newer major version than asked for, all of whose files exist.
add_library(Sound::library INTERFACE IMPORTED)
set_property(TARGET Sound::library PROPERTY INTERFACE_LINK_LIBRARIES m "${CMAKE_CURRENT_LIST_FILE}")
set(Sound_VERSION 13.0)
