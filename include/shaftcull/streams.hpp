// SPDX-License-Identifier: MIT
/// Bounds in memory: views of the user's own streams, and streams that own their memory.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "shaftcull/bounds.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/export.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {

/// The number of 64-bit words that hold one bit per bound: bit i of word w is bound 64 w + i.
[[nodiscard]] constexpr std::size_t bit_words(std::size_t bounds) noexcept { return bounds / 64 + (bounds % 64 != 0); }

/// `count` boxes in the user's memory as six separate streams of floats: lo x, lo y, lo z, hi x, hi y, hi z.
///
/// Streams may have any alignment of a float, and any count from 0 up; nothing past `count` is read. Streams of an
/// empty view may be null; otherwise a call throws InvalidArgument for a null stream. The user's memory must outlive
/// the call.
///
/// Values are not checked. A NaN coordinate never makes a box outside, and a box with a NaN is never inside. A box with
/// lo > hi, except the empty box, gets an unspecified answer: the same on every instruction set, but not always in both
/// forms (Form in compiled.hpp).
struct BoxView {
  std::array<const float*, 6> stream{};  ///< in the order above
  std::size_t count = 0;                 ///< number of boxes

  /// The boxes [first, first + size). The caller keeps that range within `count`.
  [[nodiscard]] BoxView slice(std::size_t first, std::size_t size) const noexcept {
    BoxView part{stream, size};
    for (const float*& s : part.stream) s += first;
    return part;
  }
  /// Box i, for i below the count; not checked.
  [[nodiscard]] Box operator[](std::size_t i) const noexcept {
    return {{stream[0][i], stream[1][i], stream[2][i]}, {stream[3][i], stream[4][i], stream[5][i]}};
  }
};

/// `count` spheres in the user's memory as four streams of floats: centre x, y, z and radius. The rules of BoxView
/// apply. A NaN never makes a sphere outside, and a sphere with a NaN is never inside. A sphere with a negative radius
/// is *empty*: outside every shaft, and never inside.
struct SphereView {
  std::array<const float*, 4> stream{};  ///< in the order above
  std::size_t count = 0;                 ///< number of spheres

  /// The spheres [first, first + size). The caller keeps that range within `count`.
  [[nodiscard]] SphereView slice(std::size_t first, std::size_t size) const noexcept {
    SphereView part{stream, size};
    for (const float*& s : part.stream) s += first;
    return part;
  }
  /// Sphere i, for i below the count; not checked.
  [[nodiscard]] Sphere operator[](std::size_t i) const noexcept {
    return {{stream[0][i], stream[1][i], stream[2][i]}, stream[3][i]};
  }
};

/// Boxes as min and max corners in an array of structs. The three floats of lo of record i begin at byte
/// `lo + i * stride`, and those of hi at byte `hi + i * stride`. Any stride, any alignment.
struct StridedBoxes {
  const void* lo = nullptr;          ///< of the first record
  const void* hi = nullptr;          ///< of the first record
  std::size_t stride = sizeof(Box);  ///< bytes from one record to the next
  std::size_t count = 0;             ///< number of records
};

/// Boxes as centre and half extent, laid out as StridedBoxes. Corners that are not floats are rounded outwards, so that
/// the packed box always contains the given box.
struct StridedCentreExtents {
  const void* centre = nullptr;            ///< of the first record
  const void* half_extent = nullptr;       ///< of the first record
  std::size_t stride = 6 * sizeof(float);  ///< bytes from one record to the next
  std::size_t count = 0;                   ///< number of records
};

/// Spheres as three floats of centre and one float of radius, laid out as StridedBoxes.
struct StridedSpheres {
  const void* centre = nullptr;         ///< of the first record
  const void* radius = nullptr;         ///< of the first record
  std::size_t stride = sizeof(Sphere);  ///< bytes from one record to the next
  std::size_t count = 0;                ///< number of records
};

/// The records of an array of Box or Sphere.
[[nodiscard]] SHAFTCULL_EXPORT StridedBoxes strided(std::span<const Box> boxes) noexcept;
[[nodiscard]] SHAFTCULL_EXPORT StridedSpheres strided(std::span<const Sphere> spheres) noexcept;

