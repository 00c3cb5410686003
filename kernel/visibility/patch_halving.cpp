// SPDX-License-Identifier: MIT
#include "visibility/patch_halving.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace shaftcull::kernel {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr std::size_t most_bins = 32;
constexpr std::size_t few_items = 256;  // for which half as many bins do as well, and of more so many say where to cut

/// What patches are sorted by: half the middle of the box, and the unit normal, its x halved. Keys 6 and 7 say nothing.
constexpr std::size_t keys_with_planes = 6;
struct Keys {
  FourFloats first;
  FourFloats second;

  explicit Keys(const PatchExtent& extent) noexcept
      : first(FourFloats::all(0.25F) * extent.largest - FourFloats::all(0.25F) * extent.least),
        second(extent.normal_yz) {}
};

/// Items that say where all are cut: one of each `step` side by side, and not always the same of them, since what faces
/// alike may come at every sixth place.
class Sample {
 public:
  explicit Sample(std::span<const PatchItem> items) noexcept : items_(items), step_(items.size() / few_items + 1) {}

  [[nodiscard]] bool is_all() const noexcept { return step_ == 1; }

  /// Calls visit(item) for each of them.
  template <class Visit>
  void for_each(const Visit& visit) const noexcept {
    std::uint32_t hash = 0x80000000U;  // in the middle
    for (std::size_t first = 0; first + step_ <= items_.size(); first += step_) {
      visit(items_[first + static_cast<std::size_t>(std::uint64_t{hash} * step_ >> 32U)]);
      hash += 0x9e3779b9U;  // 2^32 over the golden ratio: spreads evenly
    }
  }

 private:
  std::span<const PatchItem> items_;
  std::size_t step_;
};

/// Which bin of equally long parts each key is in.
class Binning {
 public:
  /// For keys such as those of a sample. Others go to the first or the last bin.
  Binning(const Sample& sample, std::size_t bins) noexcept : last_(FourFloats::all(static_cast<float>(bins - 1))) {
    FourFloats first_hi = FourFloats::all(-infinity);
    FourFloats second_hi = first_hi;
    first_lo_ = second_lo_ = FourFloats::all(infinity);
    sample.for_each([&](const PatchItem& item) {
      const Keys keys(item.extent);
      first_lo_ = minimum(keys.first, first_lo_);
      first_hi = maximum(keys.first, first_hi);
      second_lo_ = minimum(keys.second, second_lo_);
      second_hi = maximum(keys.second, second_hi);
    });
    first_per_length_ = per_length(first_hi - first_lo_, bins);
    second_per_length_ = per_length(second_hi - second_lo_, bins);
  }

  /// Of keys 0 to 3.
  void first_of(const Keys& keys, std::int32_t (&bin)[4]) const noexcept {
    bins_of(keys.first, first_lo_, first_per_length_, bin);
  }
  /// Of keys 4 to 7.
  void second_of(const Keys& keys, std::int32_t (&bin)[4]) const noexcept {
    bins_of(keys.second, second_lo_, second_per_length_, bin);
  }

 private:
  static FourFloats per_length(FourFloats length, std::size_t bins) noexcept {
    float of[4];
    length.store(of);
    for (float& l : of) l = l > 0 ? static_cast<float>(bins) / l : 0;  // no length: one bin
    return FourFloats::load(of);
  }
  /// Where the length is denormal, there may be 0 · ∞: bin 0.
  void bins_of(FourFloats key, FourFloats lo, FourFloats per_length, std::int32_t (&bin)[4]) const noexcept {
    minimum(maximum((key - lo) * per_length, FourFloats()), last_).store_integers(bin);
  }

  FourFloats first_lo_;
  FourFloats second_lo_;
  FourFloats first_per_length_;
  FourFloats second_per_length_;
  FourFloats last_;
};

/// Where a set of items is cut in two: behind the bins up to `last_before`, by a key.
struct Cut {
  float cost = infinity;
  std::size_t key = keys_with_planes;
  std::int32_t last_before = 0;
};

/// What is in each bin of a key.
class Bins {
 public:
  Bins() noexcept { extent_.fill(PatchExtent::none()); }

  void add(std::int32_t bin, const PatchExtent& extent) noexcept {
    const auto b = static_cast<std::size_t>(bin);
    extent_[b].join(extent);
    ++count_[b];
  }

  /// The best cut between two of the first `bins`, a multiple of 4, if it is better than what is known.
  void improve(Cut& best, std::size_t key, std::size_t bins, const PatchCosts& costs) const noexcept {
    std::array<Side, most_bins / 4> before;
    std::array<Side, most_bins / 4> after;
    PatchExtent joined = PatchExtent::none();
    float count = 0;
    for (std::size_t b = 0; b != bins; ++b) {
      joined.join(extent_[b]);
      count += static_cast<float>(count_[b]);
      before[b / 4].extent[b % 4] = joined;
      before[b / 4].count[b % 4] = count;
    }
    joined = PatchExtent::none();
    count = 0;
    for (std::size_t b = bins; b-- > 0;) {
      after[b / 4].extent[b % 4] = joined;
      after[b / 4].count[b % 4] = count;
      joined.join(extent_[b]);
      count += static_cast<float>(count_[b]);
    }
    for (std::size_t b = 0; b != bins; b += 4) {
      float total[4];  // where either side is empty, no number, which is not less
      (before[b / 4].cost(costs) + after[b / 4].cost(costs)).store(total);
      for (std::size_t i = 0; i != 4; ++i) {
        if (total[i] < best.cost) best = {total[i], key, static_cast<std::int32_t>(b + i)};
      }
    }
  }

