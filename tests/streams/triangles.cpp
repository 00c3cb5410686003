// SPDX-License-Identifier: MIT
/// Streams of triangles: what is packed into them, and what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <set>
#include <utility>
#include <vector>

#include "caught.hpp"
#include "columns.hpp"
#include "message_of.hpp"
#include "oracle/cases/triangles.hpp"
#include "shaftcull/triangles.hpp"
#include "special_floats.hpp"

namespace shaftcull {
namespace {

using testing::HasSubstr;

std::vector<Triangle> some_triangles(std::size_t count) {
  Random random(850);
  std::vector<Triangle> triangles;
  while (triangles.size() != count) triangles.push_back(grid_triangle(random, -99, 99));
  return triangles;
}

std::vector<Triangle> contents(const TriangleView& view) {
  std::vector<Triangle> triangles;
  for (std::size_t i = 0; i != view.count; ++i) triangles.push_back(view[i]);
  return triangles;
}

TEST(TriangleStreams, HoldWhatWasPacked) {
  for (const std::size_t count : {0U, 1U, 63U, 64U, 65U, 200U}) {
    const std::vector<Triangle> triangles = some_triangles(count);
    const TriangleStream stream{std::span<const Triangle>(triangles)};
    EXPECT_EQ(stream.size(), count);
    EXPECT_EQ(contents(stream), triangles);
    EXPECT_EQ(contents(TriangleStream(stream.view())), triangles);
    EXPECT_EQ(stream.memory_bytes(), count == 0 ? 0 : (bit_words(count) | 1U) * 64 * 36);
    if (count != 0) {
      EXPECT_EQ(stream[count - 1], triangles[count - 1]);
      EXPECT_EQ(contents(stream.view().slice(count / 2, count - count / 2)),
                std::vector<Triangle>(triangles.begin() + static_cast<int>(count / 2), triangles.end()));
    }
    for (const float* row : stream.view().stream) {
      EXPECT_EQ(reinterpret_cast<std::uintptr_t>(row) % 64, 0U);
    }
  }
}

TEST(TriangleStreams, HaveNoTwoRowsAtTheSamePlaceOfAPage) {
  for (const std::size_t count : {1U, 64U, 512U, 1024U, 2048U, 4096U}) {
    const TriangleStream stream(count);
    std::set<std::uintptr_t> places;
    for (const float* row : stream.view().stream) places.insert(reinterpret_cast<std::uintptr_t>(row) % 4096);
    EXPECT_EQ(places.size(), stream.view().stream.size()) << count;
    EXPECT_LE(stream.memory_bytes(), (count + 127) * sizeof(Triangle)) << count;
  }
}

TEST(TriangleStreams, AreCopiedMovedAndUpdated) {
  const std::vector<Triangle> triangles = some_triangles(100);
  TriangleStream stream{std::span<const Triangle>(triangles)};
  const TriangleStream copy = stream;
  const std::vector<Triangle> others(30, Triangle{{{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}}});
  stream.update(50, others);
  std::vector<Triangle> expected = triangles;
  std::copy(others.begin(), others.end(), expected.begin() + 50);
  EXPECT_EQ(contents(stream), expected);
  EXPECT_EQ(contents(copy), triangles);
  stream.update(70, copy.view().slice(70, 10));
  std::copy_n(triangles.begin() + 70, 10, expected.begin() + 70);
  EXPECT_EQ(contents(stream), expected);
  TriangleStream moved = std::move(stream);
  EXPECT_EQ(contents(moved), expected);
  stream = std::move(moved);
  EXPECT_EQ(contents(stream), expected);
}

TEST(TriangleStreams, OfACountHoldEmptyTrianglesThatNoShaftKeeps) {
  const TriangleStream stream(70);
  const CompiledShaft shaft = compile(Box{{-9, -9, -9}, {9, 9, 9}}, Box{{-9, -9, -9}, {99, 9, 9}});
  EXPECT_EQ(count(shaft, stream, {.triangle_test = TriangleTest::vertices}), 0U);
  EXPECT_EQ(count(shaft, stream, {.triangle_test = TriangleTest::exact}), 0U);
}

TEST(TriangleStreams, AMeshIsReadAtAnyStrideAndAlignment) {
  const std::vector<Triangle> triangles = some_triangles(20);
  constexpr std::size_t stride = 17;
  std::vector<std::byte> memory(1 + 60 * stride);
  std::vector<std::uint32_t> indices;
  for (std::size_t v = 0; v != 60; ++v) {
    std::memcpy(&memory[1 + v * stride], triangles[v / 3].vertex[v % 3].data(), sizeof(Vec3));
    indices.push_back(static_cast<std::uint32_t>(v));
  }
  EXPECT_EQ(contents(TriangleStream(MeshView{&memory[1], stride, 60, indices})), triangles);
  std::vector<Vec3> vertices;
  for (const Triangle& triangle : triangles)
    vertices.insert(vertices.end(), triangle.vertex.begin(), triangle.vertex.end());
  TriangleStream stream(20);
  stream.update(0, mesh_view(vertices, indices));
  EXPECT_EQ(contents(stream), triangles);
  EXPECT_EQ(TriangleStream(mesh_view({}, {})).size(), 0U);
}

TEST(TriangleStreams, RefuseWhatTheyCannotPack) {
  const std::vector<Triangle> triangles = some_triangles(10);
  TriangleStream stream{std::span<const Triangle>(triangles)};
  std::vector<Triangle> bad = triangles;
  bad[7].vertex[1][2] = infinity;
  const auto error = caught<BadBound>([&] { stream.update(0, bad); });
  ASSERT_TRUE(error);
  EXPECT_EQ(error->index(), 7U);
  EXPECT_STREQ(error->what(), "triangle 7: vertex 1 has z = inf; vertices must be finite");
  EXPECT_THAT(message_of([&] { stream.update(5, triangles); }),
              HasSubstr("update of 10 triangles from position 5 on does not fit a stream of 10"));
  EXPECT_THAT(message_of([&] { stream.update(0, stream.view()); }), HasSubstr("share memory"));
  EXPECT_THAT(message_of([&] { stream.update(0, std::span<const Triangle>(static_cast<Triangle*>(nullptr), 2)); }),
              HasSubstr("triangles is null"));
  TriangleView view = stream.view();
  view.stream[4] = nullptr;
  EXPECT_THAT(message_of([&] { (void)TriangleStream(view); }), HasSubstr("triangles.stream[4] is null"));

  const std::vector<Vec3> vertices(4);
  std::vector<std::uint32_t> indices = {0, 1, 2, 3, 4, 0};
  EXPECT_THAT(message_of([&] { stream.update(0, mesh_view(vertices, indices)); }),
              HasSubstr("MeshView::indices[4] = 4 is not below the number of vertices, 4"));
  indices.pop_back();
  EXPECT_THAT(message_of([&] { stream.update(0, mesh_view(vertices, indices)); }),
              HasSubstr("MeshView::indices has 5 indices, which is not a multiple of three"));
  EXPECT_THAT(message_of([&] {
                stream.update(0, MeshView{nullptr, 12, 4, std::span(indices).first(3)});
              }),
              HasSubstr("MeshView::vertices is null"));
  EXPECT_THAT(message_of([&] {
                stream.update(0, MeshView{vertices.data(), 12, 4, {static_cast<std::uint32_t*>(nullptr), 3}});
              }),
              HasSubstr("MeshView::indices is null"));
  EXPECT_EQ(contents(stream), triangles);
}

}  // namespace
}  // namespace shaftcull
