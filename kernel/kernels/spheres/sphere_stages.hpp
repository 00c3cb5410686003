// SPDX-License-Identifier: MIT
/// The stages of sphere tests, on the bounds of one block.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compiled/shaft_data.hpp"
#include "compiled/with_planes.hpp"
#include "kernels/boxes/slab_stages.hpp"
#include "kernels/hulls/hull_stages.hpp"
#include "kernels/shared/survivors.hpp"
#include "kernels/shared/word.hpp"
#include "kernels/spheres/sphere_planes.hpp"
#include "support/padding.hpp"

namespace shaftcull::kernel {

/// The stages of sphere tests in plane form, and what all sphere tests have in common.
template <class L>
struct SphereStages {
  static constexpr unsigned streams = 4;

  static void cull(const ShaftData& shaft, const float* const* stream, std::size_t count,
                   std::uint64_t* kept) noexcept {
    if (shaft.is_hull()) [[unlikely]] {
      copy_or_set<L>(nullptr, count, kept);
      return HullStages<L>::cull_spheres(*shaft.hull, shaft.contact, stream, count, kept);
    }
    begin_in_whole_words<L>(stream, count, kept, padding_sphere,
                            [&](const float* const* all, std::size_t words, std::uint64_t* bits) {
                              sphere_planes_stage<L>(shaft, all, words, bits);
                            });
    finish(shaft, stream, count, kept);
  }

  static void finish(const ShaftData& shaft, const float* const* stream, std::size_t count,
                     std::uint64_t* kept) noexcept {
    run_on_survivors<L, streams>(stream, count, kept,
                                 [&](const float* const* some, std::size_t n, std::uint64_t* bits) {
                                   sphere_distance_stage<L>(shaft, some, n, bits);
                                 });
  }

  /// Writes which spheres are inside: of those in `kept`, or of all if that is null.
  static void find_inside(const ShaftData& shaft, const float* const* stream, std::size_t count,
                          const std::uint64_t* kept, std::uint64_t* inside) noexcept {
    copy_or_set<L>(kept, count, inside);
    if (shaft.is_hull()) [[unlikely]]
      return HullStages<L>::find_spheres_inside(*shaft.hull, stream, count, inside);
    run_on_survivors<L, streams>(stream, count, inside,
                                 [&](const float* const* some, std::size_t n, std::uint64_t* bits) {
                                   sphere_inside_stage<L>(shaft, some, n, bits);
                                 });
  }
};

/// The same in slab form, with the six streams of the boxes around the spheres after their own four.
template <class L>
struct BoxedSphereStages {
  static constexpr unsigned streams = 10;

  static bool needs_planes(const ShaftData& shaft) noexcept { return outside_needs_planes(shaft, true); }

  static void cull(const ShaftData& shaft, const float* const* stream, std::size_t count,
                   std::uint64_t* kept) noexcept {
    if (needs_planes(shaft)) return SphereStages<L>::cull(shaft, stream, count, kept);
    sphere_slab_stage<L, BoxedSphereCorners>(shaft, stream + SphereStages<L>::streams, count / word_bits, kept,
                                             consecutive_words<L>(count));
    SphereStages<L>::finish(shaft, stream, count, kept);
  }

  static void find_inside(const ShaftData& shaft, const float* const* stream, std::size_t count,
                          const std::uint64_t* kept, std::uint64_t* inside) noexcept {
    SphereStages<L>::find_inside(shaft, stream, count, kept, inside);
  }
};

/// The same for spheres that come without boxes around them.
template <class L>
struct UnboxedSphereStages {
  static constexpr unsigned streams = 4;

  static bool needs_planes(const ShaftData& shaft) noexcept { return BoxedSphereStages<L>::needs_planes(shaft); }

  static void cull(const ShaftData& shaft, const float* const* stream, std::size_t count,
                   std::uint64_t* kept) noexcept {
    if (needs_planes(shaft)) return SphereStages<L>::cull(shaft, stream, count, kept);
    sphere_slab_stage<L, SphereCorners>(shaft, stream, count / word_bits, kept, consecutive_words<L>(count));
    SphereStages<L>::finish(shaft, stream, count, kept);
  }

  static void find_inside(const ShaftData& shaft, const float* const* stream, std::size_t count,
                          const std::uint64_t* kept, std::uint64_t* inside) noexcept {
    SphereStages<L>::find_inside(shaft, stream, count, kept, inside);
  }
};

}  // namespace shaftcull::kernel
