// SPDX-License-Identifier: MIT
/// The stages of box tests, on the bounds of one block.
#pragma once

#include <cstddef>
#include <cstdint>

#include "compiled/shaft_data.hpp"
#include "compiled/with_planes.hpp"
#include "kernels/boxes/box_contact.hpp"
#include "kernels/boxes/box_planes.hpp"
#include "kernels/boxes/inside_one_by_one.hpp"
#include "kernels/boxes/outside_one_by_one.hpp"
#include "kernels/boxes/slab_stages.hpp"
#include "kernels/hulls/hull_stages.hpp"
#include "kernels/shared/survivors.hpp"
#include "kernels/shared/word.hpp"
#include "support/compiler.hpp"
#include "support/padding.hpp"

namespace shaftcull::kernel {

template <class L>
struct BoxStages {
  static constexpr unsigned streams = 6;

  /// So few boxes are tested one at a time: that is quicker than to broadcast the shaft to whole vectors.
  static constexpr std::size_t few_boxes = 2;

  static bool needs_planes(const ShaftData& shaft) noexcept { return outside_needs_planes(shaft, false); }

  static void cull(const ShaftData& shaft, const float* const* stream, std::size_t count,
                   std::uint64_t* kept) noexcept {
    if (shaft.is_hull()) [[unlikely]]
      return HullStages<L>::cull_boxes(shaft, stream, count, kept);
    if (shaft.form == Form::planes) [[unlikely]]
      return cull_by_planes(shaft, stream, count, kept);
    if constexpr (L::EightFloats::in_one_register) {
      if (count <= few_boxes && SlabInLanes<L>::suits(shaft)) {
        const std::uint64_t all = first_bits(static_cast<unsigned>(count));
        *kept = all & ~outside_one_by_one<L>(shaft, stream, 0, all);
        return finish(shaft, stream, count, kept);
      }
    }
    box_slab_stage<L>(shaft, stream, count / word_bits, kept, consecutive_words<L>(count));
    finish(shaft, stream, count, kept);
  }

  SHAFTCULL_NOINLINE static void cull_by_planes(const ShaftData& shaft, const float* const* stream, std::size_t count,
                                                std::uint64_t* kept) noexcept {
    begin_in_whole_words<L>(stream, count, kept, padding_box,
                            [&](const float* const* all, std::size_t words, std::uint64_t* bits) {
                              box_planes_stage<L>(shaft, all, words, bits);
                            });
    finish(shaft, stream, count, kept);
  }

  /// Faces that a box may touch without being undecided, where contact is open: in slab form those that do not move,
  /// as they put no bound on t.
  static unsigned compared_faces(const ShaftData& shaft) noexcept {
    if (shaft.form == Form::planes) [[unlikely]]
      return shaft.contact == Contact::open ? all_faces : 0;
    return shaft.still_faces;
  }

  /// Clears the bits of boxes that are beyond an added plane or, where contact is open, touch one of these faces.
  static void finish(const ShaftData& shaft, const float* const* stream, std::size_t count,
                     std::uint64_t* kept) noexcept {
    if (is_finished(shaft)) return;
    run_on_survivors<L, streams>(
        stream, count, kept,
        [&](const float* const* some, std::size_t n, std::uint64_t* bits) { finish_words(shaft, some, n, bits); });
  }
  static bool is_finished(const ShaftData& shaft) noexcept {
    return shaft.added_count == 0 && compared_faces(shaft) == 0;
  }
  static void finish_words(const ShaftData& shaft, const float* const* stream, std::size_t words,
                           std::uint64_t* kept) noexcept {
    if (const unsigned faces = compared_faces(shaft); faces != 0) [[unlikely]]
      box_contact_stage<L>(shaft, faces, stream, words, kept);
    if (shaft.added_count != 0) box_added_stage<L>(shaft, stream, words, kept);
  }

  /// Writes which boxes are inside: of those in `kept`, or of all if that is null.
  static void find_inside(const ShaftData& shaft, const float* const* stream, std::size_t count,
                          const std::uint64_t* kept, std::uint64_t* inside) noexcept {
    if (shaft.is_hull()) [[unlikely]] {
      copy_or_set<L>(kept, count, inside);
      return HullStages<L>::find_boxes_inside(*shaft.hull, stream, count, inside);
    }
    if constexpr (L::EightFloats::in_one_register) {
      if (kept != nullptr && PlanesInLanes<L>::suits(shaft) && are_sparse<L>(kept, words_of(count))) {
        return box_inside_one_by_one_stage<L>(shaft, stream, words_of(count), kept, inside);
      }
    }
    copy_or_set<L>(kept, count, inside);
    run_on_survivors<L, streams>(stream, count, inside,
                                 [&](const float* const* some, std::size_t n, std::uint64_t* bits) {
                                   box_inside_stage<L>(shaft, some, n, bits);
                                 });
  }
};

}  // namespace shaftcull::kernel
