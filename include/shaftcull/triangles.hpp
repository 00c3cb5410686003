// SPDX-License-Identifier: MIT
/// Triangles against shafts: single triangles, streams, and trees of chunks of neighbouring triangles.
///
/// The box around a slanted triangle is larger than the triangle, so shafts keep more boxes of triangles than
/// triangles. The queries here test the triangles themselves, in one of two ways (TriangleTest). The test *by vertices*
/// costs little more than a test of the box around a triangle, and pays off where planes were added to a shaft: a
/// triangle is beyond a plane if its vertices are. By the *exact* test, every triangle that has no point in common with
/// the shaft is outside.
///
/// Answers of both tests are exact, the same bits on every instruction set. For all finite floats:
///
/// * `vertices`: outside iff the box around the three vertices is outside the hull that the shaft was made of, as
///   cull() of a box answers without added planes, or all three vertices are beyond one added plane, n · v > d.
/// * `exact`: outside iff the triangle, with its edges and interior, has no point in common with the shaft without
///   added planes, or all three vertices are beyond one added plane. Touching is not outside.
///
/// Triangles may be degenerate: segments and points, with vertices repeated or collinear. Shafts may be flat, and of
/// every kind that boxes are tested with: shafts of moving boxes (volumes.hpp) and convex hulls (hull.hpp), too. By
/// `vertices`, a hull with HullTest::conservative tests boxes around triangles as it tests boxes; `exact` is exact for
/// it, too.
///
/// With open contact (set_contact() in compiled.hpp), a triangle that only touches the shaft is outside. By `vertices`,
/// it is outside if the box around it is outside; by `exact`, if the relative interiors of shaft and triangle have no
/// point in common; by both, if all three vertices are on or beyond one added plane. The relative interior of a
/// triangle is the triangle without its edges; of a segment, the segment without its ends; of a point, the point.
///
/// Values of a raw view are not checked. The box around the vertices ignores NaN coordinates. If all three coordinates
/// of an axis are NaN, the triangle is *empty*, and outside every shaft. A vertex with a coordinate that is not finite
/// is not beyond an added plane whose test reads that coordinate. A triangle with a coordinate that is not finite is
/// answered by vertices, even in the exact test.
///
/// A triangle is inside iff its three vertices are inside, as points, since a shaft is convex. With open contact it
/// must be kept, too. Queries, options and errors are those of all bounds (cull.hpp, many.hpp, query.hpp).
/// first_contact() and occluded() do not take triangles.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/export.hpp"
#include "shaftcull/streams.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// Three vertices, in either orientation.
struct Triangle {
  std::array<Vec3, 3> vertex;  ///< in any order
  friend bool operator==(const Triangle&, const Triangle&) = default;
};

/// How triangles are tested, as defined above.
enum class TriangleTest : std::uint8_t {
  exact,     ///< the triangle itself
  vertices,  ///< the box around the vertices, and added planes
};

/// `count` triangles in the user's memory as nine separate streams of floats: x, y, z of vertex 0, then of vertex 1,
/// then of vertex 2. The rules of BoxView for alignment, count and memory apply.
struct TriangleView {
  std::array<const float*, 9> stream{};  ///< in the order above
  std::size_t count = 0;                 ///< number of triangles

  /// The triangles [first, first + size). The caller keeps that range within `count`.
  [[nodiscard]] TriangleView slice(std::size_t first, std::size_t size) const noexcept {
    TriangleView part{stream, size};
    for (const float*& s : part.stream) s += first;
    return part;
  }
  /// Triangle i, for i below the count; not checked.
  [[nodiscard]] Triangle operator[](std::size_t i) const noexcept {
    return {{{{stream[0][i], stream[1][i], stream[2][i]},
              {stream[3][i], stream[4][i], stream[5][i]},
              {stream[6][i], stream[7][i], stream[8][i]}}}};
  }
};

