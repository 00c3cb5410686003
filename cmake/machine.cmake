# SPDX-License-Identifier: MIT
# Sets shaftcull_set_of_machine: the best instruction set of this machine's processor. Empty where /proc/cpuinfo does not say.

set(shaftcull_set_of_machine "")
if(EXISTS /proc/cpuinfo)
  file(STRINGS /proc/cpuinfo cpu_flags REGEX "^flags" LIMIT_COUNT 1)
  if(cpu_flags MATCHES "avx512f" AND cpu_flags MATCHES "avx512cd" AND cpu_flags MATCHES "avx512dq"
     AND cpu_flags MATCHES "avx512bw" AND cpu_flags MATCHES "avx512vl")
    set(shaftcull_set_of_machine avx512)
  elseif(cpu_flags MATCHES " avx2 " AND cpu_flags MATCHES " fma " AND cpu_flags MATCHES " bmi2 ")
    set(shaftcull_set_of_machine avx2)
  elseif(cpu_flags MATCHES " sse4_2 " AND cpu_flags MATCHES " popcnt ")
    set(shaftcull_set_of_machine sse4_2)
  endif()
endif()
