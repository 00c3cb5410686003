// SPDX-License-Identifier: MIT
/// Finished blocks on disk: what comes back, and what counts as torn.
#include "batch/block_store.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <span>

#include "batch/block_answer.hpp"
#include "batch/npy.hpp"

namespace shaftcull::test {
namespace {

using batch::BlockAnswer;
using batch::BlockStore;
using batch::Fingerprint;

const BlockAnswer answer{{3, 5, 9}, {1, 2, 3}, {0.5F, 1, 2}, {{{{2, 0, 1}, {7, 8, 9}}, {{0, 1, 0}, {4}}}}};

TEST(BatchBlockStore, WhatWasWrittenComesBack) {
  const BatchFolder folder;
  const BlockStore store(folder.path("parts"), {1, 2}, 0);
  store.make_folders(2);
  store.write(1, 7, answer);
  store.write(0, 7, BlockAnswer{});
  EXPECT_EQ(store.read<BlockAnswer>(1, 7), answer);
  EXPECT_EQ(store.read<BlockAnswer>(0, 7), BlockAnswer{});
  EXPECT_EQ(store.sizes(1, 7), (BlockStore::Sizes{12, 24, 12, 24, 24, 24, 8}));
  EXPECT_EQ(store.read<BlockAnswer>(1, 8), std::nullopt);
  EXPECT_EQ(store.sizes(1, 8), std::nullopt);
}

TEST(BatchBlockStore, ArraysAreMapped) {
  const BatchFolder folder;
  const BlockStore store(folder.path("parts"), {1, 2}, 0);
  store.make_folders(2);
  store.write(1, 7, answer);
  store.write(0, 7, BlockAnswer{});
  for (const auto check : {BlockStore::Check::all, BlockStore::Check::header}) {
    const auto mapped = store.map(1, 7, check);
    ASSERT_TRUE(mapped);
    EXPECT_TRUE(std::ranges::equal(mapped->array(0), std::as_bytes(std::span(answer.rows))));
    EXPECT_TRUE(std::ranges::equal(mapped->array(1), std::as_bytes(std::span(answer.numbers))));
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(mapped->array(0).data()) % 64, 0U);
    const auto empty = store.map(0, 7, check);
    ASSERT_TRUE(empty);
    EXPECT_TRUE(empty->array(0).empty());
    EXPECT_FALSE(store.map(1, 8, check));
  }
}

TEST(BatchBlockStore, BlocksOfOtherJobsAndPlacesAreNotTaken) {
  const BatchFolder folder;
  const BlockStore store(folder.path("parts"), {1, 2}, 0);
  store.make_folders(2);
  store.write(0, 1, answer);
  EXPECT_EQ(BlockStore(folder.path("parts"), Fingerprint{1, 3}, 0).read<BlockAnswer>(0, 1), std::nullopt);
  std::filesystem::copy(store.path(0, 1), store.path(0, 2));
  std::filesystem::copy(store.path(0, 1), store.path(1, 1));
  EXPECT_EQ(store.read<BlockAnswer>(0, 2), std::nullopt);
  EXPECT_FALSE(store.map(0, 2, BlockStore::Check::header));
  EXPECT_EQ(store.read<BlockAnswer>(1, 1), std::nullopt);
}

TEST(BatchBlockStore, ATornBlockIsNotTaken) {
  const BatchFolder folder;
  const BlockStore store(folder.path("parts"), {1, 2}, 0);
  store.make_folders(1);
  store.write(0, 0, answer);
  const std::string whole = bytes_of_file(store.path(0, 0));
  for (std::size_t size = 0; size != whole.size(); ++size) {
    write_file(store.path(0, 0), whole.substr(0, size));
    ASSERT_EQ(store.read<BlockAnswer>(0, 0), std::nullopt) << size << " of " << whole.size() << " bytes";
    ASSERT_FALSE(store.map(0, 0, BlockStore::Check::header)) << size << " of " << whole.size() << " bytes";
  }
  write_file(store.path(0, 0), whole + '\0');
  EXPECT_EQ(store.read<BlockAnswer>(0, 0), std::nullopt);
  write_file(store.path(0, 0), whole);
  EXPECT_EQ(store.read<BlockAnswer>(0, 0), answer);
}

TEST(BatchBlockStore, AChangedByteIsNoticed) {
  const BatchFolder folder;
  const BlockStore store(folder.path("parts"), {1, 2}, 0);
  store.make_folders(1);
  store.write(0, 0, answer);
  const std::string whole = bytes_of_file(store.path(0, 0));
  for (std::size_t at = 0; at != whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    write_file(store.path(0, 0), changed);
    ASSERT_EQ(store.read<BlockAnswer>(0, 0), std::nullopt) << "byte " << at;
    ASSERT_FALSE(store.map(0, 0, BlockStore::Check::all)) << "byte " << at;
  }
}

TEST(BatchBlockStore, ABlockThatCannotBeWrittenIsNotThere) {
  const BatchFolder folder;
  const BlockStore store(folder.path("parts"), {1, 2}, 0);
  EXPECT_THROW(store.write(0, 0, answer), std::runtime_error) << "its folder was not made";
  EXPECT_EQ(store.read<BlockAnswer>(0, 0), std::nullopt);
}

}  // namespace
}  // namespace shaftcull::test
