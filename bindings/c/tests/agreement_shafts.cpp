// SPDX-License-Identifier: MIT
/// Shafts of all kinds, made in both languages.
#include <array>
#include <vector>

#include "agreement.hpp"

namespace shaftcull::agreement {

void make_shafts(Random& random, Shafts& shafts) {
  constexpr std::size_t pairs = 5;
  constexpr std::size_t all = 2 + pairs + 2 + 4 + 4 * 2 + 6;
  shafts.c = made<ShaftsHandle>(shaftcull_shafts_create, std::uint64_t{all});
  shaftcull_shafts* const c = shafts.c.get();
  std::uint64_t next = 0;

  std::vector<Box> a;
  std::vector<Box> b;
  std::vector<Vec3> vectors;
  std::vector<float> floats;
  std::vector<Plane> planes;
  for (std::size_t i = 0; i != pairs; ++i) {
    a.push_back(random.box(-5, -2, 0.1F, 1.0F));
    b.push_back(random.box(2, 5, 0.1F, 1.0F));
    vectors.push_back(random.vec3(1, 6));
    floats.insert(floats.end(), vectors.back().begin(), vectors.back().end());
    const Vec3 normal = random.vec3(-1, 1);
    planes.push_back({normal, random.uniform(1, 4)});
  }
  const std::vector<shaftcull_box> ca = as_c(a);
  const std::vector<shaftcull_box> cb = as_c(b);
  const std::vector<shaftcull_plane> cplanes = as_c(planes);
  const shaftcull_source from = source_of(ca);
  const shaftcull_source to = source_of(cb);
  const auto add = [&](const CompiledShaft& shaft) {
    shafts.cpp.push_back(shaft);
    ++next;
  };

  // Between two boxes.
  ok(set_between(c, next, ca[0], cb[0]));
  add(compile(a[0], b[0]));
  ok(set_between(c, next, ca[1], cb[1], SHAFTCULL_CONTACT_OPEN));
  add(compile(a[1], b[1], Contact::open));
  const BoxStream stream_a{std::span<const Box>(a)};
  const BoxStream stream_b{std::span<const Box>(b)};
  std::vector<CompiledShaft> batch(pairs);
  const auto add_batch = [&] {
    for (const CompiledShaft& shaft : batch) add(shaft);
  };
  const shaftcull_batch_planes batch_planes{cplanes.data(), pairs, nullptr, 0};
  ok(shaftcull_shafts_set_between(c, next, pairs, &from, &to, nullptr, &batch_planes, SHAFTCULL_CONTACT_CLOSED));
  compile_batch(stream_a, stream_b, batch, {.a = planes});
  add_batch();
  const std::vector<shaftcull_index_pair> cpairs{{0, 4}, {3, 1}};
  const std::vector<IndexPair> index_pairs{{0, 4}, {3, 1}};
  ok(shaftcull_shafts_set_between(c, next, 2, &from, &to, cpairs.data(), nullptr, SHAFTCULL_CONTACT_OPEN));
  batch.resize(2);
  compile_batch(stream_a, stream_b, index_pairs, batch, {}, Contact::open);
  add_batch();
  shafts.between = shafts.cpp.size();

  // Moving boxes, one at a time and two at once.
  const float reach = 2.5F;
  const auto at = [](const std::vector<shaftcull_box>& boxes, std::size_t i) { return shaftcull_boxes(&boxes[i], 1); };
  const shaftcull_source first_a = at(ca, 0);
  const shaftcull_source first_b = at(cb, 0);
  const shaftcull_source second_a = at(ca, 1);
  const shaftcull_source second_b = at(cb, 1);
  ok(shaftcull_shafts_set_swept(c, next, 1, &first_a, vectors[0].data(), SHAFTCULL_SWEPT, cplanes.data(), 1));
  add(swept(a[0], vectors[0], std::span(planes).first(1)));
  ok(shaftcull_shafts_set_swept(c, next, 1, &second_a, vectors[1].data(), SHAFTCULL_SWEPT_INFINITE, nullptr, 0));
  add(swept_infinite(a[1], vectors[1]));
  ok(shaftcull_shafts_set_shadow(c, next, 1, &first_a, &first_b, nullptr, nullptr, nullptr));
  add(shadow(a[0], b[0]));
  const shaftcull_batch_planes shadow_planes{cplanes.data(), 2, cplanes.data() + 2, 1};
  ok(shaftcull_shafts_set_shadow(c, next, 1, &second_a, &second_b, nullptr, &reach, &shadow_planes));
  add(shadow(a[1], b[1], reach, std::span(planes).first(3)));
  const shaftcull_source last_a = shaftcull_boxes(&ca[3], 2);
  const shaftcull_source last_b = shaftcull_boxes(&cb[3], 2);
  const BoxStream last_stream_a(std::span<const Box>(a).last(2));
  const BoxStream last_stream_b(std::span<const Box>(b).last(2));
  const std::span<const Vec3> last_vectors = std::span(vectors).last(2);
  const float* const last_floats = &floats[3 * (pairs - 2)];
  ok(shaftcull_shafts_set_swept(c, next, 2, &last_a, last_floats, SHAFTCULL_SWEPT, cplanes.data(), 4));
  swept_batch(last_stream_a, last_vectors, batch, std::span(planes).first(4));
  add_batch();
  ok(shaftcull_shafts_set_swept(c, next, 2, &last_a, last_floats, SHAFTCULL_SWEPT_INFINITE, nullptr, 0));
  swept_infinite_batch(last_stream_a, last_vectors, batch);
  add_batch();
  ok(shaftcull_shafts_set_shadow(c, next, 2, &last_a, &last_b, nullptr, nullptr, nullptr));
  shadow_batch(last_stream_a, last_stream_b, batch);
  add_batch();
  ok(shaftcull_shafts_set_shadow(c, next, 2, &from, &to, cpairs.data(), &reach, nullptr));
  shadow_batch(stream_a, stream_b, index_pairs, reach, batch);
  ok(shaftcull_shafts_set_contact(c, next, 2, SHAFTCULL_CONTACT_OPEN));
  set_contact(batch, Contact::open);
  add_batch();
  shafts.moving = shafts.cpp.size();

  // Hulls. They stay in the array of C when they are freed.
  shafts.hulls.reserve(6);  // shafts refer to them where they are
  std::vector<Vec3> corners;
  std::vector<float> corner_floats;
  for (int i = 0; i != 7; ++i) {
    corners.push_back(random.vec3(-4, 4));
    corner_floats.insert(corner_floats.end(), corners.back().begin(), corners.back().end());
  }
  const float matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.02F, 3, 0, 0, -1, 4};
  const auto add_hull = [&](HullHandle&& hull, ConvexHull&& same) {
    ok(shaftcull_shafts_set_hull(c, next, hull.get()));
    hull.reset();
    shafts.hulls.push_back(std::move(same));
    add(shafts.hulls.back().compiled());
  };
  using None = const float*;
  add_hull(made<HullHandle>(shaftcull_hull_create, corner_floats.data(), std::uint64_t{7}, std::uint64_t{0}, None(),
                            std::uint64_t{0}, std::uint32_t{SHAFTCULL_HULL_EXACT}),
           ConvexHull(corners));
  add_hull(made<HullHandle>(shaftcull_hull_create, corner_floats.data(), std::uint64_t{6}, std::uint64_t{0},
                            &corner_floats[18], std::uint64_t{1}, std::uint32_t{SHAFTCULL_HULL_CONSERVATIVE}),
           ConvexHull(std::span(corners).first(6), std::span(corners).last(1), HullTest::conservative));
  add_hull(made<HullHandle>(shaftcull_hull_create, corner_floats.data(), std::uint64_t{7}, std::uint64_t{3}, None(),
                            std::uint64_t{0}, std::uint32_t{SHAFTCULL_HULL_EXACT}),
           between_polygons(std::span(corners).first(3), std::span(corners).last(4)));
  const HullHandle view =
      made<HullHandle>(shaftcull_hull_of_frustum, &matrix[0], std::uint32_t{SHAFTCULL_DEPTH_MINUS_ONE_TO_ONE},
                       std::uint32_t{SHAFTCULL_HULL_EXACT});
  add_hull(made<HullHandle>(shaftcull_hull_of_frustum, &matrix[0], std::uint32_t{SHAFTCULL_DEPTH_ZERO_TO_ONE},
                            std::uint32_t{SHAFTCULL_HULL_CONSERVATIVE}),
           frustum(matrix, ClipDepth::zero_to_one, HullTest::conservative));
  const ConvexHull same_view = frustum(matrix, ClipDepth::minus_one_to_one);
  const auto light = [&](float w) { return std::array{vectors[3][0], vectors[3][1], vectors[3][2], w}; };
  add_hull(made<HullHandle>(shaftcull_hull_of_casters, view.get(), light(1).data()), casters(same_view, vectors[3]));
  add_hull(made<HullHandle>(shaftcull_hull_of_casters, view.get(), light(0).data()),
           casters_towards(same_view, vectors[3]));
  ASSERT_EQ(next, std::uint64_t{all}) << "the array has as many shafts as were made";

  // Some have their planes already.
  ok(shaftcull_shafts_complete(c, 0, 3));
  for (std::size_t s = 0; s != 3; ++s) complete(shafts.cpp[s]);
}

}  // namespace shaftcull::agreement
