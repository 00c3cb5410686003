# SPDX-License-Identifier: MIT
# A library that is too old.
add_library(Old::library INTERFACE IMPORTED)
set(Old_VERSION 2.0)
set(Old_DIR /opt/old)
