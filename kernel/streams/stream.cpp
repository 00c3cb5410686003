// SPDX-License-Identifier: MIT
#include <algorithm>
#include <new>
#include <utility>

#include "shaftcull/streams.hpp"
#include "shaftcull/triangles.hpp"
#include "streams/pack.hpp"
#include "streams/rows.hpp"
#include "streams/stream_access.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/padding.hpp"

namespace shaftcull {
namespace {

constexpr std::align_val_t cache_line{64};

/// Memory for `rows` rows of `count` floats and their padding, not initialised; null for a count of 0.
float* allocate_rows(std::size_t rows, std::size_t count) {
  if (count == 0) return nullptr;
  if (count > kernel::most_floats / rows - 127) kernel::fail(std::bad_array_new_length());
  return static_cast<float*>(::operator new[](rows* kernel::row_floats(rows, count) * sizeof(float), cache_line));
}

void free_rows(float* rows) noexcept { ::operator delete[](rows, cache_line); }

/// Writes `bound` to all places from `first` on, to the end of the padding.
template <class Stream, std::size_t rows>
void fill_from(Stream& stream, std::size_t first, const float (&bound)[rows]) noexcept {
  const std::size_t places = kernel::row_floats(rows, stream.size()) - first;
  const auto row = StreamAccess::rows(stream, first);
  for (std::size_t s = 0; s != rows; ++s) std::fill_n(row[s], places, bound[s]);
}

}  // namespace

void BoxStream::Free::operator()(float* rows) const noexcept { free_rows(rows); }

BoxStream::BoxStream(NotWritten, std::size_t count)
    : memory_(allocate_rows(6, count)), view_(kernel::view_in<BoxView>(memory_.get(), count)) {
  fill_from(*this, count, kernel::padding_box);
}

BoxStream::BoxStream(std::size_t count) : BoxStream(NotWritten(), count) { fill_from(*this, 0, kernel::padding_box); }

BoxStream::BoxStream(std::span<const Box> boxes) : BoxStream(kernel::required_records(boxes, "boxes")) {}

BoxStream::BoxStream(const StridedBoxes& boxes) : BoxStream(NotWritten(), boxes.count) { update(0, boxes); }

BoxStream::BoxStream(const StridedCentreExtents& boxes) : BoxStream(NotWritten(), boxes.count) { update(0, boxes); }

BoxStream::BoxStream(const BoxView& boxes) : BoxStream(NotWritten(), boxes.count) { update(0, boxes); }

std::size_t BoxStream::memory_bytes() const noexcept {
  return size() == 0 ? 0 : static_cast<std::size_t>(view_.stream[1] - view_.stream[0]) * sizeof(Box);
}

BoxStream::BoxStream(const BoxStream& other) : BoxStream(NotWritten(), other.size()) {
  std::copy_n(other.view_.stream[0], memory_bytes() / sizeof(float), memory_.get());
}

BoxStream::BoxStream(BoxStream&& other) noexcept
    : memory_(std::move(other.memory_)), view_(std::exchange(other.view_, {})) {}

BoxStream& BoxStream::operator=(BoxStream other) noexcept {
  memory_ = std::move(other.memory_);
  view_ = std::exchange(other.view_, {});
  return *this;
}

void BoxStream::update(std::size_t first, std::span<const Box> boxes) {
  update(first, kernel::required_records(boxes, "boxes"));
}

void BoxStream::update(std::size_t first, const StridedBoxes& boxes) { kernel::pack(boxes, first, *this); }

void BoxStream::update(std::size_t first, const StridedCentreExtents& boxes) { kernel::pack(boxes, first, *this); }

void BoxStream::update(std::size_t first, const BoxView& boxes) { kernel::pack(boxes, first, *this); }

void SphereStream::Free::operator()(float* rows) const noexcept { free_rows(rows); }

SphereStream::SphereStream(NotWritten, std::size_t count)
    : memory_(allocate_rows(4, count)), view_(kernel::view_in<SphereView>(memory_.get(), count)) {
  fill_from(*this, count, kernel::padding_sphere);
}

SphereStream::SphereStream(std::size_t count) : SphereStream(NotWritten(), count) {
  fill_from(*this, 0, kernel::padding_sphere);
}

SphereStream::SphereStream(std::span<const Sphere> spheres)
    : SphereStream(kernel::required_records(spheres, "spheres")) {}

SphereStream::SphereStream(const StridedSpheres& spheres) : SphereStream(NotWritten(), spheres.count) {
  update(0, spheres);
}

SphereStream::SphereStream(const SphereView& spheres) : SphereStream(NotWritten(), spheres.count) {
  update(0, spheres);
}

std::size_t SphereStream::memory_bytes() const noexcept {
  return size() == 0 ? 0 : static_cast<std::size_t>(view_.stream[1] - view_.stream[0]) * sizeof(Sphere);
}

SphereStream::SphereStream(const SphereStream& other) : SphereStream(NotWritten(), other.size()) {
  std::copy_n(other.view_.stream[0], memory_bytes() / sizeof(float), memory_.get());
}

SphereStream::SphereStream(SphereStream&& other) noexcept
    : memory_(std::move(other.memory_)), view_(std::exchange(other.view_, {})) {}

SphereStream& SphereStream::operator=(SphereStream other) noexcept {
  memory_ = std::move(other.memory_);
  view_ = std::exchange(other.view_, {});
  return *this;
}

void SphereStream::update(std::size_t first, std::span<const Sphere> spheres) {
  update(first, kernel::required_records(spheres, "spheres"));
}

void SphereStream::update(std::size_t first, const StridedSpheres& spheres) { kernel::pack(spheres, first, *this); }

void SphereStream::update(std::size_t first, const SphereView& spheres) { kernel::pack(spheres, first, *this); }

void TriangleStream::Free::operator()(float* rows) const noexcept { free_rows(rows); }

TriangleStream::TriangleStream(NotWritten, std::size_t count)
    : memory_(allocate_rows(9, count)), view_(kernel::view_in<TriangleView>(memory_.get(), count)) {
  fill_from(*this, count, kernel::padding_triangle);
}

TriangleStream::TriangleStream(std::size_t count) : TriangleStream(NotWritten(), count) {
  fill_from(*this, 0, kernel::padding_triangle);
}

TriangleStream::TriangleStream(std::span<const Triangle> triangles) : TriangleStream(NotWritten(), triangles.size()) {
  update(0, triangles);
}

TriangleStream::TriangleStream(const TriangleView& triangles) : TriangleStream(NotWritten(), triangles.count) {
  update(0, triangles);
}

TriangleStream::TriangleStream(const MeshView& mesh) : TriangleStream(NotWritten(), mesh.size()) { update(0, mesh); }

std::size_t TriangleStream::memory_bytes() const noexcept {
  return size() == 0 ? 0 : (bit_words(size()) | 1U) * 64 * sizeof(Triangle);
}

TriangleStream::TriangleStream(const TriangleStream& other) : TriangleStream(NotWritten(), other.size()) {
  std::copy_n(other.view_.stream[0], memory_bytes() / sizeof(float), memory_.get());
}

TriangleStream::TriangleStream(TriangleStream&& other) noexcept
    : memory_(std::move(other.memory_)), view_(std::exchange(other.view_, {})) {}

TriangleStream& TriangleStream::operator=(TriangleStream other) noexcept {
  memory_ = std::move(other.memory_);
  view_ = std::exchange(other.view_, {});
  return *this;
}

void TriangleStream::update(std::size_t first, std::span<const Triangle> triangles) {
  kernel::pack(triangles, first, *this);
}

void TriangleStream::update(std::size_t first, const TriangleView& triangles) { kernel::pack(triangles, first, *this); }

void TriangleStream::update(std::size_t first, const MeshView& mesh) { kernel::pack(mesh, first, *this); }

}  // namespace shaftcull