/// Boxes in memory of their own: six streams, each aligned to a cache line. A stream takes 24 bytes per box, and at
/// most 63 boxes of padding, so that it ends with a whole word of answers. It takes 64 boxes more if the six streams
/// would be a multiple of 1 MiB apart. Copies are deep, O(size()). Moves are O(1) and leave an empty stream.
///
/// Constructors take O(count) and allocate once, or not at all for a count of 0. They throw InvalidArgument for null
/// memory with more than 0 boxes, std::bad_alloc if memory runs out, and its subclass std::bad_array_new_length for a
/// count that no memory can hold.
///
/// *Packing*, which copies bounds into a stream, throws BadBound for a NaN, lo > hi (except the empty box), a negative
/// half extent, or a centre and half extent that are both infinite on an axis. The error names the first bad record and
/// the fault. Every exception, std::bad_alloc included, leaves the stream unchanged. Const members are safe to call
/// from many threads, and so is update() of disjoint ranges.
class SHAFTCULL_EXPORT BoxStream {
 public:
  BoxStream() noexcept = default;
  /// Makes `count` empty boxes.
  explicit BoxStream(std::size_t count);
  explicit BoxStream(std::span<const Box> boxes);
  explicit BoxStream(const StridedBoxes& boxes);
  explicit BoxStream(const StridedCentreExtents& boxes);
  explicit BoxStream(const BoxView& boxes);
  BoxStream(const BoxStream& other);
  BoxStream(BoxStream&& other) noexcept;
  BoxStream& operator=(BoxStream other) noexcept;
  ~BoxStream() = default;

  /// Replaces the boxes from `first` on with the given boxes, in place and without allocation.
  /// O(number of given boxes). Throws BadBound as above. Throws InvalidArgument for a range that is not within size(),
  /// and for memory that is null or belongs to the stream.
  void update(std::size_t first, std::span<const Box> boxes);
  void update(std::size_t first, const StridedBoxes& boxes);
  void update(std::size_t first, const StridedCentreExtents& boxes);
  void update(std::size_t first, const BoxView& boxes);

  /// The number of boxes.
  [[nodiscard]] std::size_t size() const noexcept { return view_.count; }
  /// The bytes of boxes that the stream holds, padding included.
  [[nodiscard]] std::size_t memory_bytes() const noexcept;
  /// A view that shows later updates. Valid until the stream is assigned to, moved from or destroyed.
  [[nodiscard]] BoxView view() const noexcept { return view_; }
  /// Lets a stream be passed as a view.
  operator BoxView() const noexcept { return view_; }  // NOLINT(google-explicit-constructor)
  /// Box i, for i below the count; not checked.
  [[nodiscard]] Box operator[](std::size_t i) const noexcept { return view_[i]; }

 private:
  friend struct StreamAccess;  // the library writes rows without a copy
  struct NotWritten {};
  struct SHAFTCULL_EXPORT Free {
    void operator()(float* rows) const noexcept;
  };

  /// Makes `count` boxes, which the caller has to write. The constructor writes the padding after them.
  BoxStream(NotWritten, std::size_t count);

  std::unique_ptr<float[], Free> memory_;  // six rows, one after the other
  BoxView view_;                           // a view of these rows
};

/// Spheres in memory of their own: four aligned streams, 16 bytes per sphere, and padding as in BoxStream. Packing
/// throws BadBound for a NaN, a centre that is not finite or a negative radius. Building a tree throws it, too: first
/// replace all empty spheres of a SphereStream(count).
class SHAFTCULL_EXPORT SphereStream {
 public:
  SphereStream() noexcept = default;
  /// Makes `count` empty spheres: of radius −1, which no shaft keeps.
  explicit SphereStream(std::size_t count);
  explicit SphereStream(std::span<const Sphere> spheres);
  explicit SphereStream(const StridedSpheres& spheres);
  explicit SphereStream(const SphereView& spheres);
  SphereStream(const SphereStream& other);
  SphereStream(SphereStream&& other) noexcept;
  SphereStream& operator=(SphereStream other) noexcept;
  ~SphereStream() = default;

  /// Replaces spheres, as BoxStream::update() replaces boxes.
  void update(std::size_t first, std::span<const Sphere> spheres);
  void update(std::size_t first, const StridedSpheres& spheres);
  void update(std::size_t first, const SphereView& spheres);

  /// The number of spheres.
  [[nodiscard]] std::size_t size() const noexcept { return view_.count; }
  /// The bytes of spheres that the stream holds, padding included.
  [[nodiscard]] std::size_t memory_bytes() const noexcept;
  /// A view that shows later updates. Valid until the stream is assigned to, moved from or destroyed.
  [[nodiscard]] SphereView view() const noexcept { return view_; }
  /// Lets a stream be passed as a view.
  operator SphereView() const noexcept { return view_; }  // NOLINT(google-explicit-constructor)
  /// Sphere i, for i below the count; not checked.
  [[nodiscard]] Sphere operator[](std::size_t i) const noexcept { return view_[i]; }

 private:
  friend struct StreamAccess;  // the library writes rows without a copy
  struct NotWritten {};
  struct SHAFTCULL_EXPORT Free {
    void operator()(float* rows) const noexcept;
  };

  SphereStream(NotWritten, std::size_t count);

  std::unique_ptr<float[], Free> memory_;  // four rows, one after the other
  SphereView view_;                        // a view of these rows
};

}  // namespace shaftcull
