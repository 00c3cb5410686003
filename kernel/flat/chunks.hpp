// SPDX-License-Identifier: MIT
/// One shaft against a view, chunk by chunk of bounds, whose bits stay on the stack.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "compiled/answers.hpp"
#include "compiled/with_planes.hpp"
#include "dispatch/active_kernels.hpp"
#include "kernels/table.hpp"
#include "shaftcull/cull.hpp"
#include "support/arguments.hpp"
#include "support/float_environment.hpp"

namespace shaftcull::kernel {

/// Most bounds in a chunk: so many that what a kernel does once a call vanishes, and few enough for bits on the stack.
inline constexpr std::size_t chunk_bounds = 16384;
/// The first chunk of a call that may end early; each has twice as many as the one before.
inline constexpr std::size_t first_chunk_bounds = 512;

/// One shaft's checked question about a view.
template <class View>
class Chunks {
 public:
  Chunks(const CompiledShaft& shaft, const View& bounds, bool inside)
      : Chunks(checked(data_of(shaft), bounds, inside), bounds, inside) {}

  [[nodiscard]] const SetBits& set_bits() const noexcept { return kernels_.set_bits; }

  /// Calls visit(first, words, kept, inside) for chunk after chunk, the bits of bounds from `first` on, until it
  /// returns false. The first chunk has `chunk` bounds at most.
  template <class Visit>
  void for_each(std::size_t chunk, const Visit& visit) const {
    const FloatEnvironment environment;
    Test* const test = kernels_.test(bounds_);
    std::uint64_t kept[words_for(chunk_bounds)];
    std::uint64_t inside[words_for(chunk_bounds)];
    for (std::size_t first = 0; first != bounds_.count;) {
      const View part = bounds_.slice(first, std::min(chunk, bounds_.count - first));
      test(shaft_.shaft(), part.stream.data(), part.count, kept, inside_ ? inside : nullptr);
      if (!visit(first, words_for(part.count), kept, inside)) return;
      first += part.count;
      chunk = std::min(2 * chunk, chunk_bounds);
    }
  }

 private:
  static constexpr bool is_sphere = std::is_same_v<View, SphereView>;

  /// The shaft, if the question can be answered; otherwise throws InvalidArgument.
  static const ShaftData& checked(const ShaftData& shaft, const View& bounds, bool inside) {
    require_answers(shaft, true, inside, is_sphere, 0);
    require_view(bounds);
    return shaft;
  }

  Chunks(const ShaftData& shaft, const View& bounds, bool inside) noexcept
      : shaft_(shaft, inside || outside_needs_planes(shaft, is_sphere)),
        bounds_(bounds),
        kernels_(active_kernels()),
        inside_(inside) {}

  WithPlanes shaft_;  // completed once, not chunk by chunk
  View bounds_;
  const Kernels& kernels_;
  bool inside_;
};

}  // namespace shaftcull::kernel
