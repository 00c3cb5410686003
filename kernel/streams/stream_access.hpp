// SPDX-License-Identifier: MIT
/// Access to the memory of streams, which is private in the public classes: to make streams without writing them twice,
/// and to write them.
#pragma once

#include <cstddef>
#include <span>
#include <type_traits>

#include "shaftcull/streams.hpp"
#include "streams/rows.hpp"
#include "support/overlap.hpp"

namespace shaftcull::kernel {

/// The stream that owns what such a view shows.
template <class View>
using StreamOf = std::conditional_t<std::is_same_v<View, BoxView>, BoxStream, SphereStream>;

}  // namespace shaftcull::kernel

namespace shaftcull {

struct StreamAccess {
  /// A stream of `count` bounds that are to be written; the padding behind them is.
  template <class Stream>
  [[nodiscard]] static Stream not_written(std::size_t count) {
    return Stream(typename Stream::NotWritten(), count);
  }

  /// A stream of `count` bounds whose memory, all of it, lies elsewhere and stays there for longer. Copies have memory
  /// of their own. Nothing of it but const members is to be called.
  template <class Stream>
  [[nodiscard]] static Stream in_place(const float* memory, std::size_t count) noexcept {
    Stream stream;
    stream.view_ = kernel::view_in<decltype(stream.view_)>(memory, count);
    return stream;
  }

  /// The rows of a stream that is not const, from bound `first` on.
  template <class Stream>
  [[nodiscard]] static auto rows(Stream& stream, std::size_t first = 0) noexcept {
    static_assert(!std::is_const_v<Stream>);
    kernel::RowsOf<decltype(stream.view())> row;
    for (std::size_t s = 0; s != row.size(); ++s) {
      row[s] = const_cast<float*>(stream.view_.stream[s]) + first;  // the stream's own memory, which is not const
    }
    return row;
  }

  /// The view of a stream where the stream holds it.
  template <class Stream>
  [[nodiscard]] static const auto& view(const Stream& stream) noexcept {
    return stream.view_;
  }

  /// All memory of a stream, padding included.
  template <class Stream>
  [[nodiscard]] static std::span<const std::byte> memory(const Stream& stream) noexcept {
    return kernel::bytes_of(stream.view_.stream[0], stream.memory_bytes() / sizeof(float));
  }
};

}  // namespace shaftcull
