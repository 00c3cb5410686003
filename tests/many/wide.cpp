// SPDX-License-Identifier: MIT
/// More bounds than 32 bits number, in little memory: the same pages of a file are mapped over and over.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "message_of.hpp"
#include "sanitizers.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {
namespace {

class Wide : public testing::Test {
 protected:
  static constexpr std::size_t count = (std::size_t{1} << 32U) + 201;
  static constexpr std::size_t piece = std::size_t{16} << 20U;
  static constexpr std::size_t bytes = (count * sizeof(float) + piece - 1) / piece * piece;

  void SetUp() override {
    if (has_shadow_memory) GTEST_SKIP() << "a sanitizer's shadow of all this does not share pages";
    void* const memory = mmap(nullptr, bytes, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (memory == MAP_FAILED) GTEST_SKIP() << "no room for " << bytes << " bytes of addresses";
    number_ = static_cast<float*>(memory);
    // Of a file, one page fault maps its neighbours, too. What is written to becomes a page of its own.
    const int zeros = memfd_create("zeros", 0);
    ASSERT_EQ(ftruncate(zeros, piece), 0);
    for (std::size_t at = 0; at != bytes; at += piece) {
      ASSERT_NE(mmap(static_cast<char*>(memory) + at, piece, PROT_READ | PROT_WRITE,
                     MAP_PRIVATE | MAP_FIXED | MAP_NORESERVE, zeros, 0),
                MAP_FAILED);
    }
    close(zeros);
    boxes_.count = count;
    for (const float*& stream : boxes_.stream) stream = number_;
    for (const std::uint64_t i : far_) number_[i] = 5;
  }
  void TearDown() override {
    if (number_ != nullptr) munmap(number_, bytes);
  }

  // Box i is the point whose three coordinates are number i: (5, 5, 5) for these and the origin for all others.
  const std::vector<std::uint64_t> far_ = {3, 0xfffffffe, 0xffffffff, 0x100000000, count - 1};
  float* number_ = nullptr;
  BoxView boxes_;
  const CompiledShaft shaft_ = compile({{4, 4, 4}, {6, 6, 6}}, {{7, 7, 7}, {8, 9, 10}});
};

TEST_F(Wide, BitsAndCountsAreOfAllBounds) {
  if (is_run_often()) GTEST_SKIP() << "scans take half a minute: --layer all";
  std::vector<std::uint64_t> kept(bit_words(count));
  cull(shaft_, boxes_, kept);
  std::vector<std::uint64_t> set;
  for (std::size_t w = 0; w != kept.size(); ++w) {
    for (std::uint64_t left = kept[w]; left != 0; left &= left - 1) {
      set.push_back(64 * w + static_cast<unsigned>(std::countr_zero(left)));
    }
  }
  EXPECT_EQ(set, far_);
  EXPECT_EQ(shaftcull::count(shaft_, boxes_), far_.size());
  std::uint64_t kept_count = 0;
  count_many({&shaft_, 1}, boxes_, {&kept_count, 1});
  EXPECT_EQ(kept_count, far_.size());
}

TEST_F(Wide, ListsReachAsFarAsIndicesOfThirtyTwoBitsCan) {
  if (is_run_often()) GTEST_SKIP() << "scans take half a minute: --layer all";
  const BoxView most = boxes_.slice(0, (std::size_t{1} << 32U) - 1);
  const std::vector<std::uint32_t> right = {3, 0xfffffffe};
  IndexLists lists;
  list_many({&shaft_, 1}, most, lists);
  EXPECT_EQ(lists.indices, right);
  std::vector<std::uint32_t> kept(5);
  kept.resize(list(shaft_, most, std::span(kept)));
  EXPECT_EQ(kept, right);
}

TEST_F(Wide, ListsOfMoreBoundsAreRefused) {
  IndexLists lists;
  std::vector<std::uint32_t> kept(5);
  FirstContact contact;
  const auto refuses = testing::AllOf(testing::HasSubstr("got 4294967497 bounds"), testing::HasSubstr("ask slices"));
  EXPECT_THAT(message_of<InvalidArgument>([&] { list_many({&shaft_, 1}, boxes_, lists); }), refuses);
  EXPECT_THAT(message_of<InvalidArgument>([&] { (void)list(shaft_, boxes_, kept); }), refuses);
  EXPECT_THAT(message_of<InvalidArgument>([&] { (void)list(shaft_, boxes_, std::span(kept), {.limit = 5}); }), refuses);
  EXPECT_THAT(message_of<InvalidArgument>([&] { (void)list_occluders(shaft_, boxes_, kept); }), refuses);
  EXPECT_THAT(message_of<InvalidArgument>([&] { (void)first_contact(shaft_, boxes_); }), refuses);
  EXPECT_THAT(message_of<InvalidArgument>([&] { first_contact_many({&shaft_, 1}, boxes_, {&contact, 1}); }), refuses);
  EXPECT_THAT(message_of<InvalidArgument>([&] { (void)BoxTree(boxes_); }), testing::HasSubstr("build several"));
}

TEST_F(Wide, CandidatesReachAllIndices) {
  const std::vector<std::uint32_t> candidates = {0xfffffffd, 0xfffffffe, 3, 0xffffffff, 7};
  EXPECT_EQ(shaftcull::count(shaft_, boxes_, {.only = candidates}), 3U);
  std::uint64_t kept_count = 0;
  count_many({&shaft_, 1}, boxes_, {&kept_count, 1}, {.only = candidates});
  EXPECT_EQ(kept_count, 3U);
  const BoxView most = boxes_.slice(0, (std::size_t{1} << 32U) - 1);
  const std::vector<std::uint32_t> in_most = {0xfffffffd, 0xfffffffe, 3, 7};
  const std::vector<std::uint32_t> right = {0xfffffffe, 3};
  std::vector<std::uint32_t> kept(in_most.size());
  kept.resize(list(shaft_, most, std::span(kept), {.only = in_most}));
  EXPECT_EQ(kept, right);
  IndexLists lists;
  list_many({&shaft_, 1}, most, lists, {.only = in_most});
  EXPECT_EQ(lists.indices, right);
}

}  // namespace
}  // namespace shaftcull
