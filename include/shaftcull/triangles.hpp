// SPDX-License-Identifier: MIT
/// Triangles against shafts: singly, in streams, and in trees of chunks of neighbouring triangles.
///
/// A box around a slanted triangle sticks out of it, so that shafts keep more boxes of triangles than triangles. Here
/// the triangles themselves are tested, in one of two ways (TriangleTest). *By vertices* costs little more than the box
/// around a triangle, and pays where planes were added to a shaft: a triangle is beyond a plane if its vertices are.
/// *Exact* says outside of every triangle that has no point in common with the shaft.
///
/// Answers of both are exact, the same bits on every instruction set. For all finite floats:
///
/// * `vertices`: outside iff the box around the three vertices is outside of the hull that the shaft was made of, as
///   cull() of a box says without added planes, or all three vertices are beyond one added plane, n · v > d.
/// * `exact`: outside iff the triangle, with its edges and interior, has no point in common with the shaft, added
///   planes left out, or all three vertices are beyond one added plane. Touching is not outside.
///
/// Triangles may be degenerate: segments and points, with vertices repeated or in one line. Shafts may be flat, and of
/// all kinds that boxes are tested with (volumes.hpp). A convex hull (hull.hpp) answers by vertices only.
///
/// With open contact (set_contact() in compiled.hpp) a triangle that only touches the shaft is outside: by
/// `vertices` if the box around it is, and by `exact` if the relative interiors of shaft and triangle have no point in
/// common; by both if no vertex is on the inner side of one added plane, off the plane. The relative interior of a
/// triangle leaves out its edges; if it is degenerate, that of a segment its ends, and that of a point is the point.
///
/// Values of a raw view are not checked. A coordinate that is NaN is left out of the box around the vertices; if all
/// three of an axis are, the triangle is *empty*, and outside of every shaft. A vertex is not beyond an added plane
/// that reads a coordinate of it that is not finite. A triangle with a coordinate that is not finite is answered by
/// vertices even if the exact test is asked for.
///
/// Inside is a triangle whose three vertices are inside, as points: a shaft is convex. With open contact it must be
/// kept, too. Verbs, options and errors are those of all bounds (cull.hpp, many.hpp, query.hpp); first contact and
/// blocking are not asked of triangles.
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

/// Three vertices. Which way round they are says nothing.
struct Triangle {
  std::array<Vec3, 3> vertex;  ///< in any order
  friend bool operator==(const Triangle&, const Triangle&) = default;
};

/// How triangles are tested, as said above.
enum class TriangleTest : std::uint8_t {
  vertices,  ///< the box around the vertices, and added planes
  exact,     ///< the triangle itself
};

/// `count` triangles in the user's memory as nine separate streams of floats: x, y, z of vertex 0, then of vertex 1,
/// then of vertex 2. Any alignment of a float, any count from 0 up, nothing past `count` is read: as BoxView.
struct TriangleView {
  std::array<const float*, 9> stream{};  ///< in the order said above
  std::size_t count = 0;                 ///< of triangles

  /// The triangles [first, first + size); the caller keeps that range within `count`.
  [[nodiscard]] TriangleView slice(std::size_t first, std::size_t size) const noexcept {
    TriangleView part{stream, size};
    for (const float*& s : part.stream) s += first;
    return part;
  }
  /// i is below count; not checked.
  [[nodiscard]] Triangle operator[](std::size_t i) const noexcept {
    return {{{{stream[0][i], stream[1][i], stream[2][i]},
              {stream[3][i], stream[4][i], stream[5][i]},
              {stream[6][i], stream[7][i], stream[8][i]}}}};
  }
};

/// An indexed mesh in the user's memory: vertex i has its three floats at byte `vertices + i * stride`, any stride, any
/// alignment; triangle i has the vertices that indices 3 i, 3 i + 1 and 3 i + 2 name. A mesh is packed into a stream or
/// a tree, which are what shafts are asked about.
struct MeshView {
  const void* vertices = nullptr;            ///< the first vertex
  std::size_t stride = sizeof(Vec3);         ///< bytes from one vertex to the next
  std::size_t vertex_count = 0;              ///< of vertices
  std::span<const std::uint32_t> indices{};  ///< of vertices, three a triangle

  /// How many triangles it has.
  [[nodiscard]] std::size_t size() const noexcept { return indices.size() / 3; }
};

/// The mesh of an array of vertices.
[[nodiscard]] inline MeshView mesh_view(std::span<const Vec3> vertices,
                                        std::span<const std::uint32_t> indices) noexcept {
  return {vertices.data(), sizeof(Vec3), vertices.size(), indices};
}

