// SPDX-License-Identifier: MIT
#include "streams/pack.hpp"

#include <cmath>
#include <string>

#include "streams/stream_access.hpp"
#include "streams/strided_reader.hpp"
#include "streams/view_reader.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"

namespace shaftcull {
namespace kernel {
namespace {

void require_records(const void* start, std::size_t count, const char* name) {
  if (start == nullptr && count != 0) {
    kernel::fail(InvalidArgument(std::string(name) + " is null; it must point to the first of " +
                                 std::to_string(count) + " records"));
  }
}

std::string component(const char* name, std::size_t axis) { return std::string(name) + "." + "xyz"[axis]; }

/// "lo.x is not a number" for the first NaN among `values`, or nothing.
std::string nan_fault(const char* name, const float (&values)[3]) {
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::isnan(values[k])) return component(name, k) + " is not a number";
  }
  return {};
}

}  // namespace

MinMaxReader::MinMaxReader(const StridedBoxes& records)
    : lo_(records.lo, records.stride), hi_(records.hi, records.stride), count_(records.count) {
  require_records(records.lo, records.count, "StridedBoxes::lo");
  require_records(records.hi, records.count, "StridedBoxes::hi");
}

std::string MinMaxReader::fault(std::size_t i) const {
  float lo[3];
  float hi[3];
  lo_.read(i, lo);
  hi_.read(i, hi);
  if (std::string nan = nan_fault("lo", lo); !nan.empty()) return nan;
  if (std::string nan = nan_fault("hi", hi); !nan.empty()) return nan;
  std::size_t k = 0;
  while (k < 2 && lo[k] <= hi[k]) ++k;
  return component("lo", k) + " = " + text(lo[k]) + " is above " + component("hi", k) + " = " + text(hi[k]) +
         "; lo must be at most hi, or the box empty: lo = inf and hi = -inf on all axes";
}

CentreExtentReader::CentreExtentReader(const StridedCentreExtents& records)
    : centre_(records.centre, records.stride), half_(records.half_extent, records.stride), count_(records.count) {
  require_records(records.centre, records.count, "StridedCentreExtents::centre");
  require_records(records.half_extent, records.count, "StridedCentreExtents::half_extent");
}

std::string CentreExtentReader::fault(std::size_t i) const {
  float centre[3];
  float half[3];
  centre_.read(i, centre);
  half_.read(i, half);
  if (std::string nan = nan_fault("centre", centre); !nan.empty()) return nan;
  if (std::string nan = nan_fault("half_extent", half); !nan.empty()) return nan;
  for (std::size_t k = 0; k < 3; ++k) {
    if (half[k] < 0) return component("half_extent", k) + " = " + text(half[k]) + " is negative; it must be 0 or more";
  }
  std::size_t k = 0;
  while (k < 2 && !(std::isinf(centre[k]) && std::isinf(half[k]))) ++k;
  return component("centre", k) + " = " + text(centre[k]) + " and " + component("half_extent", k) + " = " +
         text(half[k]) + " leave the corners undefined; one of them must be finite";
}

SphereReader::SphereReader(const StridedSpheres& records)
    : centre_(records.centre, records.stride), radius_(records.radius, records.stride), count_(records.count) {
  require_records(records.centre, records.count, "StridedSpheres::centre");
  require_records(records.radius, records.count, "StridedSpheres::radius");
}

std::string SphereReader::fault(std::size_t i) const {
  float centre[3];
  float radius[1];
  centre_.read(i, centre);
  radius_.read(i, radius);
  if (std::string nan = nan_fault("centre", centre); !nan.empty()) return nan;
  for (std::size_t k = 0; k < 3; ++k) {
    if (std::isinf(centre[k])) {
      return component("centre", k) + " = " + text(centre[k]) +
             " is not finite; for a sphere that holds everything make the radius inf";
    }
  }
  if (std::isnan(radius[0])) return "radius is not a number";
  return "radius = " + text(radius[0]) + " is negative; it must be 0 or more";
}

namespace {

/// Throws BadBound for the first illegal record.
template <class Reader>
void require_legal(const Reader& reader) {
  const std::size_t i = first_illegal(reader, 0, reader.count());
  if (i == reader.count()) return;
  kernel::fail(BadBound(i, std::string(Reader::noun) + " " + std::to_string(i) + ": " + reader.fault(i)));
}

template <class Reader, class Stream>
void pack_all(const Reader& reader, std::size_t first, Stream& stream) {
  const std::size_t count = reader.count();
  const std::size_t size = stream.size();
  if (first > size || count > size - first) {
    kernel::fail(InvalidArgument("update of " + std::to_string(count) + " " +
                                 (count == 1 ? Reader::noun : Reader::nouns) + " from position " +
                                 std::to_string(first) + " on does not fit a stream of " + std::to_string(size)));
  }
  if (reader.overlaps(StreamAccess::memory(stream))) {
    refuse_shared_memory("update", "what is packed", "the stream");
  }
  in_float_environment([&] {
    require_legal(reader);
    read_rows(reader, InOrder{0}, count, StreamAccess::rows(stream, first).data());
  });
}

}  // namespace

void pack(const BoxView& boxes, std::size_t first, BoxStream& stream) {
  pack_all(ViewReader<BoxView>(boxes), first, stream);
}

void pack(const SphereView& spheres, std::size_t first, SphereStream& stream) {
  pack_all(ViewReader<SphereView>(spheres), first, stream);
}

void pack(const StridedBoxes& records, std::size_t first, BoxStream& stream) {
  pack_all(MinMaxReader(records), first, stream);
}

void pack(const StridedCentreExtents& records, std::size_t first, BoxStream& stream) {
  pack_all(CentreExtentReader(records), first, stream);
}

void pack(const StridedSpheres& records, std::size_t first, SphereStream& stream) {
  pack_all(SphereReader(records), first, stream);
}

}  // namespace kernel

StridedBoxes strided(std::span<const Box> boxes) noexcept {
  // The address of a member of the first box, without touching a box that is not there.
  const auto* const start = reinterpret_cast<const std::byte*>(boxes.data());
  if (start == nullptr) return {nullptr, nullptr, sizeof(Box), boxes.size()};  // refused unless it is empty
  return {start + offsetof(Box, lo), start + offsetof(Box, hi), sizeof(Box), boxes.size()};
}

StridedSpheres strided(std::span<const Sphere> spheres) noexcept {
  const auto* const start = reinterpret_cast<const std::byte*>(spheres.data());
  if (start == nullptr) return {nullptr, nullptr, sizeof(Sphere), spheres.size()};
  return {start + offsetof(Sphere, centre), start + offsetof(Sphere, radius), sizeof(Sphere), spheres.size()};
}

}  // namespace shaftcull
