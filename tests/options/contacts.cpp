// SPDX-License-Identifier: MIT
/// First contact and entry times, with every option alone and with several, in views, streams and trees: they follow
/// from the contacts of one bound at a time, and of two whose times are the same float.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "instruction_sets.hpp"
#include "options/query_case.hpp"
#include "options/scenes.hpp"
#include "options/truth.hpp"
#include "oracle/random.hpp"
#include "sanitizers.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {
namespace {

/// A view of one bound or of two.
template <class Bound>
class Few {
 public:
  explicit Few(const Bound& one) { write(0, one); }
  Few(const Bound& one, const Bound& other) : Few(one) {
    write(1, other);
    count_ = 2;
  }
  [[nodiscard]] Bounds bounds() const {
    ViewOf<Bound> view;
    for (std::size_t r = 0; r != view.stream.size(); ++r) view.stream[r] = rows_[r].data();
    view.count = count_;
    return view;
  }

 private:
  void write(std::size_t at, const Box& box) {
    for (std::size_t k = 0; k != 3; ++k) {
      rows_[k][at] = box.lo[k];
      rows_[k + 3][at] = box.hi[k];
    }
  }
  void write(std::size_t at, const Sphere& sphere) {
    for (std::size_t k = 0; k != 3; ++k) rows_[k][at] = sphere.centre[k];
    rows_[3][at] = sphere.radius;
  }

  std::array<std::array<float, 2>, 6> rows_{};
  std::size_t count_ = 1;
};

/// When each shaft reaches each bound.
template <class Bound>
class Times {
 public:
  Times(std::span<const CompiledShaft> shafts, const std::vector<Bound>& bounds, const Truth& truth)
      : shafts_(shafts), bounds_(bounds) {
    const UseIsa scalar(Isa::scalar);
    for (std::size_t s = 0; s != shafts.size(); ++s) {
      for (std::uint32_t i = 0; i != bounds.size(); ++i) {
        const Few<Bound> one(bounds[i]);
        const FirstContact contact = first_contact(shafts[s], one.bounds());
        EXPECT_EQ(static_cast<bool>(contact), truth(s, i) != Answer::outside) << "shaft " << s << ", bound " << i;
        float time = -1;
        constexpr std::uint32_t first = 0;
        entry_times(shafts[s], one.bounds(), {&first, 1}, {&time, 1});
        EXPECT_EQ(time, contact.time) << "shaft " << s << ", bound " << i;
        times_.push_back(time);
      }
    }
  }

  [[nodiscard]] float operator()(std::size_t shaft, std::uint32_t bound) const {
    return times_[shaft * bounds_.size() + bound];
  }

  /// The first contact among some of the bounds that the shaft keeps.
  [[nodiscard]] FirstContact first_of(std::size_t shaft, Indices some) const {
    std::sort(some.begin(), some.end());
    some.erase(std::unique(some.begin(), some.end()), some.end());
    FirstContact first;
    const UseIsa scalar(Isa::scalar);
    for (const std::uint32_t i : some) {
      const float time = (*this)(shaft, i);
      const bool is_first =
          !first || time < first.time || (time == first.time && is_reached_before(shaft, i, first.index));
      if (is_first) first = {i, time};
    }
    return first;
  }

 private:
  /// Whether a bound is reached before another of a lower index: the exact times are compared.
  [[nodiscard]] bool is_reached_before(std::size_t shaft, std::uint32_t bound, std::uint32_t lower) const {
    return first_contact(shafts_[shaft], Few<Bound>(bounds_[lower], bounds_[bound]).bounds()).index == 1;
  }

