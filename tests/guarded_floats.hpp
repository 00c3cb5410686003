// SPDX-License-Identifier: MIT
/// Memory that ends where the process may not read.
#pragma once

#include <array>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <tuple>
#include <vector>

#include "pages.hpp"
#include "support/fail.hpp"

namespace shaftcull {

/// A copy of some floats whose last one lies just before a page that cannot be touched.
class GuardedFloats {
 public:
  explicit GuardedFloats(const std::vector<float>& floats)
      : GuardedFloats(floats, floats.size() * sizeof(float), Pages::page_bytes()) {}

  [[nodiscard]] const float* floats() const noexcept { return floats_; }

 private:
  GuardedFloats(const std::vector<float>& floats, std::size_t bytes, std::size_t page)
      : pages_((bytes + page - 1) / page * page + page) {
    const std::size_t end = pages_.bytes().size() - page;
    if (!pages_.forbid_from(end)) kernel::fail(std::bad_alloc());
    floats_ = reinterpret_cast<float*>(pages_.bytes().data() + end - bytes);
    if (bytes != 0) std::memcpy(floats_, floats.data(), bytes);
  }

  Pages pages_;
  float* floats_;
};

/// A copy of a view whose streams all end just before such a page: a read past its count would crash.
template <class View>
class GuardedView {
 public:
  explicit GuardedView(const View& view) : view_(view) {
    for (std::size_t k = 0; k != memory_.size(); ++k) {
      memory_[k] = std::make_unique<GuardedFloats>(std::vector<float>(view.stream[k], view.stream[k] + view.count));
      view_.stream[k] = memory_[k]->floats();
    }
  }

  [[nodiscard]] const View& view() const noexcept { return view_; }

 private:
  std::array<std::unique_ptr<GuardedFloats>, std::tuple_size_v<decltype(View::stream)>> memory_;
  View view_;
};

}  // namespace shaftcull
