# SPDX-License-Identifier: MIT
# Sets machine_has_avx2 and machine_has_avx512: whether this machine runs them, as far as the library uses them.

set(machine_has_avx2 FALSE)
set(machine_has_avx512 FALSE)
if(EXISTS /proc/cpuinfo)
  file(STRINGS /proc/cpuinfo cpu_flags REGEX "^flags" LIMIT_COUNT 1)
  if(cpu_flags MATCHES " avx2 " AND cpu_flags MATCHES " fma " AND cpu_flags MATCHES " bmi2 ")
    set(machine_has_avx2 TRUE)
  endif()
  if(cpu_flags MATCHES "avx512f" AND cpu_flags MATCHES "avx512cd" AND cpu_flags MATCHES "avx512dq"
     AND cpu_flags MATCHES "avx512bw" AND cpu_flags MATCHES "avx512vl")
    set(machine_has_avx512 TRUE)
  endif()
endif()
