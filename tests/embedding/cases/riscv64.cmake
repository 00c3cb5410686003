# SPDX-License-Identifier: MIT
# 64-bit RISC-V, which has portable kernels only, emulated. Its floating-point modes are those of <cfenv>.
needs(riscv64-linux-gnu-g++)
find_program(qemu_riscv64 qemu-riscv64)
if(NOT qemu_riscv64)
  skip("there is no qemu-riscv64 on this machine")
endif()
set(emulator ${qemu_riscv64})
configure(riscv64-linux-gnu-g++ -D CMAKE_SYSTEM_NAME=Linux -D CMAKE_SYSTEM_PROCESSOR=riscv64 -D CMAKE_EXE_LINKER_FLAGS=-static
  -D CMAKE_BUILD_TYPE=Release -D SHAFTCULL_WITH_TBB=OFF -D CMAKE_DISABLE_FIND_PACKAGE_xsimd=ON
  -D PARENT_MORE=${CMAKE_CURRENT_LIST_DIR}/../parent/hashes.cmake)
build()
answers("scalar: as on record\nportable128: as on record\n")
hashes("scalar: hashes as on record\nportable128: hashes as on record\n")
