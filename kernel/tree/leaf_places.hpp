// SPDX-License-Identifier: MIT
/// The leaves of the user's indices.
#pragma once

#include <atomic>
#include <cstddef>
#include <memory>
#include <numeric>
#include <span>
#include <utility>
#include <vector>

namespace shaftcull::kernel {

/// The inverse of a tree's order. It is made when it is first asked for: by an update by index, or by a query, which
/// may run beside others. Copies have what was made; what was moved from has nothing.
class LeafPlaces {
 public:
  LeafPlaces() noexcept = default;
  LeafPlaces(const LeafPlaces& other) {
    if (const std::vector<std::uint32_t>* const place = other.made()) made_ = new std::vector<std::uint32_t>(*place);
  }
  LeafPlaces(LeafPlaces&& other) noexcept : made_(other.made_.exchange(nullptr)) {}
  LeafPlaces& operator=(LeafPlaces other) noexcept {
    made_ = other.made_.exchange(made_);
    return *this;
  }
  ~LeafPlaces() { delete made(); }

  /// The leaf of every index, by a tree's order. O(1) but for the first time, which is O(order.size()) and allocates.
  [[nodiscard]] const std::uint32_t* of(std::span<const std::uint32_t> order) const {
    if (const std::vector<std::uint32_t>* const place = made()) return place->data();
    auto place = std::make_unique<std::vector<std::uint32_t>>(order.size());
    for (std::size_t leaf = 0; leaf != order.size(); ++leaf) (*place)[order[leaf]] = static_cast<std::uint32_t>(leaf);
    std::vector<std::uint32_t>* others = nullptr;  // another thread may have made the same meanwhile
    if (!made_.compare_exchange_strong(others, place.get())) return others->data();
    return place.release()->data();
  }
  /// What belongs to an order in which leaf i has index i.
  void reorder() noexcept {
    if (std::vector<std::uint32_t>* const place = made()) std::iota(place->begin(), place->end(), std::uint32_t{0});
  }
  [[nodiscard]] std::size_t bytes() const noexcept {
    return made() == nullptr ? 0 : sizeof(std::uint32_t) * made()->capacity();
  }

 private:
  [[nodiscard]] std::vector<std::uint32_t>* made() const noexcept { return made_.load(std::memory_order_acquire); }

  mutable std::atomic<std::vector<std::uint32_t>*> made_ = nullptr;  // owned
};

}  // namespace shaftcull::kernel
