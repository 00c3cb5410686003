# SPDX-License-Identifier: MIT
# The oldest libc++ that will do.
configure_with_libcxx(16)
build()
answers()
