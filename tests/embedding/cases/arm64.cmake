# SPDX-License-Identifier: MIT
# 64-bit ARM, emulated.
configure_for_processor(aarch64)
build()
answers("scalar: as on record\nneon: as on record\n")
hashes("neon: hashes as on record\n" --best)
