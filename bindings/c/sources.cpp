// SPDX-License-Identifier: MIT
#include "sources.hpp"

#include <cstddef>
#include <cstring>

namespace shaftcull::binding {

namespace {

/// Refuses a field that the kind of a source does not have, unless it is 0.
void check_unused(bool is_zero, const char* name, const char* field) {
  if (!is_zero) refuse(std::string(name) + "." + field + " is not 0, but a source of this kind has no such field");
}

std::vector<Triangle> copied_triangles(const shaftcull_source& source, const char* name) {
  const std::size_t count = as_count(source.count, sizeof(Triangle), name);
  const std::size_t stride = as_size(source.stride, "stride");
  if (source.first == nullptr && count != 0) {
    refuse(std::string(name) + ".first is NULL; it must point to the first of " + std::to_string(count) + " triangles");
  }
  std::vector<Triangle> triangles(count);
  const auto* bytes = static_cast<const std::byte*>(source.first);
  for (std::size_t i = 0; i != count; ++i) std::memcpy(&triangles[i], bytes + i * stride, sizeof(Triangle));
  return triangles;
}

Source leaves_of(const shaftcull_bounds& bounds) {
  return std::visit(
      []<class Holder>(const Holder& holder) -> Source {
        if constexpr (std::is_same_v<Holder, TriangleTree>) {
          return holder.triangles();
        } else if constexpr (requires { holder.leaves(); }) {
          return holder.leaves();
        } else if constexpr (requires { holder.view(); }) {
          return holder.view();
        } else {
          return holder;
        }
      },
      bounds.holder);
}

}  // namespace

Source as_source(const shaftcull_source* source, const char* name) {
  const shaftcull_source& s = given(source, name);
  const bool is_mesh = s.kind == SHAFTCULL_SOURCE_MESH;
  const bool is_bounds = s.kind == SHAFTCULL_SOURCE_BOUNDS;
  if (s.kind < SHAFTCULL_SOURCE_BOXES || s.kind > SHAFTCULL_SOURCE_BOUNDS) {
    refuse(
        std::string(name) + ".kind = " + std::to_string(s.kind) +
        " is none of SHAFTCULL_SOURCE_BOXES to SHAFTCULL_SOURCE_BOUNDS; shaftcull_boxes() and the like make sources");
  }
  check_unused(s.reserved == 0, name, "reserved");
  if (is_mesh || is_bounds || s.kind == SHAFTCULL_SOURCE_TRIANGLES) check_unused(s.second == nullptr, name, "second");
  if (!is_mesh) check_unused(s.indices == nullptr, name, "indices");
  if (!is_mesh) check_unused(s.vertex_count == 0, name, "vertex_count");
  if (is_bounds) {
    check_unused(s.count == 0, name, "count");
    check_unused(s.first == nullptr, name, "first");
    check_unused(s.stride == 0, name, "stride");
    return leaves_of(given(s.bounds, "source.bounds"));
  }
  check_unused(s.bounds == nullptr, name, "bounds");
  const std::size_t count = as_size(s.count, "count");
  const std::size_t stride = as_size(s.stride, "stride");
  switch (s.kind) {
    case SHAFTCULL_SOURCE_BOXES:
      return StridedBoxes{s.first, s.second, stride, count};
    case SHAFTCULL_SOURCE_CENTRES:
      return StridedCentreExtents{s.first, s.second, stride, count};
    case SHAFTCULL_SOURCE_SPHERES:
      return StridedSpheres{s.first, s.second, stride, count};
    case SHAFTCULL_SOURCE_TRIANGLES:
      return copied_triangles(s, name);
    default:
      break;
  }
  const std::size_t triangles = as_count(s.count, 3 * sizeof(std::uint32_t), name);
  return MeshView{s.first, stride, as_size(s.vertex_count, "vertex_count"),
                  as_span(s.indices, std::uint64_t{triangles} * 3, "source.indices")};
}

BatchBoxes::BatchBoxes(const shaftcull_source* source, const char* name) {
  const auto take = [&] {
    const bool are_boxes = use_source(
        as_source(source, name), [this]<class Records>(const Records& records) requires(
                                     std::is_constructible_v<BoxStream, const Records&>) {
          if constexpr (std::is_same_v<Records, BoxView>) {
            view_ = records;
          } else {
            packed_ = BoxStream(records);
            view_ = packed_.view();
          }
        });
    if (!are_boxes) refuse(std::string(name) + " is a source of other bounds; this call takes boxes");
  };
  // Of which array, for a call takes two. Streams also take the empty box, which can be no end of a shaft, no patch and
  // no occluder.
  const auto in_array = [name](const BadBound& bad) {
    const std::string what = bad.what();
    return BadBound(bad.index(), std::string(name) + ": " + what.substr(0, what.find(", or the box empty")));
  };
#if defined(__cpp_exceptions)
  try {
    take();
  } catch (const BadBound& bad) {
    throw in_array(bad);
  }
#else
  const TellingInstead::Other other = in_array;
  const TellingInstead telling(other);
  take();
#endif
}

std::string name_of_kind(shaftcull_bound_kind kind) {
  if (kind == SHAFTCULL_BOXES) return "boxes";
  return kind == SHAFTCULL_SPHERES ? "spheres" : "triangles";
}

std::string name_of(const shaftcull_bounds& bounds) {
  shaftcull_bounds_info info{};
  if (shaftcull_bounds_describe(&bounds, &info) != SHAFTCULL_OK) return "bounds";
  const std::string kind = name_of_kind(info.kind);
  if (info.holder == SHAFTCULL_VIEW) return "a view of " + kind;
  if (info.holder == SHAFTCULL_STREAM) return "a stream of " + kind;
  return "a tree of " + kind;
}

}  // namespace shaftcull::binding

extern "C" {

shaftcull_source shaftcull_boxes(const shaftcull_box* boxes, uint64_t count) {
  shaftcull_source source{};
  source.kind = SHAFTCULL_SOURCE_BOXES;
  source.count = count;
  source.first = boxes == nullptr ? nullptr : boxes->lo;
  source.second = boxes == nullptr ? nullptr : boxes->hi;
  source.stride = sizeof(shaftcull_box);
  return source;
}

shaftcull_source shaftcull_spheres(const shaftcull_sphere* spheres, uint64_t count) {
  shaftcull_source source{};
  source.kind = SHAFTCULL_SOURCE_SPHERES;
  source.count = count;
  source.first = spheres == nullptr ? nullptr : spheres->centre;
  source.second = spheres == nullptr ? nullptr : &spheres->radius;
  source.stride = sizeof(shaftcull_sphere);
  return source;
}

shaftcull_source shaftcull_triangles(const shaftcull_triangle* triangles, uint64_t count) {
  shaftcull_source source{};
  source.kind = SHAFTCULL_SOURCE_TRIANGLES;
  source.count = count;
  source.first = triangles;
  source.stride = sizeof(shaftcull_triangle);
  return source;
}

shaftcull_source shaftcull_mesh(const float* vertices, uint64_t vertex_count, const uint32_t* indices, uint64_t count) {
  shaftcull_source source{};
  source.kind = SHAFTCULL_SOURCE_MESH;
  source.count = count;
  source.first = vertices;
  source.stride = 3 * sizeof(float);
  source.indices = indices;
  source.vertex_count = vertex_count;
  return source;
}

shaftcull_source shaftcull_source_of(const shaftcull_bounds* bounds) {
  shaftcull_source source{};
  source.kind = SHAFTCULL_SOURCE_BOUNDS;
  source.bounds = bounds;
  return source;
}

}  // extern "C"
