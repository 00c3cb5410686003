# SPDX-License-Identifier: MIT
# A library that is too new.
add_library(New::library INTERFACE IMPORTED)
set(New_VERSION 4.0)
set(New_DIR /opt/new)
