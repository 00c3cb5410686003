// SPDX-License-Identifier: MIT
/// The table of an instruction set: which functions, on its vectors, are its kernels.
#pragma once

#include "kernels/blocking/blocking_boxes.hpp"
#include "kernels/boxes/box_stages.hpp"
#include "kernels/forming/added_planes.hpp"
#include "kernels/forming/moving_box.hpp"
#include "kernels/forming/slab_of_pair.hpp"
#include "kernels/grid/testing.hpp"
#include "kernels/kernel_table.hpp"
#include "kernels/rays/rays.hpp"
#include "kernels/rays/tree_rays.hpp"
#include "kernels/set_bits.hpp"
#include "kernels/shared/block_tests.hpp"
#include "kernels/shared/single_bound.hpp"
#include "kernels/siblings/block.hpp"
#include "kernels/siblings/cone.hpp"
#include "kernels/siblings/facing.hpp"
#include "kernels/siblings/form.hpp"
#include "kernels/siblings/keep.hpp"
#include "kernels/siblings/meet.hpp"
#include "kernels/siblings/reach.hpp"
#include "kernels/siblings/sibling_packing.hpp"
#include "kernels/spheres/boxes_around_spheres.hpp"
#include "kernels/spheres/sphere_stages.hpp"
#include "kernels/tree/best_node.hpp"
#include "kernels/tree/compress_indices.hpp"
#include "kernels/tree/keep_layers.hpp"
#include "kernels/tree/listed_words.hpp"
#include "kernels/tree/node_bounds.hpp"
#include "kernels/tree/partition.hpp"
#include "kernels/triangles/triangle_stages.hpp"

namespace shaftcull::kernel {

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
    .keeps_box = keeps_box<L>,
    .keeps_sphere = keeps_sphere<L>,
    .classify_box = classify_box<L>,
    .classify_sphere = classify_sphere<L>,
    .boxes_around_spheres = boxes_around_spheres<L>,
    .grid = grid_kernels<L>(),
    .compile_pair = compile_pair<FormationLanes>,
    .compile_swept = compile_swept<FormationLanes>,
    .compile_swept_infinite = compile_swept_infinite<FormationLanes>,
    .compile_endless_shadow = compile_endless_shadow<FormationLanes>,
    .compile_finite = compile_slabs<FormationLanes>,
    .all_finite = all_finite<FormationLanes>,
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
                 .corners_behind_plane = corners_behind_plane<L>,
                 .points_behind_planes = points_behind_planes<L>,
                 .may_meet_solid = may_meet_solid<L>,
                 .planes_behind_points = planes_behind_points<L>,
                 .reach_between = reach_between<L>,
                 .corners_behind_cone = corners_behind_cone<L>,
                 .boxes_behind_cone = boxes_behind_cone<L>,
                 .behind_groups = behind_groups<L>,
                 .behind_group = behind_group<L>},
    .rays = {form_rays<L>, meet_box<L>, meet_body<L>, meet_triangles<L>, meet_tree<L>},
    .triangles_by_vertices = test_triangles_by_vertices<L>,
    .triangles_exactly = test_triangles_exactly<L>,
    .compress_indices = compress_indices<L>,
    .keep_layers = keep_layers<L>,
    .node_bounds_of_boxes = node_bounds_of_boxes<L>,
    .node_bounds_of_spheres = node_bounds_of_spheres<L>,
    .best_node = best_node<L>,
    .split = split_kernels<L>,
    .set_bits = {count_set_bits<L>, write_set_bits<L>},
};

}  // namespace shaftcull::kernel