/// Triangles in memory of its own: nine streams, each aligned to a cache line, and no two of them at the same place of
/// a page; 36 bytes a triangle, and at most 127 triangles of padding. Copies are deep, O(size()); moves are O(1) and
/// leave an empty stream.
///
/// Constructors take O(count) and allocate once, nothing for a count of 0. They throw InvalidArgument for null memory
/// of more than 0 triangles or vertices, for a number of indices that is not a multiple of three, and for an index that
/// is not below the number of vertices; std::bad_alloc if memory runs out, and std::bad_array_new_length for a count
/// that no memory can hold. Packing throws BadBound, with the position of the first bad triangle, for a coordinate that
/// is not finite. Whatever is thrown leaves the stream unchanged. Const members are safe to call from many threads;
/// update() of disjoint ranges too.
class SHAFTCULL_EXPORT TriangleStream {
 public:
  TriangleStream() noexcept = default;
  /// `count` empty triangles: all of NaN, which no shaft keeps. Until update() has replaced them, packing them into a
  /// tree throws BadBound.
  explicit TriangleStream(std::size_t count);
  explicit TriangleStream(std::span<const Triangle> triangles);
  explicit TriangleStream(const TriangleView& triangles);
  explicit TriangleStream(const MeshView& mesh);
  TriangleStream(const TriangleStream& other);
  TriangleStream(TriangleStream&& other) noexcept;
  TriangleStream& operator=(TriangleStream other) noexcept;
  ~TriangleStream() = default;

  /// Replaces the triangles from `first` on, as many as are given, in place and without allocation; O(their count).
  /// Throws InvalidArgument if that range does not lie within size(), if what is given is null or lies in the stream's
  /// own memory, and as above.
  void update(std::size_t first, std::span<const Triangle> triangles);
  void update(std::size_t first, const TriangleView& triangles);
  void update(std::size_t first, const MeshView& mesh);

  /// How many triangles it holds.
  [[nodiscard]] std::size_t size() const noexcept { return view_.count; }
  /// Bytes of triangles that the stream holds, padding included.
  [[nodiscard]] std::size_t memory_bytes() const noexcept {
    return size() == 0 ? 0 : (bit_words(size()) | 1U) * 64 * sizeof(Triangle);
  }
  /// Valid until the stream is assigned to, moved from or destroyed; sees later updates.
  [[nodiscard]] TriangleView view() const noexcept { return view_; }
  /// So that a stream goes where a view goes.
  operator TriangleView() const noexcept { return view_; }  // NOLINT(google-explicit-constructor)
  /// i is below size(); not checked.
  [[nodiscard]] Triangle operator[](std::size_t i) const noexcept { return view_[i]; }

 private:
  friend struct StreamAccess;  // the library writes rows without a copy
  struct NotWritten {};
  struct SHAFTCULL_EXPORT Free {
    void operator()(float* rows) const noexcept;
  };

  TriangleStream(NotWritten, std::size_t count);

  std::unique_ptr<float[], Free> memory_;  // nine rows, one behind the other
  TriangleView view_;                      // of these rows
};

/// Triangles in memory of its own, sorted so that neighbours in space are neighbours in memory, under a BoxTree of the
/// boxes around each 32 of them, a *chunk*: dense meshes are passed over chunk by chunk. Answers equal those of a view.
///
/// A tree is not updated: build it again if triangles move, or update() a stream. It has no layers.
///
/// Building sorts, O(n log n), in parallel, with some 80 bytes a triangle of memory on the way. The tree then holds 36
/// bytes a triangle, 4 for its index, and less than one for boxes. It throws what TriangleStream throws, and
/// InvalidArgument for 2³² triangles or more. Const members and queries are safe to call from many threads. Copies are
/// deep; moves are O(1) and leave an empty tree.
class SHAFTCULL_EXPORT TriangleTree {
 public:
  static constexpr std::size_t chunk_size = 32;  ///< triangles a chunk

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

  /// How many triangles it holds.
  [[nodiscard]] std::size_t size() const noexcept;
  /// Bytes that the tree holds, padding included.
  [[nodiscard]] std::size_t memory_bytes() const noexcept;
  /// The triangles in tree order. Valid until the tree is assigned to, moved from or destroyed.
  [[nodiscard]] TriangleView triangles() const noexcept;
  /// order()[p] is the user's index of triangle p of these. Valid as triangles().
  [[nodiscard]] std::span<const std::uint32_t> order() const noexcept;
  /// The smallest box around all triangles; the empty box if there are none. O(1).
  [[nodiscard]] Box box() const;

 private:
  friend struct TriangleTreeAccess;  // queries read the parts
  struct Parts;
  std::unique_ptr<Parts> parts_;  // null for a tree without triangles
};

}  // namespace shaftcull
