// SPDX-License-Identifier: MIT
/// From views to words: blocks of bounds through the stages of a test.
#pragma once

#include "compiled/with_planes.hpp"
#include "kernels/blocking/boxes.hpp"
#include "kernels/boxes/contact.hpp"
#include "kernels/boxes/inside_one_by_one.hpp"
#include "kernels/boxes/outside_one_by_one.hpp"
#include "kernels/boxes/planes.hpp"
#include "kernels/boxes/slab.hpp"
#include "kernels/forming/added_planes.hpp"
#include "kernels/forming/pair.hpp"
#include "kernels/grid/testing.hpp"
#include "kernels/hulls/stages.hpp"
#include "kernels/set_bits.hpp"
#include "kernels/shared/survivors.hpp"
#include "kernels/shared/word.hpp"
#include "kernels/siblings/block.hpp"
#include "kernels/siblings/facing.hpp"
#include "kernels/siblings/form.hpp"
#include "kernels/siblings/keep.hpp"
#include "kernels/siblings/pack.hpp"
#include "kernels/spheres/boxes_around.hpp"
#include "kernels/spheres/planes.hpp"
#include "kernels/table.hpp"
#include "kernels/tree/compress_indices.hpp"
#include "kernels/tree/keep_layers.hpp"
#include "kernels/tree/listed_words.hpp"
#include "kernels/tree/node_bounds.hpp"
#include "kernels/tree/partition.hpp"
#include "kernels/triangles/stages.hpp"
#include "shaftcull/cull.hpp"
#include "support/compiler.hpp"
#include "support/padding.hpp"

namespace shaftcull::kernel {

/// Writes the bits that a stage starts from: those of an earlier stage, or ones for all `count` bounds.
template <class L>
void copy_or_set(const std::uint64_t* from, std::size_t count, std::uint64_t* bits) noexcept {
  for (std::size_t w = 0; w < words_of(count); ++w) bits[w] = from != nullptr ? from[w] : ~std::uint64_t{0};
  if (count % word_bits != 0) bits[count / word_bits] &= first_bits(count % word_bits);
}

/// Runs a first stage, stage(stream, words, bits), which reads whole words and writes bits, on `count` bounds.
template <class L, unsigned streams, class Stage>
void begin_in_whole_words(const float* const* stream, std::size_t count, std::uint64_t* bits,
                          const float (&padding)[streams], Stage stage) noexcept {
  in_whole_words<L>(stream, count, bits, padding, stage);
  if (count % word_bits != 0) bits[count / word_bits] &= first_bits(count % word_bits);
}

/// The last bounds of `count`, if they do not fill a word.
template <class L>
ConsecutiveWords<L> consecutive_words(std::size_t count) noexcept {
  return {.rest = static_cast<unsigned>(count % word_bits)};
}

/// The stages of box tests.
template <class L>
struct BoxStages {
  static constexpr unsigned streams = 6;

  /// So few boxes are tested one at a time: that is quicker than to broadcast the shaft to whole vectors.
  static constexpr std::size_t few_boxes = 2;

  static bool needs_planes(const ShaftData& shaft) noexcept { return outside_needs_planes(shaft, false); }

