// SPDX-License-Identifier: MIT
/// View factors of all pairs: published values, sums of closed rooms, and what is promised of the matrix.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <numbers>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "caught.hpp"
#include "instruction_sets.hpp"
#include "message_of.hpp"
#include "shaftcull/shaftcull.hpp"
#include "view_factors/radiating_scene.hpp"

#if defined(SHAFTCULL_WITH_TBB) && SHAFTCULL_WITH_TBB
#include <oneapi/tbb/task_arena.h>
#endif

namespace shaftcull {
namespace {

using testing::HasSubstr;

/// Twice the area of a polygon is the length of this sum.
double area_of(const std::vector<Vec3>& corners) {
  double normal[3] = {};
  for (std::size_t c = 2; c < corners.size(); ++c) {
    for (std::size_t k = 0; k != 3; ++k) {
      const std::size_t i = (k + 1) % 3;
      const std::size_t j = (k + 2) % 3;
      normal[k] += (double{corners[c - 1][i]} - corners[0][i]) * (double{corners[c][j]} - corners[0][j]) -
                   (double{corners[c - 1][j]} - corners[0][j]) * (double{corners[c][i]} - corners[0][i]);
    }
  }
  return std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]) / 2;
}

void expect_same(const ViewFactors& found, const ViewFactors& right) {
  EXPECT_EQ(found.first, right.first);
  EXPECT_EQ(found.column, right.column);
  EXPECT_EQ(found.factor, right.factor);
  EXPECT_EQ(found.sum, right.sum);
  EXPECT_EQ(found.error, right.error);
  EXPECT_EQ(found.left_out, right.left_out);
  EXPECT_EQ(found.counts, right.counts);
}

TEST(ViewFactors, OfACubeAreThePublishedOnes) {
  RadiatingScene cube;
  cube.add_box({{0, 0, 0}, {1, 1, 1}}, 1, true);
  const ViewFactors factors = view_factors(cube.patches(), {});
  ASSERT_EQ(factors.size(), 6U);
  EXPECT_EQ(factors.counts.clear, 15U);
  for (std::size_t i = 0; i != 6; ++i) {
    EXPECT_NEAR(factors.sum[i], 1, 1e-9);
    EXPECT_EQ(factors.error[i], 0);
    EXPECT_EQ(factors.area[i], 1);
    for (std::size_t j = 0; j != 6; ++j) {
      // J. R. Howell's catalogue, C-11 and C-14.
      const double right = i == j ? 0 : i / 2 == j / 2 ? 0.19982490 : 0.20004378;
      EXPECT_NEAR(factors(i, j), right, 1e-8) << i << ", " << j;
    }
  }
}

// A cube in a cube: the inner one sees nothing but the outer one, and what both exchange is the inner one's area.
TEST(ViewFactors, OfACubeInACubeAreThoseOfConvexBodies) {
  RadiatingScene scene;
  scene.add_box({{-1, -1, -1}, {1, 1, 1}}, 1, false);
  scene.add_box({{-3, -3, -3}, {3, 3, 3}}, 4, true);
  const ViewFactors factors = view_factors(scene.patches(), scene.occluders());
  EXPECT_GT(factors.counts.undecided, 0U);
  double arriving = 0;
  double outer_area = 0;
  for (std::size_t i = 0; i != scene.size(); ++i) {
    EXPECT_NEAR(factors.sum[i], 1, 4e-3) << i;
    EXPECT_LE(std::fabs(factors.sum[i] - 1), 6 * factors.error[i] + 1e-6) << i;
    if (i < 6) {
      for (std::size_t j = 0; j != 6; ++j) EXPECT_EQ(factors(i, j), 0);
      continue;
    }
    outer_area += factors.area[i];
    for (std::size_t j = 0; j != 6; ++j) arriving += factors.area[i] * factors(i, j);
  }
  EXPECT_NEAR(arriving / outer_area, 24.0 / 216, 1e-4);
}

