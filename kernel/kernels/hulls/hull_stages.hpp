// SPDX-License-Identifier: MIT
/// The stages of a convex hull's tests, on the bounds of one block.
#pragma once

#include "compiled/shaft_data.hpp"
#include "kernels/hulls/hull_boxes.hpp"
#include "kernels/hulls/hull_contact.hpp"
#include "kernels/hulls/hull_spheres.hpp"
#include "kernels/shared/survivors.hpp"
#include "kernels/shared/word.hpp"
#include "support/compiler.hpp"
#include "support/padding.hpp"

namespace shaftcull::kernel {

// Not inlined, so that their memory is not on the stack of the stages of other shafts.
template <class L>
struct HullStages {
  static constexpr unsigned box_streams = 6;
  static constexpr unsigned sphere_streams = 4;

  /// Writes the kept bits of `count` boxes.
  SHAFTCULL_NOINLINE static void cull_boxes(const HullData& hull, const float* const* stream, std::size_t count,
                                            std::uint64_t* kept) noexcept {
    if (count <= few_boxes_of_hull<L> && !has_one_stage(hull))
      return few_boxes_stage<L, Contact::closed>(hull, stream, count, kept);
    in_whole_words<L>(stream, count, kept, padding_box,
                      [&](const float* const* all, std::size_t words, std::uint64_t* bits) {
                        first_hull_stage<L>(hull, all, words, bits, ConsecutiveWords<L>{});
                      });
    if (count % word_bits != 0) kept[count / word_bits] &= first_bits(count % word_bits);
    if (has_one_stage(hull)) return;
    run_on_survivors<L, box_streams>(stream, count, kept,
                                     [&](const float* const* some, std::size_t words, std::uint64_t* bits) {
                                       hull_edges_stage<L>(hull, some, words, bits);
                                     });
  }

  /// With open contact, clears the bits of boxes that only touch the hull; others that the bits are set of meet it.
  SHAFTCULL_NOINLINE static void cull_touching_boxes(const HullData& hull, const float* const* stream,
                                                     std::size_t count, std::uint64_t* kept) noexcept {
    run_on_survivors<L, box_streams>(stream, count, kept,
                                     [&](const float* const* some, std::size_t words, std::uint64_t* bits) {
                                       hull_contact_stage<L>(hull, some, words, bits);
                                     });
  }

  SHAFTCULL_NOINLINE static void cull_boxes_openly(const HullData& hull, const float* const* stream, std::size_t count,
                                                   std::uint64_t* kept) noexcept {
    if (count <= few_boxes_of_hull<L> && !has_one_stage(hull))
      return few_boxes_stage<L, Contact::open>(hull, stream, count, kept);
    cull_boxes(hull, stream, count, kept);
    cull_touching_boxes(hull, stream, count, kept);
  }

  /// Writes the kept bits of `count` boxes, with any contact.
  static void cull_boxes(const ShaftData& shaft, const float* const* stream, std::size_t count,
                         std::uint64_t* kept) noexcept {
    if (shaft.is_open_hull()) [[unlikely]]
      return cull_boxes_openly(*shaft.hull, stream, count, kept);
    cull_boxes(*shaft.hull, stream, count, kept);
  }

  // Of `count` bounds, these clear the bits of those that are not what the name says. Bits behind the last stay clear.

  SHAFTCULL_NOINLINE static void find_boxes_inside(const HullData& hull, const float* const* stream, std::size_t count,
                                                   std::uint64_t* inside) noexcept {
    run_on_survivors<L, box_streams>(stream, count, inside,
                                     [&](const float* const* some, std::size_t words, std::uint64_t* bits) {
                                       hull_inside_stage<L>(hull, some, words, bits);
                                     });
  }

  SHAFTCULL_NOINLINE static void cull_spheres(const HullData& hull, Contact contact, const float* const* stream,
                                              std::size_t count, std::uint64_t* kept) noexcept {
    run_on_survivors<L, sphere_streams>(stream, count, kept,
                                        [&](const float* const* some, std::size_t words, std::uint64_t* bits) {
                                          hull_spheres_stage<L, false>(hull, contact, some, words, bits);
                                        });
  }

  SHAFTCULL_NOINLINE static void find_spheres_inside(const HullData& hull, const float* const* stream,
                                                     std::size_t count, std::uint64_t* inside) noexcept {
    run_on_survivors<L, sphere_streams>(stream, count, inside,
                                        [&](const float* const* some, std::size_t words, std::uint64_t* bits) {
                                          hull_spheres_stage<L, true>(hull, Contact::closed, some, words, bits);
                                        });
  }
};

}  // namespace shaftcull::kernel
