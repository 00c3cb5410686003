# SPDX-License-Identifier: MIT
# 64-bit RISC-V, which has portable kernels only, emulated. Its floating-point modes are those of <cfenv>.
configure_for_processor(riscv64)
build()
answers("scalar: as on record\nportable128: as on record\n")
hashes("portable128: hashes as on record\n" --best)
