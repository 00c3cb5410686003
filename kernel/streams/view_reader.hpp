// SPDX-License-Identifier: MIT
/// Reading bounds from the user's separate streams.
#pragma once

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <type_traits>

#include "shaftcull/streams.hpp"
#include "streams/strided_reader.hpp"
#include "support/arguments.hpp"
#include "support/compiler.hpp"
#include "support/overlap.hpp"
#include "support/prefetch.hpp"

namespace shaftcull::kernel {

/// The reader of records that hold the bounds of such a view: what is legal there is legal here.
template <class View>
using RecordReaderOf = std::conditional_t<std::is_same_v<View, BoxView>, MinMaxReader, SphereReader>;

/// Same shape as the readers of records, plus prefetch().
template <class View>
class ViewReader {
 public:
  using Records = RecordReaderOf<View>;
  static constexpr std::size_t rows = Records::rows;
  static constexpr const char* noun = Records::noun;
  static constexpr const char* nouns = Records::nouns;

  explicit ViewReader(const View& view) : view_(view) { require_view(view); }

  [[nodiscard]] std::size_t count() const noexcept { return view_.count; }
  void read(std::size_t i, float (&bound)[rows]) const noexcept {
    for (std::size_t s = 0; s != rows; ++s) bound[s] = view_.stream[s][i];
  }
  SHAFTCULL_ALWAYS_INLINE void prefetch(std::size_t i) const noexcept {
    for (std::size_t s = 0; s != rows; ++s) prefetch_to_second_level(view_.stream[s] + i, 1);
  }
  template <class Which>
  void read_four(Which which, float* const* row) const noexcept {
    for (std::size_t s = 0; s != rows; ++s) {
      for (std::size_t i = 0; i != 4; ++i) row[s][i] = view_.stream[s][which[i]];
    }
  }
  [[nodiscard]] bool is_legal(std::size_t i) const noexcept {
    float bound[rows];
    read(i, bound);
    return Records::is_legal(bound);
  }
  [[nodiscard]] bool are_clearly_legal(std::size_t first, std::size_t end) const noexcept {
    unsigned others = 0;
    for (std::size_t i = first; i != end; ++i) {
      float bound[rows];
      read(i, bound);
      others |= Records::is_clearly_legal(bound) ? 0U : 1U;
    }
    return others == 0;
  }
  [[nodiscard]] bool overlaps(std::span<const std::byte> memory) const noexcept {
    return std::any_of(view_.stream.begin(), view_.stream.end(),
                       [&](const float* stream) { return overlap(memory, bytes_of(stream, view_.count)); });
  }
  [[nodiscard]] std::string fault(std::size_t i) const {
    const auto bound = view_[i];
    return Records(strided({&bound, 1})).fault(0);
  }

 private:
  View view_;
};

}  // namespace shaftcull::kernel