  static void cull(const ShaftData& shaft, const float* const* stream, std::size_t count,
                   std::uint64_t* kept) noexcept {
    if (shaft.is_hull()) [[unlikely]]
      return HullStages<L>::cull_boxes(*shaft.hull, stream, count, kept);
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

/// The stages of sphere tests in plane form, and what all sphere tests have in common.
template <class L>
struct SphereStages {
  static constexpr unsigned streams = 4;

  static void cull(const ShaftData& shaft, const float* const* stream, std::size_t count,
                   std::uint64_t* kept) noexcept {
    if (shaft.is_hull()) [[unlikely]] {
      copy_or_set<L>(nullptr, count, kept);
      return HullStages<L>::cull_spheres(*shaft.hull, stream, count, kept);
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

/// Writes which bounds are inside of those that are not outside, for callers who do not ask which these are.
template <class Stages>
SHAFTCULL_COLD void find_inside_of_kept(const ShaftData& shaft, const float* const* stream, std::size_t count,
                                        std::uint64_t* inside) noexcept {
  std::uint64_t kept[block_words];
  Stages::cull(shaft, stream, count, kept);
  Stages::find_inside(shaft, stream, count, kept, inside);
}

/// Runs the `count` bounds of one block through the stages that the caller wants answers of.
template <class Stages>
void test_block(const ShaftData& shaft, const float* const* stream, std::size_t count, std::uint64_t* kept,
                std::uint64_t* inside) noexcept {
  if (kept != nullptr) Stages::cull(shaft, stream, count, kept);
  if (inside == nullptr) return;
  // With open contact, what lies in the shaft's surface is in the shaft, and outside.
  if (kept == nullptr && shaft.contact == Contact::open) [[unlikely]]
    return find_inside_of_kept<Stages>(shaft, stream, count, inside);
  Stages::find_inside(shaft, stream, count, kept, inside);
}

/// The test of an instruction set, as Kernels has it.
template <class L, class Stages>
void test_bounds(const ShaftData& shaft, const float* const* stream, std::size_t count, std::uint64_t* kept,
                 std::uint64_t* inside) noexcept {
  const WithPlanes completed(shaft, inside != nullptr || Stages::needs_planes(shaft));

  const float* at[Stages::streams];
  for (unsigned s = 0; s < Stages::streams; ++s) at[s] = stream[s];
  while (true) {
    const std::size_t block = count < block_bounds ? count : block_bounds;
    test_block<Stages>(completed.shaft(), at, block, kept, inside);
    count -= block;
    if (count == 0) return;
    for (const float*& s : at) s += block;
    if (kept != nullptr) kept += block_words;
    if (inside != nullptr) inside += block_words;
  }
}

/// The tests of a single bound, as Kernels has them.
template <class L, class Stages>
bool keeps_single(const ShaftData& shaft, const float* const* stream) noexcept {
  const WithPlanes completed(shaft, Stages::needs_planes(shaft));
  std::uint64_t kept = 0;
  Stages::cull(completed.shaft(), stream, 1, &kept);
  return kept != 0;
}

template <class L, class Stages>
Answer classify_single(const ShaftData& shaft, const float* const* stream) noexcept {
  if (!keeps_single<L, Stages>(shaft, stream)) return Answer::outside;
  const WithPlanes completed(shaft, true);
  const std::uint64_t kept = 1;
  std::uint64_t inside = 0;
  Stages::find_inside(completed.shaft(), stream, 1, &kept, &inside);
  return inside == 0 ? Answer::overlap : Answer::inside;
}

/// As GridKernels has it.
template <class L, class Stages>
void finish_after_grid(const ShaftData& shaft, const float* const* stream, std::size_t count, std::uint64_t* kept,
                       std::uint64_t* inside) noexcept {
  const WithPlanes completed(shaft, inside != nullptr);
  Stages::finish(completed.shaft(), stream, count, kept);
  if (inside != nullptr) Stages::find_inside(completed.shaft(), stream, count, kept, inside);
}

/// Forms shafts in batches, as Kernels has it.
template <class L>
bool compile_pairs(const float* const* a, const float* const* b, std::size_t count, ShaftData* out) noexcept {
  if (!all_finite<L>(a, count) || !all_finite<L>(b, count)) return false;
  compile_slabs<L>(a, b, count, out);
  return true;
}

/// As Kernels has it.
template <class L>
void compile_finite_pairs(const float* const* a, const float* const* b, std::size_t count, ShaftData* out) noexcept {
  compile_slabs<L>(a, b, count, out);
}

/// As Kernels has it.
template <class L>
bool all_boxes_finite(const float* const* box, std::size_t count) noexcept {
  return all_finite<L>(box, count);
}

/// Tests on a grid, where there are vectors of 16-bit integers.
template <class L>
constexpr GridKernels grid_kernels() noexcept {
  if constexpr (requires { typename L::Integers16; }) {
    return {.fewest_shafts = L::Integers16::fewest_shafts_on_grid,
            .fewest_tests = L::Integers16::fewest_tests_on_grid,
            .frame = grid_frame<L>,
            .form_shafts = form_grid_shafts<L>,
            .snap_boxes = snap_boxes<L>,
            .extent = tile_extent<L>,
            .test = test_on_grid<L>,
            .resolve = resolve_in_floats<L>,
            .finish_boxes = finish_after_grid<L, BoxStages<L>>,
            .finish_spheres = finish_after_grid<L, SphereStages<L>>};
  } else {
    return {};
  }
}

/// The functions that pack siblings, where a set has what that takes.
template <class L>
struct SiblingPacking {
  static constexpr auto pack = static_cast<decltype(SiblingKernels::pack)>(nullptr);
  static constexpr auto spread = static_cast<decltype(SiblingKernels::spread)>(nullptr);
};
template <MovesBits L>
struct SiblingPacking<L> {
  static constexpr auto pack = pack_siblings<L>;
  static constexpr auto spread = spread_siblings<L>;
};

/// Tests run on vectors of `L`, formation on vectors of `FormationLanes`.
template <class L, class FormationLanes = L>
inline constexpr Kernels kernels_for = {
    .width = L::width,
    .boxes = test_bounds<L, BoxStages<L>>,
    .spheres = test_bounds<L, UnboxedSphereStages<L>>,
    .boxed_spheres = test_bounds<L, BoxedSphereStages<L>>,
    .keeps_box = keeps_single<L, BoxStages<L>>,
    .keeps_sphere = keeps_single<L, UnboxedSphereStages<L>>,
    .classify_box = classify_single<L, BoxStages<L>>,
    .classify_sphere = classify_single<L, UnboxedSphereStages<L>>,
    .boxes_around_spheres = boxes_around_spheres<L>,
    .grid = grid_kernels<L>(),
    .compile_pair = compile_pair<FormationLanes>,
    .compile_batch = compile_pairs<FormationLanes>,
    .compile_finite = compile_finite_pairs<FormationLanes>,
    .all_finite = all_boxes_finite<FormationLanes>,
    .all_planes_usable = all_planes_usable<FormationLanes>,
    .add_planes = add_planes<FormationLanes>,
    .listed_boxes = test_listed_words<L, BoxStages<L>>,
    .listed_spheres = test_listed_words<L, UnboxedSphereStages<L>>,
    .blocking = {test_blocking<L>, test_blocking_listed<L>, test_blocking_nodes<L>},
    .siblings = {.pack = SiblingPacking<L>::pack,
                 .spread = SiblingPacking<L>::spread,
                 .select = select_listed<L>,
                 .form = form_siblings<L>,
                 .keep_any = keep_any<L>,
                 .keep = keep_siblings<L>,
                 .block = block_siblings<L>,
                 .may_block = may_block_siblings<L>,
                 .behind_plane = behind_plane<L>,
                 .behind_planes = behind_planes<L>,
                 .points_behind_planes = points_behind_planes<L>,
                 .behind_groups = behind_groups<L>,
                 .behind_group = behind_group<L>},
    .triangles_by_vertices = test_triangles_by_vertices<L>,
    .triangles_exactly = test_triangles_exactly<L>,
    .compress_indices = compress_indices<L>,
    .keep_layers = keep_layers<L>,
    .node_bounds_of_boxes = node_bounds_of_boxes<L>,
    .node_bounds_of_spheres = node_bounds_of_spheres<L>,
    .split = split_kernels<L>,
    .set_bits = {count_set_bits<L>, write_set_bits<L>},
};

}  // namespace shaftcull::kernel