 private:
  /// What is on one side of four cuts.
  struct Side {
    PatchExtent extent[4];
    float count[4];

    [[nodiscard]] FourFloats cost(const PatchCosts& costs) const noexcept {
      return costs.of(extent) * FourFloats::load(count);
    }
  };

  std::array<PatchExtent, most_bins> extent_;
  std::array<std::uint32_t, most_bins> count_{};
};

}  // namespace

PatchExtent PatchExtent::none() noexcept {
  const FourFloats none = FourFloats::all(-infinity);
  return {none, none, none};
}

PatchExtent extent_of(const Box& box, const double (&normal)[3]) noexcept {
  const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  const double per_length = length > 0 ? 1 / length : 0;
  float n[3];
  for (std::size_t k = 0; k != 3; ++k) n[k] = static_cast<float>(normal[k] * per_length);
  return {FourFloats::of(-box.lo[0], -box.lo[1], -box.lo[2], -n[0]),
          FourFloats::of(box.hi[0], box.hi[1], box.hi[2], n[0]), FourFloats::of(n[1], n[2], -n[1], -n[2])};
}

PatchExtent extent_of(std::span<const PatchItem> items) noexcept {
  PatchExtent extent = PatchExtent::none();
  for (const PatchItem& item : items) extent.join(item.extent);
  return extent;
}

PatchCosts::PatchCosts(const PatchExtent& around) noexcept {
  // Lengths of at most 1, so that nothing overflows.
  float half_length[4];
  (FourFloats::all(0.5F) * around.least + FourFloats::all(0.5F) * around.largest).store(half_length);
  const float longest = std::max({half_length[0], half_length[1], half_length[2]});
  const float half = std::min(0.5F / longest, std::numeric_limits<float>::max());
  half_scale_ = FourFloats::of(half, half, half, 1);
}

FourFloats PatchCosts::of(const PatchExtent (&extent)[4]) const noexcept {
  // A line or a point is not free. Normals spread over half a sphere, 4 in this measure, make a group five times as
  // dear: figures by measurement (docs/measurements.md).
  const FourFloats of_length = FourFloats::all(0.01F);
  const FourFloats of_flatness = FourFloats::all(1.0F);
  FourFloats length[4];
  FourFloats normal[4];
  for (std::size_t i = 0; i != 4; ++i) {
    length[i] = half_scale_ * extent[i].least + half_scale_ * extent[i].largest;
    normal[i] = extent[i].normal_yz;
  }
  transpose(length);
  transpose(normal);
  const auto& [x, y, z, normal_x] = length;
  const FourFloats spread = normal_x + (normal[0] + normal[2]) + (normal[1] + normal[3]);
  const FourFloats sum = x + y + z;
  return (x * y + y * z + z * x + of_length * sum * sum) * (of_flatness + spread);
}

PatchHalving::PatchHalving(std::size_t most_items, bool has_planes)
    : keys_(has_planes ? keys_with_planes : 3), second_half_(most_items) {}

std::size_t PatchHalving::halve(std::span<PatchItem> items, const PatchCosts& costs) {
  const Sample sample(items);
  const std::size_t bins = sample.is_all() ? most_bins / 2 : most_bins;
  const Binning binning(sample, bins);
  std::array<Bins, keys_with_planes> of_key;
  sample.for_each([&](const PatchItem& item) {
    const Keys keys(item.extent);
    std::int32_t bin[2][4];
    binning.first_of(keys, bin[0]);
    binning.second_of(keys, bin[1]);
    for (std::size_t k = 0; k != keys_; ++k) of_key[k].add(bin[k / 4][k % 4], item.extent);
  });
  Cut best;
  for (std::size_t k = 0; k != keys_; ++k) of_key[k].improve(best, k, bins, costs);
  if (best.key == keys_with_planes) return items.size() / 2;  // all alike

  std::size_t first = 0;
  std::size_t second = 0;
  const auto part = [&](const auto& bins_of) {
    for (const PatchItem item : items) {  // without branches, which would be mispredicted
      std::int32_t bin[4];
      bins_of(Keys(item.extent), bin);
      const std::size_t is_first = bin[best.key % 4] <= best.last_before ? 1 : 0;
      items[first] = item;
      second_half_[second] = item;
      first += is_first;
      second += 1 - is_first;
    }
  };
  if (best.key < 4) {
    part([&](const Keys& keys, std::int32_t(&bin)[4]) { binning.first_of(keys, bin); });
  } else {
    part([&](const Keys& keys, std::int32_t(&bin)[4]) { binning.second_of(keys, bin); });
  }
  std::copy_n(second_half_.begin(), second, items.begin() + static_cast<std::ptrdiff_t>(first));
  return first;
}

}  // namespace shaftcull::kernel
