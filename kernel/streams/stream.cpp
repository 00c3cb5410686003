#include <algorithm>
#include <limits>
#include <new>
#include <utility>

#include "shaftcull/streams.hpp"
#include "streams/pack.hpp"

namespace shaftcull {
namespace {

constexpr std::align_val_t cache_line{64};

// What lies in the padding, and in a stream that nothing was packed into yet.
constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float empty_box[6] = {infinity, infinity, infinity, -infinity, -infinity, -infinity};
constexpr float empty_sphere[4] = {0, 0, 0, -1};

/// `count` rounded up to whole words of answers, so that kernels may read full vectors to the end.
std::size_t padded_length(std::size_t count) {
  if (count > std::numeric_limits<std::size_t>::max() - 63) throw std::bad_array_new_length();
  return words_for(count) * 64;
}

StreamMemory box_memory(std::size_t count) { return {6, padded_length(count)}; }
StreamMemory sphere_memory(std::size_t count) { return {4, padded_length(count)}; }

/// Fills entries `first` … of each row with the bound whose coordinates are `bound`.
template <std::size_t rows>
void fill_from(const StreamMemory& memory, std::size_t first, const float (&bound)[rows]) noexcept {
  for (std::size_t k = 0; k < rows; ++k)
    std::fill(memory.row(k) + first, memory.row(k) + memory.row_length(), bound[k]);
}

StreamMemory copy_of(const StreamMemory& memory, std::size_t rows) {
  StreamMemory copy(rows, memory.row_length());
  std::copy(memory.row(0), memory.row(rows), copy.row(0));
  return copy;
}

}  // namespace

StreamMemory::StreamMemory(std::size_t rows, std::size_t row_length) : row_length_(row_length) {
  if (rows == 0 || row_length == 0) return;
  constexpr std::size_t most_bytes = std::numeric_limits<std::ptrdiff_t>::max();
  if (row_length > most_bytes / sizeof(float) / rows) throw std::bad_array_new_length();
  bytes_ = rows * row_length * sizeof(float);
  floats_.reset(static_cast<float*>(::operator new[](bytes_, cache_line)));
}

void StreamMemory::Free::operator()(float* floats) const noexcept { ::operator delete[](floats, cache_line); }

BoxStream::BoxStream(std::size_t count) : memory_(box_memory(count)), size_(count) { fill_from(memory_, 0, empty_box); }

BoxStream::BoxStream(std::span<const Box> boxes) : BoxStream(records(boxes)) {}

BoxStream::BoxStream(const MinMaxRecords& boxes) : memory_(box_memory(boxes.count)), size_(boxes.count) {
  fill_from(memory_, size_, empty_box);
  update(0, boxes);
}

BoxStream::BoxStream(const CentreExtentRecords& boxes) : memory_(box_memory(boxes.count)), size_(boxes.count) {
  fill_from(memory_, size_, empty_box);
  update(0, boxes);
}

BoxStream::BoxStream(const BoxView& boxes) : memory_(box_memory(boxes.count)), size_(boxes.count) {
  fill_from(memory_, size_, empty_box);
  update(0, boxes);
}

BoxStream::BoxStream(const BoxStream& other) : memory_(copy_of(other.memory_, 6)), size_(other.size_) {}

BoxStream& BoxStream::operator=(const BoxStream& other) {
  if (this != &other) *this = BoxStream(other);
  return *this;
}

BoxStream::BoxStream(BoxStream&& other) noexcept
    : memory_(std::exchange(other.memory_, {})), size_(std::exchange(other.size_, 0)) {}

BoxStream& BoxStream::operator=(BoxStream&& other) noexcept {
  if (this == &other) return *this;
  memory_ = std::exchange(other.memory_, {});
  size_ = std::exchange(other.size_, 0);
  return *this;
}

void BoxStream::update(std::size_t first, std::span<const Box> boxes) { update(first, records(boxes)); }

void BoxStream::update(std::size_t first, const MinMaxRecords& boxes) { kernel::pack(boxes, first, size_, memory_); }

void BoxStream::update(std::size_t first, const CentreExtentRecords& boxes) {
  kernel::pack(boxes, first, size_, memory_);
}

void BoxStream::update(std::size_t first, const BoxView& boxes) { kernel::pack(boxes, first, size_, memory_); }

BoxView BoxStream::view() const noexcept {
  BoxView view;
  view.count = size_;
  for (std::size_t k = 0; k < view.stream.size(); ++k) view.stream[k] = memory_.row(k);
  return view;
}

SphereStream::SphereStream(std::size_t count) : memory_(sphere_memory(count)), size_(count) {
  fill_from(memory_, 0, empty_sphere);
}

SphereStream::SphereStream(std::span<const Sphere> spheres) : SphereStream(records(spheres)) {}

SphereStream::SphereStream(const SphereRecords& spheres) : memory_(sphere_memory(spheres.count)), size_(spheres.count) {
  fill_from(memory_, size_, empty_sphere);
  update(0, spheres);
}

SphereStream::SphereStream(const SphereView& spheres) : memory_(sphere_memory(spheres.count)), size_(spheres.count) {
  fill_from(memory_, size_, empty_sphere);
  update(0, spheres);
}

SphereStream::SphereStream(const SphereStream& other) : memory_(copy_of(other.memory_, 4)), size_(other.size_) {}

SphereStream& SphereStream::operator=(const SphereStream& other) {
  if (this != &other) *this = SphereStream(other);
  return *this;
}

SphereStream::SphereStream(SphereStream&& other) noexcept
    : memory_(std::exchange(other.memory_, {})), size_(std::exchange(other.size_, 0)) {}

SphereStream& SphereStream::operator=(SphereStream&& other) noexcept {
  if (this == &other) return *this;
  memory_ = std::exchange(other.memory_, {});
  size_ = std::exchange(other.size_, 0);
  return *this;
}

void SphereStream::update(std::size_t first, std::span<const Sphere> spheres) { update(first, records(spheres)); }

void SphereStream::update(std::size_t first, const SphereRecords& spheres) {
  kernel::pack(spheres, first, size_, memory_);
}

void SphereStream::update(std::size_t first, const SphereView& spheres) {
  kernel::pack(spheres, first, size_, memory_);
}

SphereView SphereStream::view() const noexcept {
  SphereView view;
  view.count = size_;
  for (std::size_t k = 0; k < view.stream.size(); ++k) view.stream[k] = memory_.row(k);
  return view;
}

}  // namespace shaftcull
