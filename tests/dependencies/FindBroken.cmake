# SPDX-License-Identifier: MIT
# A library whose own dependency names a file that does not exist, inside of a generator expression.
add_library(Broken::inner INTERFACE IMPORTED)
set_property(TARGET Broken::inner PROPERTY INTERFACE_LINK_LIBRARIES m "$<$<NOT:$<CONFIG:DEBUG>>:/nowhere/libz.so>")
add_library(Broken::library INTERFACE IMPORTED)
set_property(TARGET Broken::library PROPERTY INTERFACE_LINK_LIBRARIES Broken::inner Broken::library)
set(Broken_VERSION 2.1)
