// SPDX-License-Identifier: MIT
/// Halving entries: the kernel that makes tree order.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "dispatch/active_kernels.hpp"
#include "float_modes.hpp"
#include "instruction_sets.hpp"
#include "kernels/kernel_table.hpp"
#include "oracle/random.hpp"
#include "shaftcull/tree.hpp"
#include "support/float_environment.hpp"
#include "tree/entries.hpp"
#include "tree/scenes.hpp"
#include "tree/split.hpp"

namespace shaftcull {
namespace {

struct Entry {
  std::array<float, 3> centre;
  std::uint32_t index;
  bool operator==(const Entry&) const = default;
};
using Entries = std::vector<Entry>;

/// What is written around the streams that a split may touch.
constexpr float untouched = 123.5F;
constexpr std::size_t margin = 32;

class Streams {
 public:
  explicit Streams(std::size_t size) : size_(size) {
    for (std::vector<float>& stream : stream_) stream.assign(size + 2 * margin, untouched);
  }
  explicit Streams(const Entries& entries) : Streams(entries.size()) {
    for (std::size_t i = 0; i != size_; ++i) {
      for (std::size_t k = 0; k != 3; ++k) stream_[k][margin + i] = entries[i].centre[k];
      stream_[3][margin + i] = std::bit_cast<float>(entries[i].index);
    }
  }
  [[nodiscard]] kernel::EntryStreams pointers() {
    kernel::EntryStreams pointers;
    for (std::size_t s = 0; s != pointers.size(); ++s) pointers[s] = stream_[s].data() + margin;
    return pointers;
  }
  [[nodiscard]] Entry operator[](std::size_t i) const {
    const std::size_t at = margin + i;
    return {{stream_[0][at], stream_[1][at], stream_[2][at]}, std::bit_cast<std::uint32_t>(stream_[3][at])};
  }
  [[nodiscard]] bool is_untouched_before(std::size_t first) const {
    return std::all_of(stream_.begin(), stream_.end(), [&](const std::vector<float>& stream) {
      return std::all_of(stream.begin(), stream.begin() + static_cast<std::ptrdiff_t>(margin + first),
                         [](float x) { return x == untouched; });
    });
  }
  [[nodiscard]] bool margins_are_untouched() const {
    return std::all_of(stream_.begin(), stream_.end(), [&](const std::vector<float>& stream) {
      const auto is_untouched = [](float x) { return x == untouched; };
      return std::all_of(stream.begin(), stream.begin() + margin, is_untouched) &&
             std::all_of(stream.end() - margin, stream.end(), is_untouched);
    });
  }