/// An indexed mesh in the user's memory. The three floats of vertex i begin at byte `vertices + i * stride`, with any
/// stride and alignment. Triangle i has the vertices that indices 3 i, 3 i + 1 and 3 i + 2 name. Pack a mesh into a
/// stream or a tree to query it.
struct MeshView {
  const void* vertices = nullptr;            ///< the first vertex
  std::size_t stride = sizeof(Vec3);         ///< bytes from one vertex to the next
  std::size_t vertex_count = 0;              ///< number of vertices
  std::span<const std::uint32_t> indices{};  ///< of vertices, three per triangle

  /// The number of triangles.
  [[nodiscard]] std::size_t size() const noexcept { return indices.size() / 3; }
};

/// The mesh of an array of vertices.
[[nodiscard]] inline MeshView mesh_view(std::span<const Vec3> vertices,
                                        std::span<const std::uint32_t> indices) noexcept {
  return {vertices.data(), sizeof(Vec3), vertices.size(), indices};
}

/// Triangles in memory of their own: nine streams, each aligned to a cache line, no two of them at the same offset in a
/// page. 36 bytes per triangle, and at most 127 triangles of padding. Copies are deep, O(size()). Moves are O(1) and
/// leave an empty stream.
///
/// Constructors take O(count) and allocate once, or not at all for a count of 0. They throw InvalidArgument for null
/// memory with more than 0 triangles or vertices, for a number of indices that is not a multiple of three, and for an
/// index that is not below the number of vertices. They throw std::bad_alloc if memory runs out, and
/// std::bad_array_new_length for a count that no memory can hold. Packing throws BadBound, with the position of the
/// first bad triangle, for a coordinate that is not finite. Every exception leaves the stream unchanged. Const members
/// are safe to call from many threads, and so is update() of disjoint ranges.
class SHAFTCULL_EXPORT TriangleStream {
 public:
  TriangleStream() noexcept = default;
  /// Makes `count` empty triangles, with NaN coordinates, which no shaft keeps. Packing them into a tree throws
  /// BadBound until update() has replaced them.
  explicit TriangleStream(std::size_t count);
  explicit TriangleStream(std::span<const Triangle> triangles);
  explicit TriangleStream(const TriangleView& triangles);
  explicit TriangleStream(const MeshView& mesh);
  TriangleStream(const TriangleStream& other);
  TriangleStream(TriangleStream&& other) noexcept;
  TriangleStream& operator=(TriangleStream other) noexcept;
  ~TriangleStream() = default;

  /// Replaces the triangles from `first` on with the given triangles, in place and without allocation.
  /// O(number of given triangles). Throws as above. Throws InvalidArgument also for a range that is not within size(),
  /// and for memory that is null or belongs to the stream.
  void update(std::size_t first, std::span<const Triangle> triangles);
  void update(std::size_t first, const TriangleView& triangles);
  void update(std::size_t first, const MeshView& mesh);

  /// The number of triangles.
  [[nodiscard]] std::size_t size() const noexcept { return view_.count; }
  /// The bytes of triangles that the stream holds, padding included.
  [[nodiscard]] std::size_t memory_bytes() const noexcept;
  /// A view that shows later updates. Valid until the stream is assigned to, moved from or destroyed.
  [[nodiscard]] TriangleView view() const noexcept { return view_; }
  /// Lets a stream be passed as a view.
  operator TriangleView() const noexcept { return view_; }  // NOLINT(google-explicit-constructor)
  /// Triangle i, for i below the count; not checked.
  [[nodiscard]] Triangle operator[](std::size_t i) const noexcept { return view_[i]; }

 private:
  friend struct StreamAccess;  // the library writes rows without a copy
  struct NotWritten {};
  struct SHAFTCULL_EXPORT Free {
    void operator()(float* rows) const noexcept;
  };

  TriangleStream(NotWritten, std::size_t count);

  std::unique_ptr<float[], Free> memory_;  // nine rows, one after the other
  TriangleView view_;                      // a view of these rows
};