  std::span<const CompiledShaft> shafts_;
  const std::vector<Bound>& bounds_;
  std::vector<float> times_;
};

template <class Bound>
class ContactOptions : public testing::Test {
 protected:
  static void expect_all(std::uint64_t seed, std::size_t bounds, std::size_t shaft_count, std::size_t cases) {
    SCOPED_TRACE("seed " + std::to_string(seed) + ", " + std::to_string(bounds) + " bounds, " +
                 std::to_string(shaft_count) + " shafts");
    Random random(seed);
    const bool has_layers = random.one_in(2);
    const Scene<Bound> scene(random, bounds_of<Bound>(random, bounds), has_layers);
    const ShaftSet set(random, shaft_count, false);
    const std::span<const CompiledShaft> shafts = set.all();
    const Truth truth = truth_of(shafts, scene.bounds());
    const Times<Bound> times(shafts, scene.bounds(), truth);
    const unsigned allowed = Options::all & ~Options::limit & ~(has_layers ? 0U : Options::layer_mask);
    for (std::size_t i = 0; i != random_cases(cases); ++i) {
      const QueryCase options(random, truth, allowed);
      SCOPED_TRACE(options.text());
      std::vector<FirstContact> right;
      for (std::size_t s = 0; s != shafts.size(); ++s) {
        right.push_back(times.first_of(s, options.lists(truth, scene.layers(), s, scene.holders().front().order).kept));
        found_ += static_cast<std::size_t>(static_cast<bool>(right.back()));
      }
      for (const Holder& holder : scene.holders()) {
        SCOPED_TRACE(holder.name);
        std::vector<FirstContact> contacts(shafts.size(), FirstContact{7, -3});
        first_contact_many(shafts, holder.bounds, contacts, options.of_all());
        for (std::size_t s = 0; s != shafts.size(); ++s) {
          EXPECT_EQ(contacts[s].index, right[s].index) << "first_contact_many, shaft " << s;
          EXPECT_EQ(contacts[s].time, right[s].time) << "first_contact_many, shaft " << s;
        }
        const std::size_t s = random.below(static_cast<unsigned>(shafts.size()));
        const FirstContact one = first_contact(shafts[s], holder.bounds, options.of_one(s));
        EXPECT_EQ(one.index, right[s].index) << "first_contact, shaft " << s;
        EXPECT_EQ(one.time, right[s].time) << "first_contact, shaft " << s;
        expect_entry_times(random, shafts[s], s, holder.bounds, times);
        if (testing::Test::HasFailure()) return;
      }
    }
  }

  /// Indices in no order, some more than once.
  static void expect_entry_times(Random& random, const CompiledShaft& shaft, std::size_t s, const Bounds& bounds,
                                 const Times<Bound>& times) {
    const auto size = static_cast<unsigned>(bounds.size());
    Indices indices(size == 0 ? 0 : random.below(std::min(2 * size, 300U)));
    std::vector<float> right;
    for (std::uint32_t& index : indices) {
      index = random.below(std::max(size, 1U));
      right.push_back(times(s, index));
    }
    std::vector<float> written(indices.size(), -7);
    entry_times(shaft, bounds, indices, written);
    EXPECT_EQ(written, right) << "entry_times, shaft " << s;
  }

  static void expect_contacts() { EXPECT_GT(found_, 100U); }

 private:
  static inline std::size_t found_ = 0;
};
using Kinds = testing::Types<Box, Sphere>;
TYPED_TEST_SUITE(ContactOptions, Kinds);

TYPED_TEST(ContactOptions, PickTheFirstOfTheBoundsThatTheyLeave) {
  std::uint64_t seed = 6000;
  for (const std::size_t bounds : {0U, 1U, 63U, 64U, 65U}) {
    for (const std::size_t shafts : {1U, 2U, 7U, 63U, 64U, 65U, 130U}) {
      this->expect_all(seed++, bounds, shafts, 10);
      if (this->HasFailure()) return;
    }
  }
  for (const std::size_t bounds : {511U, 512U, 513U, 2047U, 2048U, 2049U}) {
    for (const std::size_t shafts : {1U, 7U}) {
      this->expect_all(seed++, bounds, shafts, 8);
      if (this->HasFailure()) return;
    }
  }
  this->expect_all(seed++, 2049, 65, 2);
  this->expect_all(seed++, 16383, 2, 4);
  this->expect_all(seed++, 16385, 7, 2);
  this->expect_all(seed++, 40000, 2, 3);
  this->expect_contacts();
}

TYPED_TEST(ContactOptions, ThatLeaveNothingLeaveNoContact) {
  Random random(6500);
  const Scene<TypeParam> scene(random, bounds_of<TypeParam>(random, 100), true);
  const std::vector<CompiledShaft> shafts(2, compile({{-9, -9, -9}, {9, 9, 0}}, {{-9, -9, 0}, {9, 9, 9}}));
  const std::vector<std::uint64_t> all(2, ~std::uint64_t{0});
  const Indices none;
  for (const Holder& holder : scene.holders()) {
    SCOPED_TRACE(holder.name);
    EXPECT_TRUE(first_contact(shafts[0], holder.bounds));
    for (const Query& query : {Query{.exclude_mask = all}, Query{.layer_mask = 0U}, Query{.only = none}}) {
      EXPECT_EQ(first_contact(shafts[0], holder.bounds, query), FirstContact());
      std::vector<FirstContact> contacts(shafts.size(), FirstContact{7, -3});
      first_contact_many(shafts, holder.bounds, contacts, query);
      EXPECT_EQ(contacts, std::vector<FirstContact>(shafts.size()));
    }
  }
}

}  // namespace
}  // namespace shaftcull
