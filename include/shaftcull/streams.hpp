// SPDX-License-Identifier: MIT
/// Bounds in memory: views of the user's own streams, and streams that own theirs.
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

/// Number of 64-bit words that hold one bit for each of `bounds` bounds: word w, bit i is bound 64 w + i.
[[nodiscard]] constexpr std::size_t bit_words(std::size_t bounds) noexcept { return bounds / 64 + (bounds % 64 != 0); }

/// `count` boxes in the user's memory as six separate streams of floats: lo x, lo y, lo z, hi x, hi y, hi z.
///
/// Any alignment of a float, any count from 0 up; nothing past `count` is read. Streams of an empty view may be null; a
/// call that gets a null stream and a count above 0 throws InvalidArgument. The memory is the user's and must outlive
/// the call it is passed to. Values are not checked: a NaN coordinate never culls and never makes a box inside; a box
/// with lo > hi that is not the empty box gets an unspecified answer, the same on every instruction set, but maybe not
/// in both forms.
struct BoxView {
  std::array<const float*, 6> stream{};  ///< in the order said above
  std::size_t count = 0;                 ///< of boxes

  /// The boxes [first, first + size); the caller keeps that range within `count`.
  [[nodiscard]] BoxView slice(std::size_t first, std::size_t size) const noexcept {
    BoxView part{stream, size};
    for (const float*& s : part.stream) s += first;
    return part;
  }
  /// i is below count; not checked.
  [[nodiscard]] Box operator[](std::size_t i) const noexcept {
    return {{stream[0][i], stream[1][i], stream[2][i]}, {stream[3][i], stream[4][i], stream[5][i]}};
  }
};

/// `count` spheres in the user's memory as four streams of floats: centre x, y, z and radius. As BoxView.
/// Values are not checked: a sphere with a NaN anywhere is never culled by that value and never inside. A
/// sphere with a negative radius is *empty*: outside of every shaft, and never inside.
struct SphereView {
  std::array<const float*, 4> stream{};  ///< in the order said above
  std::size_t count = 0;                 ///< of spheres

  /// The spheres [first, first + size); the caller keeps that range within `count`.
  [[nodiscard]] SphereView slice(std::size_t first, std::size_t size) const noexcept {
    SphereView part{stream, size};
    for (const float*& s : part.stream) s += first;
    return part;
  }
  /// i is below count; not checked.
  [[nodiscard]] Sphere operator[](std::size_t i) const noexcept {
    return {{stream[0][i], stream[1][i], stream[2][i]}, stream[3][i]};
  }
};

/// Boxes as min and max corners in an array of structs: record i has its three floats of lo at byte
/// `lo + i * stride` and its three floats of hi at `hi + i * stride`. Any stride, any alignment.
struct StridedBoxes {
  const void* lo = nullptr;          ///< of the first record
  const void* hi = nullptr;          ///< of the first record
  std::size_t stride = sizeof(Box);  ///< bytes from one record to the next
  std::size_t count = 0;             ///< of records
};

/// Boxes as centre and half extent, laid out as StridedBoxes. Corners that are not floats are rounded
/// outwards, so that the packed box always contains the given one.
struct StridedCentreExtents {
  const void* centre = nullptr;            ///< of the first record
  const void* half_extent = nullptr;       ///< of the first record
  std::size_t stride = 6 * sizeof(float);  ///< bytes from one record to the next
  std::size_t count = 0;                   ///< of records
};

/// Spheres as three floats of centre and one of radius, laid out as StridedBoxes.
struct StridedSpheres {
  const void* centre = nullptr;         ///< of the first record
  const void* radius = nullptr;         ///< of the first record
  std::size_t stride = sizeof(Sphere);  ///< bytes from one record to the next
  std::size_t count = 0;                ///< of records
};

/// Records of an array of Box or Sphere.
[[nodiscard]] SHAFTCULL_EXPORT StridedBoxes strided(std::span<const Box> boxes) noexcept;
[[nodiscard]] SHAFTCULL_EXPORT StridedSpheres strided(std::span<const Sphere> spheres) noexcept;

