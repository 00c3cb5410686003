// SPDX-License-Identifier: MIT
/// Results of the C++ interface as those of C.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "arguments.hpp"

namespace shaftcull::binding {

[[nodiscard]] inline shaftcull_kept_counts from_counts(const KeptCounts& counts) noexcept {
  return {counts.overlap, counts.inside};
}

[[nodiscard]] inline shaftcull_contact_found from_contact(const FirstContact& contact) noexcept {
  const bool found = static_cast<bool>(contact);
  return {found ? std::uint64_t{contact.index} : SHAFTCULL_NONE, contact.time, found ? 1U : 0U};
}

/// Memory that a call of the C++ interface writes to, whose elements then go to C. Not initialised.
template <class Element>
class Written {
 public:
  explicit Written(std::size_t size) : elements_(std::make_unique_for_overwrite<Element[]>(size)), size_(size) {}
  [[nodiscard]] std::span<Element> span() const noexcept { return {elements_.get(), size_}; }

  /// Converts all of them.
  template <class Out, class Convert>
  void copy_to(std::span<Out> out, Convert&& convert) const {
    std::transform(elements_.get(), elements_.get() + size_, out.begin(), convert);
  }

 private:
  std::unique_ptr<Element[]> elements_;
  std::size_t size_;
};

}  // namespace shaftcull::binding
