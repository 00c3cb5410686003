// SPDX-License-Identifier: MIT
#include "sources.hpp"

#include <cstddef>
#include <cstring>
#include <string>

namespace shaftcull::binding {

namespace {

/// Throws for an unknown kind, and for a field that the kind does not have and that is not 0.
void check_fields(const shaftcull_source& source, const char* name) {
  const bool is_mesh = source.kind == SHAFTCULL_SOURCE_MESH;
  const bool is_bounds = source.kind == SHAFTCULL_SOURCE_BOUNDS;
  const bool has_second = !is_mesh && !is_bounds && source.kind != SHAFTCULL_SOURCE_TRIANGLES;
  const auto check = [&](bool is_right, const char* field) {
    if (!is_right) refuse(std::string(name) + "." + field + " is not 0, but a source of this kind has no such field");
  };
  if (source.kind < SHAFTCULL_SOURCE_BOXES || source.kind > SHAFTCULL_SOURCE_BOUNDS) {
    refuse(
        std::string(name) + ".kind = " + std::to_string(source.kind) +
        " is none of SHAFTCULL_SOURCE_BOXES to SHAFTCULL_SOURCE_BOUNDS; shaftcull_boxes() and the like make sources");
  }
  check(source.reserved == 0, "reserved");
  check(has_second || source.second == nullptr, "second");
  check(is_mesh || source.indices == nullptr, "indices");
  check(is_mesh || source.vertex_count == 0, "vertex_count");
  check(is_bounds || source.bounds == nullptr, "bounds");
  check(!is_bounds || source.count == 0, "count");
  check(!is_bounds || source.first == nullptr, "first");
  check(!is_bounds || source.stride == 0, "stride");
}

std::vector<Triangle> copied_triangles(const void* first, std::size_t stride, std::uint64_t count, const char* name) {
  std::vector<Triangle> triangles(as_count(count, sizeof(Triangle), name));
  const auto* bytes = static_cast<const std::byte*>(first);
  for (std::size_t i = 0; i != triangles.size(); ++i) std::memcpy(&triangles[i], bytes + i * stride, sizeof(Triangle));
  return triangles;
}

}  // namespace

bool has_no_data(const shaftcull_source& source, const char* name) {
  check_fields(source, name);
  return source.kind != SHAFTCULL_SOURCE_MESH && source.count != 0 && source.first == nullptr &&
         source.second == nullptr;
}

Source as_source(const shaftcull_source* source, const char* name) {
  const shaftcull_source& s = given(source, name);
  check_fields(s, name);
  if (s.kind == SHAFTCULL_SOURCE_BOUNDS) {
    const shaftcull_bounds& bounds = given(s.bounds, "source.bounds");
    return std::visit(
        [&bounds]<class Holder>(const Holder& holder) -> Source {
          if constexpr (Dynamic<Holder> || Snapshot<Holder>) {
            refuse("source.bounds are " + name_of(bounds) + ", which is no source");
          } else {
            return streams_of(holder);
          }
        },
        bounds.holder);
  }
  const auto require = [&](const void* records, const char* field) {
    if (records != nullptr || s.count == 0) return;
    refuse(std::string(name) + "." + field + " is NULL; it must point to the first of " + std::to_string(s.count) +
           " records");
  };
  require(s.first, "first");
  const std::size_t count = as_size(s.count, "count");
  const std::size_t stride = as_size(s.stride, "stride");
  if (s.kind == SHAFTCULL_SOURCE_TRIANGLES) return copied_triangles(s.first, stride, s.count, name);
  if (s.kind == SHAFTCULL_SOURCE_MESH) {
    const std::size_t triangles = as_count(s.count, 3 * sizeof(std::uint32_t), name);
    return MeshView{s.first, stride, as_size(s.vertex_count, "vertex_count"),
                    as_span(s.indices, std::uint64_t{triangles} * 3, "source.indices")};
  }
  require(s.second, "second");
  if (s.kind == SHAFTCULL_SOURCE_BOXES) return StridedBoxes{s.first, s.second, stride, count};
  if (s.kind == SHAFTCULL_SOURCE_CENTRES) return StridedCentreExtents{s.first, s.second, stride, count};
  return StridedSpheres{s.first, s.second, stride, count};
}

BoxesInStreams::BoxesInStreams(const shaftcull_source* source, const char* name) {
  const bool are_boxes = use_source(
      as_source(source, name), [this]<class Records>(const Records& records) requires(
                                   std::is_constructible_v<BoxStream, const Records&>) {
        if constexpr (std::is_same_v<Records, BoxView>) {
          view_ = records;
        } else if constexpr (std::is_same_v<Records, StridedBoxes>) {
          copy(records);
        } else {
          packed_ = BoxStream(records);
          view_ = packed_.view();
        }
      });
  if (!are_boxes) refuse(std::string(name) + " is a source of other bounds; this call takes boxes");
}

void BoxesInStreams::copy(const StridedBoxes& records) {
  const std::size_t count = as_count(records.count, sizeof(Box), "boxes");
  if (count > 1) many_.resize(6 * count);
  float* const floats = count > 1 ? many_.data() : one_.data();
  const auto* lo = static_cast<const std::byte*>(records.lo);
  const auto* hi = static_cast<const std::byte*>(records.hi);
  for (std::size_t i = 0; i != count; ++i) {
    float box[6];
    std::memcpy(box, lo + i * records.stride, 3 * sizeof(float));
    std::memcpy(box + 3, hi + i * records.stride, 3 * sizeof(float));
    for (std::size_t s = 0; s != 6; ++s) floats[s * count + i] = box[s];
  }
  view_.count = count;
  for (std::size_t s = 0; s != 6; ++s) view_.stream[s] = floats + s * count;
}

}  // namespace shaftcull::binding
