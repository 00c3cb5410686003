// SPDX-License-Identifier: MIT
// The places of fields in structs, on which the JavaScript relies.
#include <cstddef>

#include "shaftcull.h"

namespace {

static_assert(sizeof(void*) == 4);

static_assert(sizeof(shaftcull_source) == 56);
static_assert(offsetof(shaftcull_source, kind) == 0);
static_assert(offsetof(shaftcull_source, count) == 8);
static_assert(offsetof(shaftcull_source, first) == 16);
static_assert(offsetof(shaftcull_source, second) == 20);
static_assert(offsetof(shaftcull_source, stride) == 24);
static_assert(offsetof(shaftcull_source, indices) == 32);
static_assert(offsetof(shaftcull_source, vertex_count) == 40);
static_assert(SHAFTCULL_SOURCE_BOXES == 1 && SHAFTCULL_SOURCE_SPHERES == 3 && SHAFTCULL_SOURCE_TRIANGLES == 4);
static_assert(SHAFTCULL_SOURCE_MESH == 5);
static_assert(SHAFTCULL_BOXES == 1 && SHAFTCULL_SPHERES == 2 && SHAFTCULL_TRIANGLES == 3);
static_assert(SHAFTCULL_OUTSIDE == 0 && SHAFTCULL_OVERLAP == 1 && SHAFTCULL_INSIDE == 2);
static_assert(sizeof(shaftcull_box) == 24 && offsetof(shaftcull_box, hi) == 12);
static_assert(sizeof(shaftcull_sphere) == 16 && offsetof(shaftcull_sphere, radius) == 12);
static_assert(sizeof(shaftcull_triangle) == 36);

static_assert(sizeof(shaftcull_hull_info) == 48);
static_assert(offsetof(shaftcull_hull_info, point_count) == 0);
static_assert(offsetof(shaftcull_hull_info, direction_count) == 8);
static_assert(offsetof(shaftcull_hull_info, points) == 16);
static_assert(offsetof(shaftcull_hull_info, directions) == 20);

static_assert(sizeof(shaftcull_shafts_info) == 68);
static_assert(offsetof(shaftcull_shafts_info, a) == 0);
static_assert(offsetof(shaftcull_shafts_info, b) == 24);

static_assert(sizeof(shaftcull_query) == 128);
static_assert(offsetof(shaftcull_query, exclude) == 0);
static_assert(offsetof(shaftcull_query, exclude_count) == 8);
static_assert(offsetof(shaftcull_query, exclude_each) == 16);
static_assert(offsetof(shaftcull_query, exclude_each_count) == 24);
static_assert(offsetof(shaftcull_query, exclude_mask) == 32);
static_assert(offsetof(shaftcull_query, exclude_mask_words) == 40);
static_assert(offsetof(shaftcull_query, layer_masks) == 48);
static_assert(offsetof(shaftcull_query, layer_mask_count) == 56);
static_assert(offsetof(shaftcull_query, only) == 64);
static_assert(offsetof(shaftcull_query, only_count) == 72);
static_assert(offsetof(shaftcull_query, limit) == 80);
static_assert(offsetof(shaftcull_query, triangle_test) == 88);
static_assert(SHAFTCULL_TRIANGLES_EXACT == 0 && SHAFTCULL_TRIANGLES_BY_VERTICES == 1);

static_assert(sizeof(shaftcull_batch_planes) == 32);
static_assert(offsetof(shaftcull_batch_planes, a_count) == 8);

static_assert(sizeof(shaftcull_kept_counts) == 16 && offsetof(shaftcull_kept_counts, inside) == 8);

static_assert(sizeof(shaftcull_contact_found) == 16);
static_assert(offsetof(shaftcull_contact_found, index) == 0);
static_assert(offsetof(shaftcull_contact_found, time) == 8);

static_assert(sizeof(shaftcull_lists_info) == 16);
static_assert(offsetof(shaftcull_lists_info, offsets) == 8);
static_assert(offsetof(shaftcull_lists_info, indices) == 12);

static_assert(sizeof(shaftcull_patches_info) == 16);
static_assert(offsetof(shaftcull_patches_info, count) == 0);
static_assert(offsetof(shaftcull_patches_info, order) == 8);

static_assert(sizeof(shaftcull_occluder_info) == 40);
static_assert(offsetof(shaftcull_occluder_info, triangles) == 0);
static_assert(offsetof(shaftcull_occluder_info, triangle_count) == 8);

static_assert(sizeof(shaftcull_visibility_options) == 40);
static_assert(offsetof(shaftcull_visibility_options, contact) == 8);

static_assert(sizeof(shaftcull_sight_counts) == 32);
static_assert(offsetof(shaftcull_sight_counts, clear) == 8);
static_assert(offsetof(shaftcull_sight_counts, occluded) == 16);
static_assert(offsetof(shaftcull_sight_counts, facing_away) == 24);

static_assert(sizeof(shaftcull_pair_block) == 20);

static_assert(offsetof(shaftcull_sight_batch, product_count) == 8);
static_assert(offsetof(shaftcull_sight_batch, undecided) == 16);
static_assert(sizeof(shaftcull_undecided_pairs) == 24);
static_assert(offsetof(shaftcull_undecided_pairs, count) == 8);
static_assert(offsetof(shaftcull_undecided_pairs, first_candidate) == 16);
static_assert(offsetof(shaftcull_undecided_pairs, candidates) == 20);

}  // namespace
