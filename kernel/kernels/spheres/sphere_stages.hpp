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

/// The same in slab form. `Corners` are those of the spheres, or of boxes around them, whose six streams come after the
/// spheres' own four.
template <class L, template <class> class Corners>
struct SphereSlabStages : SphereStages<L> {
  static constexpr unsigned of_sphere = SphereStages<L>::streams;
  static constexpr bool has_boxes = !Corners<L>::has_radius;
  static constexpr unsigned streams = has_boxes ? of_sphere + 6 : of_sphere;

  static bool needs_planes(const ShaftData& shaft) noexcept { return outside_needs_planes(shaft, true); }

  static void cull(const ShaftData& shaft, const float* const* stream, std::size_t count,
                   std::uint64_t* kept) noexcept {
    if (needs_planes(shaft)) return SphereStages<L>::cull(shaft, stream, count, kept);
    sphere_slab_stage<L, Corners>(shaft, has_boxes ? stream + of_sphere : stream, count / word_bits, kept,
                                  consecutive_words<L>(count));
    SphereStages<L>::finish(shaft, stream, count, kept);
  }
};

template <class L>
using BoxedSphereStages = SphereSlabStages<L, BoxedSphereCorners>;

/// For spheres that come without boxes around them.
template <class L>
using UnboxedSphereStages = SphereSlabStages<L, SphereCorners>;

}  // namespace shaftcull::kernel