// A square hides half as large a one behind it, in part.
TEST(ViewFactors, OfSquaresWithASquareBetweenAreThatOfTheDefinition) {
  RadiatingScene scene;
  scene.add({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  scene.add({0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1});
  Occluders between;
  between.add_polygons(
      std::vector<Vec3>{{0.25F, 0.25F, 0.5F}, {0.75F, 0.25F, 0.5F}, {0.75F, 0.75F, 0.5F}, {0.25F, 0.75F, 0.5F}},
      std::vector<std::size_t>{0, 4});
  constexpr int n = 48;
  double sum = 0;
  for (int i = 0; i != n * n; ++i) {
    for (int j = 0; j != n * n; ++j) {
      const auto middle = [](int number) { return (number + 0.5) / n; };
      const int rows[2] = {i / n, j / n};
      const double p[2] = {middle(i % n), middle(rows[0])};
      const double q[2] = {middle(j % n), middle(rows[1])};
      const double x = q[0] - p[0];
      const double y = q[1] - p[1];
      // What passes through an edge of the square in between counts half.
      const auto hidden = [](double off) { return off < 0.25 - 1e-9 ? 1.0 : off < 0.25 + 1e-9 ? 0.5 : 0.0; };
      const double seen = 1 - hidden(std::fabs(p[0] + x / 2 - 0.5)) * hidden(std::fabs(p[1] + y / 2 - 0.5));
      sum += seen / ((x * x + y * y + 1) * (x * x + y * y + 1));
    }
  }
  const double right = sum / (std::numbers::pi * n * n * n * n);
  ViewFactorOptions many;
  many.error = 0;
  const ViewFactors factors = view_factors(scene.patches(), between, many);
  ASSERT_EQ(factors.counts.undecided, 1U);
  EXPECT_NEAR(factors(0, 1), right, 1e-3);
  EXPECT_LE(std::fabs(factors(0, 1) - right), 6 * factors.error[0] + 2e-4);
  EXPECT_EQ(factors(0, 1), factors(1, 0));
}

// The room of G. Pinney and D. Bean (1986) has this shape: one wall sees another past a corner. From a point of it,
// what is seen is a rectangle, so the definition is a sum over smooth parts.
TEST(ViewFactors, OfAnLShapedRoomAreThatOfTheDefinition) {
  constexpr float side = 4;
  constexpr float corner = 2.5F;
  constexpr float height = 3;
  RadiatingScene room;
  const auto add_wall = [&](float x, float y, float to_x, float to_y) {
    room.add({x, y, 0}, {x, y, height}, {to_x, to_y, height}, {to_x, to_y, 0});
  };
  add_wall(side, 0, side, corner);
  add_wall(corner, side, 0, side);
  add_wall(0, 0, side, 0);
  add_wall(side, corner, corner, corner);
  add_wall(corner, corner, corner, side);
  add_wall(0, side, 0, 0);
  for (const Box& part : {Box{{0, 0, 0}, {side, corner, height}}, Box{{0, corner, 0}, {corner, side, height}}}) {
    const auto at = [&](bool far_x, bool far_y, float z) {
      return Vec3{far_x ? part.hi[0] : part.lo[0], far_y ? part.hi[1] : part.lo[1], z};
    };
    room.add(at(false, false, 0), at(true, false, 0), at(true, true, 0), at(false, true, 0));
    room.add(at(false, false, height), at(false, true, height), at(true, true, height), at(true, false, height));
  }
  constexpr int n = 40;
  double sum = 0;
  for (int i = 0; i != n; ++i) {
    const double y = (i + 0.5) * corner / n;
    const double width = std::max(0.0, side - (side - corner) * (side - y) / (corner - y));
    for (int j = 0; j != n; ++j) {
      const double x = (j + 0.5) * width / n;
      const double square = (side - x) * (side - x) + (side - y) * (side - y);
      for (int between = -n + 1; between != n; ++between) {  // so many heights are apart
        const double z = between * double{height} / n;
        const double share = (n - std::abs(between)) * double{height} * height / (double{n} * n);
        sum += share * (side - x) * (side - y) / ((square + z * z) * (square + z * z)) * (width / n) * (corner / n);
      }
    }
  }
  const double right = sum / (std::numbers::pi * corner * height);
  const ViewFactors factors = view_factors(room.patches(), room.occluders());
  EXPECT_GT(right, 0.005);
  EXPECT_NEAR(factors(0, 1), right, 6 * factors.error[0] + 1e-4);
  EXPECT_NEAR(factors(0, 1), right, 5e-4);
  EXPECT_LT(factors(0, 1), view_factor(room.patch(0), room.patch(1)) / 2);
  EXPECT_EQ(factors(0, 4), 0);  // it faces away from the corner's other side
  for (std::size_t i = 0; i != room.size(); ++i) {
    EXPECT_NEAR(factors.sum[i], 1, 6 * factors.error[i] + 1e-6) << i;
    EXPECT_NEAR(factors.sum[i], 1, 2e-3) << i;
  }
}

TEST(ViewFactors, SumToOneInAFurnishedRoom) {
  const RadiatingScene room = furnished_room(3);
  const ViewFactors factors = view_factors(room.patches(), room.occluders());
  double squares = 0;
  double expected = 0;
  for (std::size_t i = 0; i != room.size(); ++i) {
    if (factors.first[i] == factors.first[i + 1]) continue;  // on the floor, under a box
    const bool is_of_floor = room.patch(i)[0][2] == 0 && room.patch(i)[2][2] == 0;
    if (is_of_floor) continue;  // parts of these may be under a box
    EXPECT_NEAR(factors.sum[i], 1, 5e-3) << i;
    squares += (factors.sum[i] - 1) * (factors.sum[i] - 1);
    expected += factors.error[i] * factors.error[i];
  }
  // Estimated errors are what errors are, within a factor.
  EXPECT_LT(squares, 9 * expected);
  EXPECT_GT(squares, expected / 100);
}

TEST(ViewFactors, AreThoseOfPairsOrLess) {
  const RadiatingScene room = furnished_room(1);
  const PatchSet patches = room.patches();
  const Occluders occluders = room.occluders();
  const ViewFactors factors = view_factors(patches, occluders);
  std::vector<Sight> sights(room.size() * room.size(), Sight::facing_away);
  const Visibility all = collect_visibility(patches, occluders);
  const auto note = [&](std::uint32_t i, std::uint32_t j, Sight sight) {
    sights[i * room.size() + j] = sights[j * room.size() + i] = sight;
  };
  for (const PairBlock& block : all.blocks) {
    for (const std::uint32_t i : patches.order().subspan(block.a.first, block.a.count)) {
      for (const std::uint32_t j : patches.order().subspan(block.b.first, block.b.count)) note(i, j, block.sight);
    }
  }
  for (const PatchPair& pair : all.undecided) note(pair.a, pair.b, Sight::undecided);
  std::size_t partly = 0;
  for (std::size_t i = 0; i != room.size(); ++i) {
    for (std::size_t j = 0; j != room.size(); ++j) {
      const Sight sight = sights[i * room.size() + j];
      if (i == j || sight == Sight::facing_away || sight == Sight::occluded) {
        EXPECT_EQ(factors(i, j), 0) << i << ", " << j;
        continue;
      }
      const double most = view_factor(room.patch(i), room.patch(j));
      EXPECT_LE(factors(i, j), most * (1 + 1e-6) + 1e-11);
      if (sight == Sight::clear) {
        EXPECT_NEAR(factors(i, j), most, 1e-6 * most + 1e-11);
      }
      if (sight == Sight::undecided && factors(i, j) > 0 && factors(i, j) < 0.99 * most) ++partly;
      EXPECT_NEAR(factors.area[i] * factors(i, j), factors.area[j] * factors(j, i), 1e-15 * factors.area[i]);
    }
    EXPECT_NEAR(factors.area[i], area_of(room.patch(i)), 1e-12 * factors.area[i]);
  }
  EXPECT_GT(partly, 20U);
}

TEST(ViewFactors, AreRowsInOrder) {
  const RadiatingScene room = furnished_room(1);
  const ViewFactors factors = view_factors(room.patches(), room.occluders());
  ASSERT_EQ(factors.first.size(), room.size() + 1);
  ASSERT_EQ(factors.first.back(), factors.column.size());
  ASSERT_EQ(factors.column.size(), factors.factor.size());
  for (std::size_t i = 0; i != room.size(); ++i) {
    double sum = 0;
    for (std::size_t k = factors.first[i]; k != factors.first[i + 1]; ++k) {
      if (k != factors.first[i]) {
        EXPECT_LT(factors.column[k - 1], factors.column[k]);
      }
      EXPECT_GT(factors.factor[k], 0);
      EXPECT_EQ(factors(i, factors.column[k]), factors.factor[k]);
      EXPECT_GT(factors(factors.column[k], i), 0);
      sum += factors.factor[k];
    }
    EXPECT_EQ(factors.sum[i], sum);
  }
  EXPECT_EQ(factors(0, 0), 0);
}

TEST(ViewFactors, AreTheSameBitsOnEveryInstructionSetAndForAnyMemory) {
  const RadiatingScene room = furnished_room(1);
  const PatchSet patches = room.patches();
  const Occluders occluders = room.occluders();
  const ViewFactors right = view_factors(patches, occluders);
  EXPECT_GT(right.counts.undecided, 200U);
  on_each_instruction_set([&] {
    expect_same(view_factors(patches, occluders), right);
    ViewFactorOptions little;
    little.memory = std::size_t{1} << 20U;
    expect_same(view_factors(patches, occluders, little), right);
  });
#if defined(SHAFTCULL_WITH_TBB) && SHAFTCULL_WITH_TBB
  for (const int threads : {1, 3}) {
    tbb::task_arena arena(threads);
    arena.execute([&] { expect_same(view_factors(patches, occluders), right); });
  }
#endif
}

TEST(ViewFactors, BookWhatIsLeftOut) {
  const RadiatingScene room = furnished_room(1);
  const PatchSet patches = room.patches();
  const Occluders occluders = room.occluders();
  const ViewFactors all = view_factors(patches, occluders);
  ViewFactorOptions fewer;
  fewer.least = 0.01;
  const ViewFactors some = view_factors(patches, occluders, fewer);
  EXPECT_EQ(some.sum, all.sum);
  EXPECT_LT(some.factor.size(), all.factor.size());
  for (std::size_t i = 0; i != room.size(); ++i) {
    double sum = some.left_out[i];
    for (std::size_t j = 0; j != room.size(); ++j) {
      const bool is_small = std::max(all(i, j), all(j, i)) < fewer.least;
      EXPECT_EQ(some(i, j), is_small ? 0 : all(i, j));
      sum += some(i, j);
    }
    EXPECT_NEAR(sum, all.sum[i], 1e-14);
  }
}

// Few rays face where most of a patch is behind the other one: they are cast until enough are known.
TEST(ViewFactors, OfPatchesThatHardlyFaceAreNotForgotten) {
  RadiatingScene scene;
  scene.add({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  scene.add({0, 0, -6}, {0, 1, -6}, {0, 1, 0.06F}, {0, 0, 0.06F});  // a wall, 1 % of it above the floor
  Occluders between;
  between.add_polygons(std::vector<Vec3>{{0.3F, 0.9F, 0}, {0.3F, 1.5F, 0}, {0.3F, 1.5F, 0.05F}, {0.3F, 0.9F, 0.05F}},
                       std::vector<std::size_t>{0, 4});
  const ViewFactors factors = view_factors(scene.patches(), between);
  ASSERT_EQ(factors.counts.undecided, 1U);
  const double most = view_factor(scene.patch(0), scene.patch(1));
  EXPECT_GT(most, 0.01);
  EXPECT_GT(factors(0, 1), 0.5 * most);
  EXPECT_LE(factors(0, 1), most);
  EXPECT_GT(factors.error[0], 0);
}

TEST(ViewFactors, OfAnEnclosureCanBeClosed) {
  RadiatingScene room;
  room.add_box({{0, 0, 0}, {4, 4, 4}}, 3, true);
  room.add_box({{1, 1, 1}, {2, 2, 2}}, 1, false);
  const PatchSet patches = room.patches();
  const Occluders occluders = room.occluders();
  const ViewFactors open = view_factors(patches, occluders);
  ViewFactorOptions options;
  options.close_rows = true;
  const ViewFactors closed = view_factors(patches, occluders, options);
  EXPECT_EQ(closed.first, open.first);
  EXPECT_EQ(closed.column, open.column);
  bool was_open = false;
  for (std::size_t i = 0; i != room.size(); ++i) {
    EXPECT_NEAR(closed.sum[i], 1, 1e-11);
    was_open = was_open || std::fabs(open.sum[i] - 1) > 1e-6;
    for (std::size_t j = 0; j != room.size(); ++j) {
      EXPECT_NEAR(closed(i, j), open(i, j), 0.01 * open(i, j));
      EXPECT_NEAR(closed.area[i] * closed(i, j), closed.area[j] * closed(j, i), 1e-14);
    }
  }
  EXPECT_TRUE(was_open);
  RadiatingScene two;
  two.add({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  two.add({0, 0, 1}, {0, 1, 1}, {1, 1, 1}, {1, 0, 1});
  EXPECT_EQ(message_of([&] { static_cast<void>(view_factors(two.patches(), {}, options)); }),
            "rows cannot be closed: the factors of patch 0 sum to 0.199825, and in an enclosure they sum to about 1");
}

/// A room with things in it, some of which are nearly closed off.
RadiatingScene crowded_room() {
  RadiatingScene room;
  room.add_box({{0, 0, 0}, {4, 4, 4}}, 9, true);
  room.add_box({{1, 1, 1}, {2, 2, 2}}, 3, false);
  room.add_box({{2.5F, 1, 0.5F}, {3, 3.5F, 2}}, 3, false);
  return room;
}

std::vector<ViewFactors> factors_in_parts(const PatchSet& patches, const Occluders& occluders,
                                          ViewFactorOptions options, std::uint32_t parts) {
  std::vector<ViewFactors> of_parts;
  for (options.part = 0, options.parts = parts; options.part != parts; ++options.part) {
    of_parts.push_back(view_factors(patches, occluders, options));
  }
  return of_parts;
}

TEST(ViewFactors, OfPartsAreThoseOfTheWhole) {
  const RadiatingScene room = crowded_room();
  const PatchSet patches = room.patches();
  const Occluders occluders = room.occluders();
  ViewFactorOptions options;
  options.rays = 64;
  options.seed = 7;
  const ViewFactors whole = view_factors(patches, occluders, options);
  ASSERT_GT(whole.counts.undecided, 1000U);
  for (const std::uint32_t parts : {1U, 2U, 5U, 40U}) {
    std::vector<ViewFactors> of_parts = factors_in_parts(patches, occluders, options, parts);
    EXPECT_EQ(of_parts[0].factor.size() < whole.factor.size(), parts > 1);
    std::reverse(of_parts.begin(), of_parts.end());
    const ViewFactors joined = join_view_factors(of_parts);
    EXPECT_EQ(joined.first, whole.first);
    EXPECT_EQ(joined.column, whole.column);
    EXPECT_EQ(joined.factor, whole.factor);
    EXPECT_EQ(joined.area, whole.area);
    EXPECT_EQ(joined.sum, whole.sum);
    EXPECT_EQ(joined.left_out, whole.left_out);
    EXPECT_EQ(joined.counts.total(), whole.counts.total());
    EXPECT_EQ(joined.counts.clear, whole.counts.clear);
    EXPECT_EQ(joined.counts.undecided, whole.counts.undecided);
    for (std::size_t i = 0; i != room.size(); ++i) EXPECT_NEAR(joined.error[i], whole.error[i], 1e-15) << i;
  }
}

TEST(ViewFactors, OfPartsCanBeClosedAndLeaveOutSmallOnes) {
  const RadiatingScene room = crowded_room();
  const PatchSet patches = room.patches();
  const Occluders occluders = room.occluders();
  ViewFactorOptions options;
  options.rays = 256;
  for (const double least : {0.0, 1e-4}) {
    options.least = least;
    options.close_rows = false;
    const ViewFactors joined = join_view_factors(factors_in_parts(patches, occluders, options, 9), true);
    options.close_rows = true;
    const ViewFactors whole = view_factors(patches, occluders, options);
    EXPECT_EQ(joined.first, whole.first);
    EXPECT_EQ(joined.column, whole.column);
    double left_out = 0;
    for (std::size_t i = 0; i != room.size(); ++i) {
      EXPECT_NEAR(joined.sum[i], 1, 1e-11);
      EXPECT_NEAR(whole.sum[i], 1, 1e-11);
      EXPECT_NEAR(joined.left_out[i], whole.left_out[i], 1e-12);
      left_out += whole.left_out[i];
    }
    EXPECT_EQ(left_out > 0, least > 0);
    for (std::size_t k = 0; k != whole.factor.size(); ++k) {
      EXPECT_NEAR(joined.factor[k], whole.factor[k], 1e-12 * whole.factor[k]) << k;
    }
  }
}

TEST(ViewFactors, OfPartsThatDoNotBelongTogetherAreRefused) {
  const RadiatingScene room = crowded_room();
  ViewFactorOptions options;
  options.rays = 16;
  std::vector<ViewFactors> parts = factors_in_parts(room.patches(), room.occluders(), options, 2);
  const auto message = [&] { return message_of([&] { static_cast<void>(join_view_factors(parts)); }); };
  const std::string not_a_matrix =
      "parts[2] is not a matrix of view_factors(): arrays do not fit each other, or a number is not finite or below 0";
  parts.push_back(parts[1]);
  EXPECT_THAT(message(), testing::MatchesRegex(
                             "two parts have the factor from patch [0-9]+ to patch [0-9]+; each pair is in one part"));
  parts[2].area[5] *= 2;
  EXPECT_EQ(message(), "parts[2] has patches with other areas than parts[0]; all parts are of one set of patches");
  const ViewFactors taken = std::move(parts[2]);
  EXPECT_EQ(message(), not_a_matrix);
  parts[2] = taken;
  parts[2].column.back() = static_cast<std::uint32_t>(room.size());
  EXPECT_EQ(message(), not_a_matrix);
  parts[2] = taken;
  std::swap(parts[2].column[0], parts[2].column[1]);
  EXPECT_EQ(message(), not_a_matrix);
  for (const double wrong : {-1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    for (auto of_part : {&ViewFactors::factor, &ViewFactors::area, &ViewFactors::sum, &ViewFactors::left_out}) {
      parts[2] = taken;
      (parts[2].*of_part)[0] = wrong;
      EXPECT_EQ(message(), not_a_matrix);
    }
  }
  parts[2] = ViewFactors{};
  EXPECT_EQ(message(), "parts[2] has 0 rows, and parts[0] has " + std::to_string(room.size()) +
                           "; all parts are of one set of patches");
  EXPECT_EQ(join_view_factors({}).size(), 0U);
  options.part = 1;
  EXPECT_EQ(message_of([&] { static_cast<void>(view_factors(room.patches(), {}, options)); }),
            "part is 1; of 1 part, it is 0");
  options.parts = 2;
  options.close_rows = true;
  EXPECT_EQ(message_of([&] { static_cast<void>(view_factors(room.patches(), {}, options)); }),
            "close_rows takes all pairs, and parts is 2; in C++, join_view_factors() closes the rows of all parts");
}

TEST(ViewFactors, OfNothingAreNone) {
  const ViewFactors none = view_factors({}, {});
  EXPECT_EQ(none.size(), 0U);
  EXPECT_TRUE(none.factor.empty());
  RadiatingScene one;
  one.add({0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0});
  const ViewFactors alone = view_factors(one.patches(), {});
  EXPECT_EQ(alone.size(), 1U);
  EXPECT_EQ(alone.sum[0], 0);
  // A patch without an area radiates nothing.
  one.add({0, 0, 1}, {0, 0, 1}, {1, 1, 1}, {1, 1, 1});
  const ViewFactors flat = view_factors(one.patches(), {});
  EXPECT_EQ(flat.area[1], 0);
  EXPECT_TRUE(flat.factor.empty());
}

TEST(ViewFactors, OfBoxesWithPlanesAreThoseOfTheirRectangles) {
  const std::vector<Box> boxes{{{0, 0, 0}, {1, 1, 0}}, {{0, 0, 1}, {1, 1, 1}}, {{0, 0, 0}, {0, 1, 1}}};
  const std::vector<Plane> planes{{{0, 0, 1}, 0}, {{0, 0, -1}, -1}, {{1, 0, 0}, 0}};
  const ViewFactors factors = view_factors(PatchSet(boxes, planes), {});
  EXPECT_NEAR(factors(0, 1), 0.19982490, 1e-8);
  EXPECT_NEAR(factors(0, 2), 0.20004378, 1e-8);
  EXPECT_NEAR(factors(2, 1), 0.20004378, 1e-8);
}

TEST(ViewFactors, StopWhereTheirProgressSaysSo) {
  const RadiatingScene room = furnished_room(1);
  ViewFactorOptions options;
  std::uint64_t last = 0;
  std::uint64_t total = 0;
  options.progress = [&](const VisibilityProgress& now) {
    last = now.done;
    total = now.total;
    return true;
  };
  static_cast<void>(view_factors(room.patches(), room.occluders(), options));
  EXPECT_EQ(last, total);
  EXPECT_EQ(total, room.size() * (room.size() - 1) / 2);
  options.progress = [](const VisibilityProgress&) { return false; };
  EXPECT_THROW(static_cast<void>(view_factors(room.patches(), room.occluders(), options)), Cancelled);
}

TEST(ViewFactors, RefuseWhatTheyCannotBeOf) {
  const std::vector<Vec3> corners{{0, 0, 0}, {1, 0, 0}, {0, 1, 0.5F}};
  const std::vector<std::size_t> first{0, 3};
  const auto refused = [&](const PatchSet& patches, const ViewFactorOptions& options = {}) {
    return message_of([&] { static_cast<void>(view_factors(patches, {}, options)); });
  };
  EXPECT_THAT(refused(PatchSet(corners, first, PatchSides::both)), HasSubstr("seen from both sides"));
  const Box unit{{0, 0, 0}, {1, 1, 1}};
  EXPECT_THAT(refused(PatchSet(std::vector<Box>{unit})), HasSubstr("patches have no planes"));
  EXPECT_THAT(refused(PatchSet(std::vector<Box>{unit}, std::vector<Plane>{{{0, 0, 1}, 0}})),
              HasSubstr("patch 0 is a box that is not flat"));
  const PatchSet patches(corners, first);
  const auto with = [&](const auto& change) {
    ViewFactorOptions options;
    change(options);
    return refused(patches, options);
  };
  EXPECT_EQ(with([](auto& of) { of.rays = 0; }), "rays is 0; a pair gets 1 to 65536");
  EXPECT_EQ(with([](auto& of) { of.rays = 65537; }), "rays is 65537; a pair gets 1 to 65536");
  EXPECT_THAT(with([](auto& of) { of.error = -1; }), HasSubstr("error is -1"));
  EXPECT_THAT(with([](auto& of) { of.error = std::numeric_limits<double>::quiet_NaN(); }), HasSubstr("error is"));
  EXPECT_THAT(with([](auto& of) { of.least = -1; }), HasSubstr("least is -1"));
  EXPECT_THAT(with([](auto& of) { of.tolerance = -1; }), HasSubstr("tolerance is -1"));
  EXPECT_THAT(with([](auto& of) { of.memory = 1; }), HasSubstr("memory is 1 bytes"));
}

}  // namespace
}  // namespace shaftcull
