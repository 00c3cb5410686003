// SPDX-License-Identifier: MIT
/// What the library finds out of the processor, against what the compiler's own functions say.
#include "support/processor.hpp"

#include <gtest/gtest.h>

namespace shaftcull::kernel {
namespace {

TEST(ProcessorFeature, IsThereWhereTheCompilerSaysSo) {
#if defined(__x86_64__)
  EXPECT_EQ(processor_has(ProcessorFeature::sse4_2), __builtin_cpu_supports("sse4.2") != 0);
  EXPECT_EQ(processor_has(ProcessorFeature::popcnt), __builtin_cpu_supports("popcnt") != 0);
  EXPECT_EQ(processor_has(ProcessorFeature::fma), __builtin_cpu_supports("fma") != 0);
  EXPECT_EQ(processor_has(ProcessorFeature::avx2), __builtin_cpu_supports("avx2") != 0);
  EXPECT_EQ(processor_has(ProcessorFeature::bmi), __builtin_cpu_supports("bmi") != 0);
  EXPECT_EQ(processor_has(ProcessorFeature::bmi2), __builtin_cpu_supports("bmi2") != 0);
  EXPECT_EQ(processor_has(ProcessorFeature::avx512f), __builtin_cpu_supports("avx512f") != 0);
  EXPECT_EQ(processor_has(ProcessorFeature::avx512cd), __builtin_cpu_supports("avx512cd") != 0);
  EXPECT_EQ(processor_has(ProcessorFeature::avx512dq), __builtin_cpu_supports("avx512dq") != 0);
  EXPECT_EQ(processor_has(ProcessorFeature::avx512bw), __builtin_cpu_supports("avx512bw") != 0);
  EXPECT_EQ(processor_has(ProcessorFeature::avx512vl), __builtin_cpu_supports("avx512vl") != 0);
  EXPECT_EQ(processor_has(ProcessorFeature::avx512vbmi2), __builtin_cpu_supports("avx512vbmi2") != 0);
#else
  EXPECT_FALSE(processor_has(ProcessorFeature::avx2));
#endif
}

}  // namespace
}  // namespace shaftcull::kernel
