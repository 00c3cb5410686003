# SPDX-License-Identifier: MIT
# Another standard library.
configure_with_libcxx(19)
build()
answers()
