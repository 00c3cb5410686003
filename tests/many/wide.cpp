// SPDX-License-Identifier: MIT
/// More bounds than 32 bits number, in little memory: pages that nobody has written to are all the same one.
#include <gtest/gtest.h>
#include <sys/mman.h>

#include <cstddef>
#include <cstdint>
#include <vector>

#include "sanitizers.hpp"
#include "shaftcull/many.hpp"
#include "shaftcull/refine.hpp"

namespace shaftcull {
namespace {

class Wide : public testing::Test {
 protected:
  static constexpr std::size_t count = (std::size_t{1} << 32U) + 201;
  static constexpr std::size_t bytes = count * sizeof(float);

  void SetUp() override {
    if (has_shadow_memory) GTEST_SKIP() << "a sanitizer's shadow of all this does not share pages";
    void* const memory =
        mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) GTEST_SKIP() << "no room for " << bytes << " bytes of addresses";
    madvise(memory, bytes, MADV_HUGEPAGE);  // fewer page faults, where it is heard
    number_ = static_cast<float*>(memory);
    boxes_.count = count;
    for (const float*& stream : boxes_.stream) stream = number_;
    for (const std::uint64_t i : far_) number_[i] = 5;
  }
  void TearDown() override {
    if (number_ != nullptr) munmap(number_, bytes);
  }

  // Box i is the point whose three coordinates are number i: (5, 5, 5) for these and the origin for all others.
  const std::vector<std::uint64_t> far_ = {3, 0xffffffff, 0x100000000, count - 1};
  float* number_ = nullptr;
  BoxView boxes_;
  const CompiledShaft shaft_ = compile(Shaft({{4, 4, 4}, {6, 6, 6}}, {{7, 7, 7}, {8, 9, 10}}));
};

TEST_F(Wide, ListsOfSixtyFourBitsNumberAllBounds) {
  IndexListsOf<std::uint64_t> lists;
  list_many({&shaft_, 1}, boxes_, lists);
  EXPECT_EQ(lists.indices, far_);
}

TEST_F(Wide, ListsOfThirtyTwoBitsReachAsFarAsTheyCan) {
  IndexLists lists;
  list_many({&shaft_, 1}, boxes_.slice(0, std::size_t{1} << 32U), lists);
  EXPECT_EQ(lists.indices, (std::vector<std::uint32_t>{3, 0xffffffff}));
}

TEST_F(Wide, RefiningReachesAllBounds) {
  const std::vector<std::uint64_t> candidates = {count - 2, count - 1, 0x100000001, 0x100000000, 3, 0xffffffff, 7};
  const std::vector<std::uint64_t> right = {count - 1, 0x100000000, 3, 0xffffffff};
  std::vector<std::uint64_t> kept(candidates.size());
  kept.resize(refine(shaft_, boxes_, candidates, kept));
  EXPECT_EQ(kept, right);
  IndexListsOf<std::uint64_t> lists;
  refine_many({&shaft_, 1}, boxes_, candidates, lists);
  EXPECT_EQ(lists.indices, right);
}

}  // namespace
}  // namespace shaftcull
