// SPDX-License-Identifier: MIT
/// Calls about what sees what.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "calls/call_table.hpp"
#include "shaftcull/shaftcull.hpp"

namespace shaftcull {

/// What these calls are given.
struct SightWorkload {
  std::vector<Box> boxes;
  std::vector<Plane> planes;
  std::vector<Box> solids;
  std::vector<Vec3> hull;
  PatchSet patches;
  PatchSet others;
  PatchSet facets;  ///< triangles
  Occluders occluders;
};

/// Notes all answers to pairs.
inline void note_visibility(AnswerWords& words, const Visibility& all) {
  for (const PairBlock& block : all.blocks) {
    for (const PatchRun& run : {block.a, block.b}) {
      note(words, run.first);
      note(words, run.count);
    }
    note(words, block.sight);
  }
  for (const PatchPair& pair : all.undecided) {
    note(words, pair.a);
    note(words, pair.b);
  }
  note(words, all.first_candidate);
  note(words, all.candidates);
  note(words, all.counts.total());
}

/// Patches and occluders are the first boxes of the table, and the triangles.
inline void add_visibility_calls(CallTable& table) {
  const auto all = std::make_shared<SightWorkload>();
  const std::size_t count = std::min<std::size_t>(table.boxes.size(), 300);
  all->boxes.assign(table.boxes.begin(), table.boxes.begin() + static_cast<std::ptrdiff_t>(count));
  for (std::size_t i = 0; i != count; ++i) {
    const Box& box = all->boxes[i];
    const Vec3 normals[] = {{1, 0, 1e-40F}, {0, -1, 0}, {1, 2, 0}, {-0.3F, 0.4F, 0.5F}};
    all->planes.push_back({normals[i % 4], i % 4 == 1 ? -box.hi[1] : box.lo[0]});
    if (i % 40 == 0) all->solids.push_back(box);
  }
  all->hull = {{0, 1e-40F, 0}, {2, 1, 0}, {1, 3, 0}, {0, 0, 4}, {2, 1, 4}, {1, 3, 4}};
  all->patches = PatchSet(std::span<const Box>(all->boxes), all->planes);
  all->others = PatchSet(std::span<const Box>(all->boxes).subspan(0, count / 2));
  std::vector<Vec3> corners;
  std::vector<std::size_t> first{0};
  for (std::size_t i = 0; i < count; i += 4) {
    const Box& box = all->boxes[i];
    for (const Vec3& corner : {box.lo, Vec3{box.hi[0], box.lo[1], box.lo[2]}, Vec3{box.lo[0], box.hi[1], box.hi[2]}}) {
      corners.push_back(corner);
    }
    first.push_back(corners.size());
  }
  all->facets = PatchSet(corners, first);
  const auto add_occluders = [all, &triangles = table.triangle_stream](Occluders& to) {
    to.add_boxes(std::span<const Box>(all->boxes).subspan(0, std::min<std::size_t>(all->boxes.size(), 20)));
    to.add_solids(std::span<const Box>(all->solids));
    to.add_solid_hulls(all->hull, std::vector<std::size_t>{0, all->hull.size()});
    to.add_polygons(std::span<const Vec3>(all->hull).subspan(0, 3), std::vector<std::size_t>{0, 3});
    TriangleView few = triangles.view();
    few.count = std::min<std::size_t>(few.count, 100);
    to.add_triangles(few);
  };
  add_occluders(all->occluders);

  table.add("PatchSet", false, [all](AnswerWords& words) {
    const PatchSet set(std::span<const Box>(all->boxes), all->planes);
    note(words, set.order());
  });
  table.add("Occluders", false, [all, add_occluders](AnswerWords& words) {
    Occluders occluders;
    add_occluders(occluders);
    for (std::size_t i = 0; i != occluders.size(); ++i) note(words, occluders.box(i));
  });
  table.add("merged_boxes", false, [all](AnswerWords& words) {
    for (const Box& box : merged_boxes(all->boxes)) note(words, box);
  });
  table.add("find_solids", false, [all, &triangles = table.triangle_stream](AnswerWords& words) {
    TriangleView few = triangles.view();
    few.count = std::min<std::size_t>(few.count, 100);
    const FoundSolids found = find_solids(few, {.least_width = 1e-40F});
    for (const Vec3& corner : found.polygon_corners) note(words, Box{corner, corner});
    Occluders occluders;
    occluders.add_found(found);
    words.push_back(count_visibility(all->patches, occluders).occluded);
  });
  table.add("add_mesh", false, [all, &triangles = table.triangle_stream](AnswerWords& words) {
    TriangleView few = triangles.view();
    few.count = std::min<std::size_t>(few.count, 100);
    Occluders occluders;
    words.push_back(occluders.add_mesh(few, {.region = all->patches.box()}));
    for (std::size_t i = 0; i != occluders.size(); ++i) note(words, occluders.box(i));
    words.push_back(count_visibility(all->patches, occluders).occluded);
  });
  table.add("take_boxes", false, [all, &triangles = table.triangle_stream](AnswerWords& words) {
    FoundSolids found;
    for (const float x : {0.0F, 1.0F}) {
      for (const float y : {0.0F, 2.0F}) {
        for (const float z : {0.0F, 3.0F}) found.hull_corners.push_back({x, y, z});
      }
    }
    found.first_hull_corner.push_back(8);
    const FoundBoxes boxes = take_boxes(found, triangles.view());
    for (const Box& box : boxes.boxes) note(words, box);
    note(words, std::span<const std::uint32_t>(boxes.box_of_triangle));
  });
  table.add("inscribed_box", false, [all](AnswerWords& words) { note(words, inscribed_box(all->hull)); });
  table.add("view_factor", false, [all](AnswerWords& words) {
    const std::span<const Vec3> two_ends(all->hull);
    note(words, view_factor(two_ends.subspan(0, 3), two_ends.subspan(3, 3)));
    note(words, view_factor(two_ends.subspan(3, 3), two_ends.subspan(0, 3)));
  });
  table.add("count_visibility", false, [all](AnswerWords& words) {
    const SightCounts counts = count_visibility(all->patches, all->occluders);
    for (const std::uint64_t n : {counts.undecided, counts.clear, counts.occluded, counts.facing_away})
      words.push_back(n);
    words.push_back(count_visibility(all->patches, all->others, all->occluders).undecided);
  });
  table.add("collect_visibility", false, [all](AnswerWords& words) {
    note_visibility(words, collect_visibility(all->patches, all->occluders));
    VisibilityOptions closed;
    closed.contact = Contact::closed;
    closed.solids_around_ends = false;
    closed.tolerance = 1e-40F;
    note_visibility(words, collect_visibility(all->others, all->patches, all->occluders, closed));
  });
  table.add("visible_fractions", false, [all](AnswerWords& words) {
    const Visibility found = collect_visibility(all->facets, all->occluders);
    std::vector<float> fractions(found.undecided.size());
    visible_fractions(all->facets, all->facets, all->occluders,
                      {found.undecided, found.first_candidate, found.candidates}, fractions);
    for (const float fraction : fractions) note(words, fraction);
  });
  table.add("lit_fractions", false, [all](AnswerWords& words) {
    const std::vector<Vec3> directions{{0, 0, 1}, {1, 2, -1}, {-1, 0, 0.25F}};
    std::vector<float> fractions(all->facets.size() * directions.size());
    lit_fractions(all->facets, all->occluders, directions, fractions);
    for (const float fraction : fractions) note(words, fraction);
  });
  table.add("view_factors", false, [all](AnswerWords& words) {
    const ViewFactors factors = view_factors(all->facets, all->occluders);
    for (const double factor : factors.factor) note(words, factor);
    for (const std::uint32_t column : factors.column) words.push_back(column);
    for (const double error : factors.error) note(words, error);
  });
  table.add("join_view_factors", false, [all](AnswerWords& words) {
    std::vector<ViewFactors> parts;
    for (const std::uint32_t part : {0U, 1U}) {
      ViewFactorOptions options;
      options.part = part;
      options.parts = 2;
      parts.push_back(view_factors(all->facets, all->occluders, options));
    }
    for (const double factor : join_view_factors(parts).factor) note(words, factor);
  });
  table.add("visibility_bits", false, [all](AnswerWords& words) {
    std::vector<std::uint64_t> bits(all->patches.size() * bit_words(all->others.size()));
    visibility_bits(all->patches, all->others, all->occluders, Sight::clear, bits);
    note(words, bits);
  });
}

}  // namespace shaftcull