 private:
  std::array<std::vector<float>, kernel::entry_streams> stream_;
  std::size_t size_;
};

Entries split(const Entries& entries, std::size_t first_half) {
  Streams from(entries);
  Streams to(entries.size());
  kernel::active_kernels().split.halve(from.pointers().data(), to.pointers().data(), entries.size(), first_half);
  EXPECT_TRUE(from.margins_are_untouched());
  EXPECT_TRUE(to.margins_are_untouched());
  Entries halves;
  for (std::size_t i = 0; i != entries.size(); ++i) {
    const Streams& half = i < first_half ? from : to;
    halves.push_back(half[i]);
  }
  return halves;
}

/// What comes before a part that all threads halve.
constexpr std::size_t part_first = 37;

Entries split_together(const Entries& entries, std::size_t first_half) {
  Entries all(part_first, Entry{{1, 2, 3}, 4});
  all.insert(all.end(), entries.begin(), entries.end());
  Streams streams(all);
  Streams spare(all.size());
  const kernel::EntryStreams of_entries = streams.pointers();
  const kernel::EntryStreams of_scratch = spare.pointers();
  const std::size_t cut = part_first + first_half;
  const kernel::Halves halves =
      kernel::split_in_parallel({part_first, all.size(), &of_entries, &of_scratch}, cut, kernel::active_kernels());
  EXPECT_EQ(halves.low.first, part_first);
  EXPECT_EQ(halves.low.last, cut);
  EXPECT_EQ(halves.high.first, cut);
  EXPECT_EQ(halves.high.last, all.size());
  EXPECT_NE(halves.low.entries, halves.low.scratch);
  EXPECT_NE(halves.high.entries, halves.high.scratch);
  EXPECT_TRUE(streams.margins_are_untouched());
  EXPECT_TRUE(spare.margins_are_untouched());
  for (std::size_t i = 0; i != part_first; ++i) EXPECT_EQ(streams[i], all[i]);
  EXPECT_TRUE(spare.is_untouched_before(part_first));
  Entries made;
  for (std::size_t i = part_first; i != all.size(); ++i) {
    const Streams& half = (i < cut ? halves.low : halves.high).entries == &of_entries ? streams : spare;
    made.push_back(half[i]);
  }
  return made;
}

/// The same by sorting; `axis` is where entries are spread out most.
Entries sorted_halves(const Entries& entries, std::size_t first_half, std::size_t axis) {
  Entries sorted = entries;
  const auto is_less = [axis](const Entry& a, const Entry& b) { return a.centre[axis] < b.centre[axis]; };
  std::stable_sort(sorted.begin(), sorted.end(), is_less);
  // Within a half entries have the order they came in; ties fill up the first half, and go before larger ones in the
  // other.
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(first_half);
  const auto by_index = [](const Entry& a, const Entry& b) { return a.index < b.index; };
  const float pivot = middle->centre[axis];
  const auto group = [&](auto first, auto last) { std::sort(first, last, by_index); };
  const auto first_equal =
      std::find_if(sorted.begin(), middle, [&](const Entry& e) { return e.centre[axis] == pivot; });
  const auto first_larger = std::find_if(middle, sorted.end(), [&](const Entry& e) { return e.centre[axis] > pivot; });
  group(sorted.begin(), first_equal);
  if (first_equal == middle) {
    group(middle, sorted.end());
  } else {
    group(first_larger, sorted.end());
  }
  return sorted;
}

void expect_split(const Entries& entries, std::size_t first_half, std::size_t axis, const std::string& what) {
  const Entries expected = sorted_halves(entries, first_half, axis);
  for (const Isa isa : isas_under_test()) {
    const UseIsa use(isa);
    const auto expect_halves = [&](const char* mode) {
      const std::string which = what + ", " + std::to_string(entries.size()) + " entries, " +
                                std::to_string(first_half) + " first, " + std::string(name(isa)) + mode;
      ASSERT_EQ(split(entries, first_half) == expected, true) << which;
      if (entries.size() < kernel::fewest_for_parallel_split) return;
      ASSERT_EQ(split_together(entries, first_half) == expected, true) << which << ", together";
    };
    expect_halves("");
#ifdef SHAFTCULL_HAS_FLOAT_MODES
    if (entries.size() >= kernel::fewest_for_parallel_split) continue;  // takes long, and says no more
    const InMode in(modes[0]);
    const kernel::FloatEnvironment environment;  // as every call that gets here
    expect_halves(", denormals are zero");
#endif
  }
}

/// Ways to throw keys.
using Keys = float (*)(Random&);
const std::map<std::string, Keys> distributions = {
    {"uniform", [](Random& random) { return random.uniform(-1, 1); }},
    {"equal", [](Random&) { return 0.25F; }},
    {"few values", [](Random& random) { return random.integer(-1, 1); }},
    {"signed zeros",
     [](Random& random) { return random.below(2) == 0   ? -0.0F
                                 : random.below(4) == 0 ? 1e-45F
                                                        : 0.0F; }},
    {"denormals", [](Random& random) { return random.integer(-50, 50) * 1e-45F; }},
    {"largest",
     [](Random& random) { return random.below(2) == 0 ? std::numeric_limits<float>::max() : random.integer(0, 3); }},
    {"all magnitudes", [](Random& random) { return random.wild(); }},
    {"two values", [](Random& random) { return random.below(2) == 0 ? -std::numeric_limits<float>::max() : 1e-45F; }},
    {"outlier", [](Random& random) { return random.below(500) == 0 ? 1e30F : random.uniform(0, 1e-3F); }}};

Entries entries_of(Random& random, Keys key, std::size_t axis, std::size_t count) {
  Entries entries(count);
  for (std::size_t i = 0; i != count; ++i) {
    entries[i].centre = {0.5F, 0.5F, 0.5F};  // the other axes are not spread out at all
    entries[i].centre[axis] = key(random);
    entries[i].index = static_cast<std::uint32_t>(i);
  }
  return entries;
}

TEST(SplitEntries, HalvesAreThoseOfSorting) {
  Random random(5100);
  for (const auto& [what, key] : distributions) {
    for (std::size_t count = 2; count < 200; count += 1 + count / 20) {
      const std::size_t axis = random.below(3);
      expect_split(entries_of(random, key, axis, count), 1 + random.below(static_cast<unsigned>(count) - 1), axis,
                   what);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(SplitEntries, LargePartsAreSampled) {
  Random random(5200);
  for (const auto& [what, key] : distributions) {
    for (const std::size_t count : {1024U, 1025U, 4096U, 4097U, 9001U}) {
      // Where no key of the sample differs, the axis is the first.
      expect_split(entries_of(random, key, 0, count), 1 + random.below(static_cast<unsigned>(count) - 1), 0, what);
      expect_split(entries_of(random, key, 0, count), count / 2, 0, what);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(SplitEntries, LargestPartsAreHalvedByAllThreads) {
  Random random(5250);
  for (const auto& [what, key] : distributions) {
    expect_split(entries_of(random, key, 0, 70001), 1 + random.below(70000), 0, what);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(SplitEntries, ACutBetweenTwoOfFewValuesIsThatOfSorting) {
  for (const std::size_t count : {640U, 9600U, 70400U}) {
    const std::size_t step = count / 32;  // so many have the same key, and every float between two keys is one too
    Entries entries(count);
    for (std::size_t i = 0; i != count; ++i) {
      const auto value = static_cast<std::uint32_t>(i * 7919 % count / step);
      entries[i] = {{std::bit_cast<float>(0x3f800000 + value), 0, 0}, static_cast<std::uint32_t>(i)};
    }
    for (const std::size_t cut : {1U, 16U}) {
      expect_split(entries, cut * step - 1, 0, "a tie comes second");
      expect_split(entries, cut * step, 0, "no ties");
      expect_split(entries, cut * step + 1, 0, "a tie comes first");
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(SplitEntries, ASampleThatIsNotLikeTheRestDoesNoHarm) {
  for (const float off : {1e8F, -1e8F}) {
    for (const std::size_t count : {4000U, 20000U, 70000U}) {
      const std::size_t step = count <= 4096 ? 16 : 64;
      Entries entries(count);
      for (std::size_t i = 0; i != count; ++i) {
        const auto x = static_cast<float>(i);
        entries[i] = {{i % step == 0 ? off + x : x, 0, 0}, static_cast<std::uint32_t>(i)};
      }
      expect_split(entries, count / 2, 0, "misleading sample");
    }
  }
}

TEST(SplitEntries, TheAxisThatIsSpreadOutMostIsHalved) {
  Random random(5300);
  for (std::size_t axis = 0; axis != 3; ++axis) {
    Entries entries(300);
    for (std::size_t i = 0; i != entries.size(); ++i) {
      entries[i] = {random.vec3(-1, 1), static_cast<std::uint32_t>(i)};
      entries[i].centre[axis] *= 10;
    }
    expect_split(entries, 128, axis, "axis");
    entries[0].centre[axis] = std::numeric_limits<float>::max();  // wider than a float holds
    entries[1].centre[axis] = -std::numeric_limits<float>::max();
    expect_split(entries, 128, axis, "infinitely wide");
    if (axis == 0) continue;
    entries[2].centre[axis - 1] = std::numeric_limits<float>::max();
    entries[3].centre[axis - 1] = -std::numeric_limits<float>::max();
    expect_split(entries, 128, axis - 1, "two axes infinitely wide");
  }
}

TEST(TreeOrder, IndicesComeBackFromEntries) {
  float bits = 0;
  const kernel::EntryStreams entries = {nullptr, nullptr, nullptr, &bits};
  for (const std::uint32_t index : {0x0U, 0x1U, 0x7fa00001U, 0xffffffffU}) {  // as floats, a NaN that signals
    bits = kernel::index_bits(index);
    EXPECT_EQ(kernel::index_of(entries, 0), index);
  }
}

TEST(TreeOrder, IsTheSameOnEveryInstructionSet) {
  for (const Shape shape : shapes) {
    Random random(5400);
    const std::vector<Box> boxes = scene<Box>(random, shape, 9000);  // its halves are sampled at first
    std::vector<std::uint32_t> first;
    for (const Isa isa : available_isas()) {
      const UseIsa use(isa);
      const BoxTree tree{std::span<const Box>(boxes)};
      const std::vector<std::uint32_t> order(tree.order().begin(), tree.order().end());
      if (first.empty()) first = order;
      EXPECT_EQ(order == first, true) << text(shape) << ", " << name(isa);
    }
  }
}

}  // namespace
}  // namespace shaftcull