/// Triangles in memory of their own, sorted so that neighbours in space are neighbours in memory. Every 32 triangles
/// form a *chunk*. Queries skip whole chunks by a BoxTree of the boxes around them. Answers equal those of a view.
///
/// If triangles move, update() gives them new values. They stay in their chunks, whose boxes become larger; rebuild()
/// sorts triangles again. A tree of triangles has no layers.
///
/// Building sorts in parallel, O(n log n), with about 80 bytes of scratch memory per triangle. The tree then holds 36
/// bytes per triangle, 4 per index, and less than 1 per triangle for boxes. It throws the exceptions of TriangleStream,
/// and InvalidArgument for 2³² triangles or more. A call that throws leaves the tree as it was. Const members and
/// queries are safe to call from many threads. Copies are deep. Moves are O(1) and leave an empty tree.
class SHAFTCULL_EXPORT TriangleTree {
 public:
  static constexpr std::size_t chunk_size = 32;  ///< triangles per chunk

  TriangleTree() noexcept;
  /// Copies and sorts the triangles.
  explicit TriangleTree(std::span<const Triangle> triangles);
  explicit TriangleTree(const TriangleView& triangles);
  explicit TriangleTree(const MeshView& mesh);
  TriangleTree(const TriangleTree& other);
  TriangleTree& operator=(const TriangleTree& other);
  TriangleTree(TriangleTree&& other) noexcept;
  TriangleTree& operator=(TriangleTree&& other) noexcept;
  ~TriangleTree();

  /// The number of triangles.
  [[nodiscard]] std::size_t size() const noexcept;
  /// The bytes that the tree holds, padding included.
  [[nodiscard]] std::size_t memory_bytes() const noexcept;
  /// The triangles in tree order, with updates. Valid until the tree is updated as a whole, rebuilt, assigned to, moved
  /// from or destroyed.
  [[nodiscard]] TriangleView triangles() const noexcept;
  /// order()[p] is the user's index of triangle p of triangles(). Valid as long as triangles().
  [[nodiscard]] std::span<const std::uint32_t> order() const noexcept;
  /// The smallest box around all triangles; the empty box if there are none. O(1). Throws NeedsRefit if needs_refit().
  [[nodiscard]] Box box() const;

  /// Replaces every triangle i with the given triangle i, and refits. O(n), in parallel. During the call, it allocates
  /// twice the memory of the triangles. Throws InvalidArgument if the number of given triangles is not size().
  void update(std::span<const Triangle> all);
  void update(const TriangleView& all);
  void update(const MeshView& all);
  /// Replaces triangle indices[i] with the given triangle i; if an index occurs twice, the last triangle counts.
  /// Queries throw NeedsRefit until refit() is called. O(32 · indices.size()), except the first call, which is
  /// O(size()). Throws InvalidArgument for an index that is not below size(), or if the numbers of indices and
  /// triangles differ.
  void update(std::span<const std::uint32_t> indices, std::span<const Triangle> triangles);
  void update(std::span<const std::uint32_t> indices, const TriangleView& triangles);
  void update(std::span<const std::uint32_t> indices, const MeshView& triangles);
  /// Fits the nodes above chunks whose triangles were updated by index since the last refit.
  void refit();
  /// Whether triangles were updated by index since the last refit.
  [[nodiscard]] bool needs_refit() const noexcept;

  /// The growth of the boxes around chunks since the tree was built or rebuilt: the sum of their surfaces now, divided
  /// by the sum then; 1 at first. At 2 or 3 a rebuild() pays off. Infinite boxes are left out. +∞ if the sum was 0 and
  /// is not 0 now. For a copy of a tree in an image, growth counts from the copy. O(size() / 32). Throws NeedsRefit if
  /// needs_refit().
  [[nodiscard]] double sah_ratio() const;
  /// Sorts the present triangles again. Indices stay; order() changes. Takes the time and the memory of building.
  void rebuild();
  /// Renumbers the triangles in tree order: the index of triangle p of triangles() becomes p. O(n).
  void reorder() noexcept;

 private:
  friend struct TriangleTreeAccess;  // queries read the parts
  struct Parts;
  std::unique_ptr<Parts> parts_;  // null for a tree without triangles
};

}  // namespace shaftcull
