// SPDX-License-Identifier: MIT
/// Bounds on disk, share by share: each has its own, and damage is noticed where it is read.
#include "batch/dealt_bounds.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "batch/bounds_source.hpp"
#include "batch/npy.hpp"
#include "batch/planned_shares.hpp"
#include "batch/ranks.hpp"
#include "batch/share_plan.hpp"

namespace shaftcull::test {
namespace {

using batch::BoundsSource;
using batch::DealtBounds;
using batch::PlannedShares;
using batch::ShareBounds;
using batch::ShareKey;
using batch::SharePlan;

constexpr std::size_t boxes = 50;

/// Boxes along x in an order of their own, cut into three shares, in stretches of 23.
class BatchDealtBounds : public testing::Test {
 protected:
  BatchDealtBounds() {
    std::vector<ShareKey> keys;
    for (std::size_t i = 0; i != boxes; ++i) {
      const auto x = static_cast<float>(i * 17 % boxes);
      floats_.insert(floats_.end(), {x, 0, 0, x + 1, 1, 1});
      keys.push_back({{x + 0.5F, 0.5F, 0.5F}, i});
    }
    write_floats(folder_.path("bounds.npy"), 6, floats_);
    bounds_.emplace(folder_.path("bounds.npy"));
    plan_ = {SharePlan(keys, 3), std::vector<std::uint64_t>(3), 23};
    for (const ShareKey& key : keys) {
      of_share_[plan_.cuts.share_of(key)].push_back(key.position);
      ++plan_.sizes[plan_.cuts.share_of(key)];
    }
    dealt_.emplace(*bounds_, plan_, folder_.path("parts"), batch::Fingerprint{1, 2}, 0);
  }

  /// Whether these are the bounds of a share, as the plan has it.
  [[nodiscard]] bool are_those_of(std::size_t share, const ShareBounds& found) const {
    std::vector<float> floats;
    for (const std::uint64_t i : of_share_[share]) {
      floats.insert(floats.end(), floats_.begin() + static_cast<std::ptrdiff_t>(6 * i),
                    floats_.begin() + static_cast<std::ptrdiff_t>(6 * (i + 1)));
    }
    return found.positions == of_share_[share] && found.floats == floats;
  }

  BatchFolder folder_;
  std::vector<float> floats_;
  std::vector<std::uint64_t> of_share_[3];
  std::optional<BoundsSource> bounds_;
  PlannedShares plan_;
  std::optional<DealtBounds> dealt_;
};

TEST_F(BatchDealtBounds, EachShareHasItsOwnInTheOrderOfTheFile) {
  const auto ranks = batch::one_rank();
  EXPECT_EQ(dealt_->missing(*ranks), (std::vector<std::uint64_t>{0, 1, 2}));
  for (const std::uint64_t stretch : {2U, 0U, 1U}) dealt_->store(stretch);
  EXPECT_TRUE(dealt_->missing(*ranks).empty());
  for (std::size_t share = 0; share != 3; ++share) EXPECT_TRUE(are_those_of(share, dealt_->of(share))) << share;
  const Box box = dealt_->of(0).box;
  EXPECT_EQ(box.lo[0], 0);
  EXPECT_EQ(box.hi[0], static_cast<float>(of_share_[0].size()));
  dealt_->remove();
  EXPECT_EQ(dealt_->missing(*ranks).size(), 3U);
}

TEST_F(BatchDealtBounds, AChangedByteIsNoticedByWhoReadsIt) {
  const auto ranks = batch::one_rank();
  for (const std::uint64_t stretch : dealt_->missing(*ranks)) dealt_->store(stretch);
  const std::string path = folder_.path("parts") + "/bounds/share-0000/block-000000001";
  const std::string whole = bytes_of_file(path);
  ASSERT_GT(whole.size(), 23U * 28U);
  for (std::size_t at = 0; at != whole.size(); ++at) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    int noticed = 0;
    for (std::size_t share = 0; share != 3; ++share) {
      write_file(path, changed);
      try {
        EXPECT_TRUE(are_those_of(share, dealt_->of(share))) << "byte " << at << ", share " << share;
      } catch (const std::runtime_error&) {
        ++noticed;
        EXPECT_EQ(dealt_->missing(*ranks), (std::vector<std::uint64_t>{1})) << "it is to be dealt again";
      }
    }
    EXPECT_GE(noticed, 1) << "byte " << at;
  }
}

TEST_F(BatchDealtBounds, AStretchThatIsMissingIsNoticed) {
  const auto ranks = batch::one_rank();
  for (const std::uint64_t stretch : dealt_->missing(*ranks)) {
    if (stretch != 2) dealt_->store(stretch);
  }
  EXPECT_THROW(static_cast<void>(dealt_->of(0)), std::runtime_error);
}

}  // namespace
}  // namespace shaftcull::test
