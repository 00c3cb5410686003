// SPDX-License-Identifier: MIT
/// Owning streams: what is packed is what was given, for every count, stride and alignment.
#include <gmock/gmock.h>

#include <array>
#include <cfloat>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "caught.hpp"
#include "oracle/random.hpp"
#include "shaftcull/streams.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

std::vector<Box> boxes_of(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Box> boxes;
  while (boxes.size() != count) boxes.push_back(random.box(-5, 5, 0.1F, 2));
  return boxes;
}

std::vector<Sphere> spheres_of(std::size_t count, std::uint64_t seed) {
  Random random(seed);
  std::vector<Sphere> spheres;
  while (spheres.size() != count) spheres.push_back({random.vec3(-5, 5), random.uniform(0, 2)});
  return spheres;
}

template <class Stream>
auto bounds_in(const Stream& stream) {
  std::vector<decltype(stream[0])> bounds;
  for (std::size_t i = 0; i != stream.size(); ++i) bounds.push_back(stream[i]);
  return bounds;
}

const Box empty{{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};

TEST(BoxStream, HoldsWhatWasPackedForEveryCount) {
  for (std::size_t count = 0; count <= 200; ++count) {
    const std::vector<Box> boxes = boxes_of(count, count);
    const BoxStream stream(boxes);
    EXPECT_EQ(stream.size(), count);
    EXPECT_EQ(stream.view().count, count);
    EXPECT_EQ(bounds_in(stream), boxes) << "count " << count;
  }
}

TEST(SphereStream, HoldsWhatWasPackedForEveryCount) {
  for (std::size_t count = 0; count <= 200; ++count) {
    const std::vector<Sphere> spheres = spheres_of(count, count);
    const SphereStream stream(spheres);
    EXPECT_EQ(stream.size(), count);
    EXPECT_EQ(bounds_in(stream), spheres) << "count " << count;
  }
}

TEST(BoxStream, HoldsWhatAViewHolds) {
  const std::vector<Box> boxes = boxes_of(131, 3);
  const BoxStream first(boxes);
  const BoxView view = first;
  EXPECT_EQ(view.stream, first.view().stream);
  EXPECT_EQ(view.count, boxes.size());
  const BoxStream second(view.slice(5, 120));
  EXPECT_EQ(bounds_in(second), std::vector<Box>(boxes.begin() + 5, boxes.begin() + 125));
  EXPECT_NE(second.view().stream[0], view.stream[0] + 5) << "a stream has memory of its own";
  EXPECT_EQ(BoxStream(BoxView()).size(), 0U);
}

TEST(SphereStream, HoldsWhatAViewHolds) {
  const std::vector<Sphere> spheres = spheres_of(131, 4);
  const SphereStream first(spheres);
  const SphereView view = first;
  EXPECT_EQ(view.stream, first.view().stream);
  const SphereStream second(view.slice(7, 100));
  EXPECT_EQ(bounds_in(second), std::vector<Sphere>(spheres.begin() + 7, spheres.begin() + 107));
}

TEST(BoxStream, UpdatesFromAView) {
  const std::vector<Box> boxes = boxes_of(100, 5);
  const BoxStream from(boxes_of(40, 6));
  BoxStream stream(boxes);
  stream.update(60, from);
  EXPECT_EQ(stream[59], boxes[59]);
  for (std::size_t i = 0; i != 40; ++i) EXPECT_EQ(stream[60 + i], from[i]) << i;
}

TEST(BoxStream, ReadsRecordsOfAnyStrideAndAlignment) {
  const std::vector<Box> boxes = boxes_of(70, 1);
  for (const std::size_t stride : {24U, 25U, 27U, 32U, 63U, 64U, 100U}) {
    for (std::size_t offset = 0; offset != 4; ++offset) {
      // Exactly as large as it must be, so that a sanitizer sees every read too far.
      std::vector<std::byte> memory(offset + stride * (boxes.size() - 1) + sizeof(Box));
      for (std::size_t i = 0; i != boxes.size(); ++i) {
        std::memcpy(memory.data() + offset + i * stride, &boxes[i], sizeof(Box));
      }
      const std::byte* const lo = memory.data() + offset;
      const BoxStream stream(StridedBoxes{lo, lo + 12, stride, boxes.size()});
      EXPECT_EQ(bounds_in(stream), boxes) << "stride " << stride << ", offset " << offset;
    }
  }
}

TEST(BoxStream, ReadsCornersThatLieApart) {
  const std::vector<Box> boxes = boxes_of(33, 2);
  std::vector<Vec3> lo;
  std::vector<Vec3> hi;
  for (const Box& box : boxes) {
    lo.push_back(box.lo);
    hi.push_back(box.hi);
  }
  EXPECT_EQ(bounds_in(BoxStream(StridedBoxes{lo.data(), hi.data(), sizeof(Vec3), 33})), boxes);
}

TEST(SphereStream, ReadsRecordsOfAnyStrideAndAlignment) {
  const std::vector<Sphere> spheres = spheres_of(70, 1);
  for (const std::size_t stride : {16U, 17U, 32U, 50U}) {
    std::vector<std::byte> memory(3 + stride * (spheres.size() - 1) + sizeof(Sphere));
    for (std::size_t i = 0; i != spheres.size(); ++i) {
      std::memcpy(memory.data() + 3 + i * stride, &spheres[i], sizeof(Sphere));
    }
    const std::byte* const centre = memory.data() + 3;
    EXPECT_EQ(bounds_in(SphereStream(StridedSpheres{centre, centre + 12, stride, spheres.size()})), spheres);
  }
}

TEST(BoxStream, PacksCentreAndHalfExtentExactlyWhereFloatsAllow) {
  const std::array<float, 6> record = {1, 2, 3, 0.5F, 0, 4};
  const BoxStream stream(StridedCentreExtents{record.data(), record.data() + 3, sizeof record, 1});
  EXPECT_EQ(stream[0], (Box{{0.5F, 2, -1}, {1.5F, 2, 7}}));
}

TEST(BoxStream, RoundsCornersOfCentreAndHalfExtentOutwardsByNoMoreThanItMust) {
  Random random(17);
  for (int i = 0; i != 20000; ++i) {
    // With these exponents sums are exact in long double (64 bits).
    const std::array<float, 6> record = {random.wild(-20, 18),
                                         random.wild(-20, 18),
                                         random.wild(-20, 18),
                                         std::fabs(random.wild(-20, 18)),
                                         std::fabs(random.wild(-20, 18)),
                                         0x1p-20F};
    const Box box = BoxStream(StridedCentreExtents{record.data(), record.data() + 3, sizeof record, 1})[0];
    for (std::size_t k = 0; k != 3; ++k) {
      const long double lo = static_cast<long double>(record[k]) - static_cast<long double>(record[k + 3]);
      const long double hi = static_cast<long double>(record[k]) + static_cast<long double>(record[k + 3]);
      EXPECT_LE(box.lo[k], lo) << "seed 17, box " << i << ", axis " << k;
      EXPECT_GT(std::nextafter(box.lo[k], infinity), lo) << "seed 17, box " << i << ", axis " << k;
      EXPECT_GE(box.hi[k], hi) << "seed 17, box " << i << ", axis " << k;
      EXPECT_LT(std::nextafter(box.hi[k], -infinity), hi) << "seed 17, box " << i << ", axis " << k;
    }
  }
}

TEST(BoxStream, RoundsCornersOutwardsAtTheEndsOfFloatsToo) {
  // Sums of these are exact in long double.
  std::vector<std::array<float, 6>> records;
  for (const float centre : {FLT_MAX, std::nextafter(FLT_MAX, 0.0F), 0x1p127F, 0x1p-149F, 0x1p-126F, 0.0F}) {
    const float unit = centre < 1 ? 0x1p-149F : 0x1p103F;  // half of a step between floats, or the least float
    for (int k = 0; k != 64; ++k) {
      const float half = static_cast<float>(k) * unit;
      records.push_back({centre, -centre, -centre, half, half, 1.5F * half});
    }
  }
  const BoxStream boxes(
      StridedCentreExtents{records[0].data(), records[0].data() + 3, sizeof records[0], records.size()});
  for (std::size_t i = 0; i != records.size(); ++i) {
    for (std::size_t k = 0; k != 3; ++k) {
      const long double lo = static_cast<long double>(records[i][k]) - static_cast<long double>(records[i][k + 3]);
      const long double hi = static_cast<long double>(records[i][k]) + static_cast<long double>(records[i][k + 3]);
      EXPECT_LE(boxes[i].lo[k], lo) << "box " << i << ", axis " << k;
      EXPECT_GT(std::nextafter(boxes[i].lo[k], infinity), lo) << "box " << i << ", axis " << k;
      EXPECT_GE(boxes[i].hi[k], hi) << "box " << i << ", axis " << k;
      EXPECT_LT(std::nextafter(boxes[i].hi[k], -infinity), hi) << "box " << i << ", axis " << k;
    }
  }
}

TEST(BoxStream, PacksCentreAndHalfExtentTheSameOneByOneAndTogether) {
  Random random(18);
  std::vector<std::array<float, 6>> records(23);
  for (std::array<float, 6>& record : records) {
    for (std::size_t k = 0; k != 6; ++k) record[k] = k < 3 ? random.wild() : std::fabs(random.wild());
  }
  const auto pack = [&](std::size_t first, std::size_t count) {
    const float* const record = records[first].data();
    return BoxStream(StridedCentreExtents{record, record + 3, sizeof records[0], count});
  };
  for (std::size_t count = 0; count != records.size(); ++count) {
    const BoxStream together = pack(0, count);
    for (std::size_t i = 0; i != count; ++i) EXPECT_EQ(together[i], pack(i, 1)[0]) << i << " of " << count;
  }
}

TEST(BoxStream, RoundsOutwardsWhereEvenADoubleCannotHoldTheCorner) {
  const std::array<float, 6> record = {1, -1, FLT_MAX, 0x1p-149F, 0x1p-100F, 0x1p-149F};
  const Box box = BoxStream(StridedCentreExtents{record.data(), record.data() + 3, sizeof record, 1})[0];
  EXPECT_EQ(box.lo, (Vec3{std::nextafter(1.0F, 0.0F), std::nextafter(-1.0F, -2.0F), std::nextafter(FLT_MAX, 0.0F)}));
  EXPECT_EQ(box.hi, (Vec3{std::nextafter(1.0F, 2.0F), std::nextafter(-1.0F, 0.0F), infinity}));
}

TEST(BoxStream, TakesAnInfiniteHalfExtentForEverything) {
  const std::array<float, 6> record = {1, -FLT_MAX, 0, infinity, infinity, infinity};
  const Box box = BoxStream(StridedCentreExtents{record.data(), record.data() + 3, sizeof record, 1})[0];
  EXPECT_EQ(box, (Box{{-infinity, -infinity, -infinity}, {infinity, infinity, infinity}}));
}

TEST(BoxStream, TakesInfiniteAndEmptyBoxes) {
  const std::vector<Box> boxes = {
      {{-infinity, 0, -infinity}, {infinity, 1, 3}}, empty, {{infinity, 0, 0}, {infinity, 1, 1}}};
  EXPECT_EQ(bounds_in(BoxStream(boxes)), boxes);
}

TEST(SphereStream, TakesAnInfiniteRadius) {
  const std::vector<Sphere> spheres = {{{1, 2, 3}, infinity}};
  EXPECT_EQ(bounds_in(SphereStream(spheres)), spheres);
}

TEST(Streams, OfACountHoldEmptyBounds) {
  EXPECT_EQ(bounds_in(BoxStream(3)), std::vector<Box>(3, empty));
  EXPECT_EQ(bounds_in(SphereStream(2)), std::vector<Sphere>(2, Sphere{{0, 0, 0}, -1}));
}

TEST(BoxStream, UpdatesARangeInPlaceAndNothingElse) {
  std::vector<Box> boxes = boxes_of(150, 3);
  BoxStream stream(boxes);
  const float* const memory = stream.view().stream[0];
  const std::vector<Box> news = boxes_of(20, 4);
  stream.update(60, news);
  std::copy(news.begin(), news.end(), boxes.begin() + 60);
  EXPECT_EQ(bounds_in(stream), boxes);
  EXPECT_EQ(stream.view().stream[0], memory);
  stream.update(150, std::vector<Box>());
  EXPECT_EQ(bounds_in(stream), boxes);
}

TEST(SphereStream, UpdatesARangeInPlaceAndNothingElse) {
  std::vector<Sphere> spheres = spheres_of(150, 3);
  SphereStream stream(spheres);
  const std::vector<Sphere> news = spheres_of(150, 4);
  stream.update(149, std::span(news).first(1));
  spheres[149] = news[0];
  EXPECT_EQ(bounds_in(stream), spheres);
}

template <class Stream, class Bounds>
void expect_value_semantics(const Bounds& bounds, const Bounds& others) {
  static_assert(std::is_nothrow_move_constructible_v<Stream> && std::is_nothrow_move_assignable_v<Stream>);
  Stream stream(bounds);
  Stream copy(stream);
  copy.update(0, others);
  EXPECT_EQ(bounds_in(stream), bounds);
  copy = stream;
  EXPECT_EQ(bounds_in(copy), bounds);
  const Stream& itself = copy;
  copy = itself;
  EXPECT_EQ(bounds_in(copy), bounds);

  const float* const memory = stream.view().stream[0];
  Stream moved(std::move(stream));
  EXPECT_EQ(moved.view().stream[0], memory);
  EXPECT_EQ(stream.size(), 0U);  // NOLINT(bugprone-use-after-move,clang-analyzer-cplusplus.Move): is empty then
  EXPECT_EQ(stream.memory_bytes(), 0U);
  stream = std::move(moved);
  EXPECT_EQ(bounds_in(stream), bounds);
  EXPECT_EQ(moved.size(), 0U);  // NOLINT(bugprone-use-after-move,clang-analyzer-cplusplus.Move)
  EXPECT_TRUE(bounds_in(moved).empty());
  Stream& same = stream;
  stream = std::move(same);
  EXPECT_EQ(bounds_in(stream), bounds);
  copy = Stream();
  EXPECT_EQ(copy.size(), 0U);
}

TEST(BoxStream, CopiesDeepAndLeavesNothingWhenMovedFrom) {
  expect_value_semantics<BoxStream>(boxes_of(77, 5), boxes_of(77, 6));
}

TEST(SphereStream, CopiesDeepAndLeavesNothingWhenMovedFrom) {
  expect_value_semantics<SphereStream>(spheres_of(77, 5), spheres_of(77, 6));
}

TEST(BoxStream, TakesItsBytesABoundAndAtMost63BoundsOfPadding) {
  for (std::size_t count = 0; count <= 200; ++count) {
    EXPECT_GE(BoxStream(count).memory_bytes(), 24 * count);
    EXPECT_LE(BoxStream(count).memory_bytes(), 24 * (count + 63));
    EXPECT_GE(SphereStream(count).memory_bytes(), 16 * count);
    EXPECT_LE(SphereStream(count).memory_bytes(), 16 * (count + 63));
  }
}

TEST(BoxStream, StartsEveryStreamAtACacheLine) {
  for (const std::size_t count : {1U, 63U, 65U, 1000U}) {
    const BoxStream boxes(count);
    for (const float* stream : boxes.view().stream) EXPECT_EQ(reinterpret_cast<std::uintptr_t>(stream) % 64, 0U);
    const SphereStream spheres(count);
    for (const float* stream : spheres.view().stream) EXPECT_EQ(reinterpret_cast<std::uintptr_t>(stream) % 64, 0U);
  }
}

TEST(BoxStream, OfMoreThanMemoryCanHoldIsRefused) {
  for (const std::size_t count : {SIZE_MAX, SIZE_MAX - 63, SIZE_MAX / 24, SIZE_MAX / 8}) {
    EXPECT_THROW(BoxStream{count}, std::bad_array_new_length) << count;
    EXPECT_THROW(SphereStream{count}, std::bad_array_new_length) << count;
  }
}

}  // namespace
}  // namespace shaftcull
