// SPDX-License-Identifier: MIT
#include "batch/float_rows.hpp"

#include <cstring>

namespace shaftcull::batch {
namespace {

/// Makes floats of doubles, record by record: `convert` makes a To of a From. Floats may begin where doubles do, since
/// those of a record end before the next record begins.
template <class From, class To, class Convert>
void convert_records(std::span<const std::byte> doubles, std::byte* floats, const Convert& convert) {
  for (std::size_t i = 0; i != doubles.size() / sizeof(From); ++i) {
    From from;
    std::memcpy(&from, doubles.data() + i * sizeof(From), sizeof(From));
    const To to = convert(from);
    std::memcpy(floats + i * sizeof(To), &to, sizeof(To));
  }
}

}  // namespace

std::span<const float> FloatRows::read(std::uint64_t first, std::uint64_t count,
                                       std::vector<std::byte>& scratch) const {
  const std::span<const std::byte> bytes = file_->read(first, count, scratch);
  if (file_->number() != Number::float64) {
    return {reinterpret_cast<const float*>(bytes.data()), bytes.size() / sizeof(float)};
  }
  const std::size_t size = bytes.size() / 2;
  if (scratch.size() < size) scratch.resize(size);  // where rows are mapped: scratch holds no doubles
  std::byte* const floats = scratch.data();
  switch (rounding_) {
    case RowRounding::boxes_around:
      convert_records<WorldBox, Box>(bytes, floats, [&](const WorldBox& box) { return origin_.around(box); });
      break;
    case RowRounding::boxes_within:
      convert_records<WorldBox, Box>(bytes, floats, [&](const WorldBox& box) { return origin_.within(box); });
      break;
    case RowRounding::spheres_around:
      convert_records<WorldSphere, Sphere>(bytes, floats,
                                           [&](const WorldSphere& ball) { return origin_.around(ball); });
      break;
    case RowRounding::nearest:
      convert_records<WorldVec3, Vec3>(bytes, floats, [&](const WorldVec3& point) { return origin_.nearest(point); });
      break;
  }
  return {reinterpret_cast<const float*>(floats), size / sizeof(float)};
}

}  // namespace shaftcull::batch
