# SPDX-License-Identifier: MIT
# A big-endian processor, which has portable kernels only, emulated.
configure_for_processor(s390x)
build()
answers("scalar: as on record\nportable128: as on record\n")
hashes("portable128: hashes as on record\n" --best)