/// Boxes in memory of its own: six streams, each aligned to a cache line; 24 bytes a box, and at most 63 boxes of
/// padding so that streams end with a whole word of answers, 64 more if streams would be a multiple of 1 MiB apart.
/// Copies are deep, O(size()); moves are O(1) and leave an empty stream.
///
/// Constructors take O(count) and allocate once, nothing for a count of 0. They throw InvalidArgument for null memory
/// of more than 0 boxes, std::bad_alloc if memory runs out, and std::bad_array_new_length, which is one, for a count
/// that no memory can hold.
///
/// Packing checks its input: a NaN, lo > hi (but for the empty box), a negative half extent, or a centre and half
/// extent that are both infinite on an axis throws BadBound, which names the first bad record and what is wrong with
/// it. Whatever is thrown, std::bad_alloc included, leaves the stream unchanged. Const members are safe to call from
/// many threads; update() of disjoint ranges too.
class SHAFTCULL_EXPORT BoxStream {
 public:
  BoxStream() noexcept = default;
  /// `count` empty boxes.
  explicit BoxStream(std::size_t count);
  explicit BoxStream(std::span<const Box> boxes);
  explicit BoxStream(const StridedBoxes& boxes);
  explicit BoxStream(const StridedCentreExtents& boxes);
  explicit BoxStream(const BoxView& boxes);
  BoxStream(const BoxStream& other);
  BoxStream(BoxStream&& other) noexcept;
  BoxStream& operator=(BoxStream other) noexcept;
  ~BoxStream() = default;

  /// Replaces the boxes from `first` on, as many as are given, in place and without allocation; O(their count).
  /// Throws InvalidArgument if that range does not lie within size(), if what is given is null or lies in the stream's
  /// own memory, BadBound as above.
  void update(std::size_t first, std::span<const Box> boxes);
  void update(std::size_t first, const StridedBoxes& boxes);
  void update(std::size_t first, const StridedCentreExtents& boxes);
  void update(std::size_t first, const BoxView& boxes);

  /// How many boxes it holds.
  [[nodiscard]] std::size_t size() const noexcept { return view_.count; }
  /// Bytes of boxes that the stream holds, padding included.
  [[nodiscard]] std::size_t memory_bytes() const noexcept {
    return size() == 0 ? 0 : static_cast<std::size_t>(view_.stream[1] - view_.stream[0]) * sizeof(Box);
  }
  /// Valid until the stream is assigned to, moved from or destroyed; sees later updates.
  [[nodiscard]] BoxView view() const noexcept { return view_; }
  /// So that a stream goes where a view goes.
  operator BoxView() const noexcept { return view_; }  // NOLINT(google-explicit-constructor)
  /// i is below size(); not checked.
  [[nodiscard]] Box operator[](std::size_t i) const noexcept { return view_[i]; }

 private:
  friend struct StreamAccess;  // the library writes rows without a copy
  struct NotWritten {};
  struct SHAFTCULL_EXPORT Free {
    void operator()(float* rows) const noexcept;
  };

  /// `count` boxes that are to be written; the padding behind them is.
  BoxStream(NotWritten, std::size_t count);

  std::unique_ptr<float[], Free> memory_;  // six rows, one behind the other
  BoxView view_;                           // of these rows
};

/// Spheres in memory of its own: four aligned streams, 16 bytes a sphere and padding as in BoxStream. Packing throws
/// BadBound for a NaN, a centre that is not finite or a negative radius. Trees do so, too: no tree is made of a
/// SphereStream(count) whose empty spheres were not all updated.
class SHAFTCULL_EXPORT SphereStream {
 public:
  SphereStream() noexcept = default;
  /// `count` empty spheres: of radius −1, which no shaft keeps.
  explicit SphereStream(std::size_t count);
  explicit SphereStream(std::span<const Sphere> spheres);
  explicit SphereStream(const StridedSpheres& spheres);
  explicit SphereStream(const SphereView& spheres);
  SphereStream(const SphereStream& other);
  SphereStream(SphereStream&& other) noexcept;
  SphereStream& operator=(SphereStream other) noexcept;
  ~SphereStream() = default;

  /// As BoxStream::update.
  void update(std::size_t first, std::span<const Sphere> spheres);
  void update(std::size_t first, const StridedSpheres& spheres);
  void update(std::size_t first, const SphereView& spheres);

  /// How many spheres it holds.
  [[nodiscard]] std::size_t size() const noexcept { return view_.count; }
  /// Bytes of spheres that the stream holds, padding included.
  [[nodiscard]] std::size_t memory_bytes() const noexcept {
    return size() == 0 ? 0 : static_cast<std::size_t>(view_.stream[1] - view_.stream[0]) * sizeof(Sphere);
  }
  /// Valid until the stream is assigned to, moved from or destroyed; sees later updates.
  [[nodiscard]] SphereView view() const noexcept { return view_; }
  /// So that a stream goes where a view goes.
  operator SphereView() const noexcept { return view_; }  // NOLINT(google-explicit-constructor)
  /// i is below size(); not checked.
  [[nodiscard]] Sphere operator[](std::size_t i) const noexcept { return view_[i]; }

 private:
  friend struct StreamAccess;  // the library writes rows without a copy
  struct NotWritten {};
  struct SHAFTCULL_EXPORT Free {
    void operator()(float* rows) const noexcept;
  };

  SphereStream(NotWritten, std::size_t count);

  std::unique_ptr<float[], Free> memory_;  // four rows, one behind the other
  SphereView view_;                        // of these rows
};

}  // namespace shaftcull
