// SPDX-License-Identifier: MIT
/// Packing triangles: from arrays, separate streams and indexed meshes.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

#include "shaftcull/error.hpp"
#include "streams/pack.hpp"
#include "streams/stream_access.hpp"
#include "streams/strided_reader.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/overlap.hpp"
#include "support/text.hpp"

namespace shaftcull::kernel {
namespace {

constexpr std::size_t coordinates = 9;

// Sources of triangles have count(), read(i, triangle), which writes nine coordinates, and overlaps(memory).

class TriangleArray {
 public:
  explicit TriangleArray(std::span<const Triangle> triangles) : triangles_(triangles) {
    require_memory("triangles", triangles, "triangles");
  }
  [[nodiscard]] std::size_t count() const noexcept { return triangles_.size(); }
  void read(std::size_t i, float (&triangle)[coordinates]) const noexcept {
    for (std::size_t v = 0; v != 3; ++v) std::copy_n(triangles_[i].vertex[v].data(), 3, triangle + 3 * v);
  }
  [[nodiscard]] bool overlaps(std::span<const std::byte> memory) const noexcept {
    return overlap(memory, bytes_of(triangles_));
  }

 private:
  std::span<const Triangle> triangles_;
};

class TriangleColumns {
 public:
  explicit TriangleColumns(const TriangleView& triangles) : view_(triangles) { require_view(triangles); }
  [[nodiscard]] std::size_t count() const noexcept { return view_.count; }
  void read(std::size_t i, float (&triangle)[coordinates]) const noexcept {
    for (std::size_t s = 0; s != coordinates; ++s) triangle[s] = view_.stream[s][i];
  }
  [[nodiscard]] bool overlaps(std::span<const std::byte> memory) const noexcept {
    return std::any_of(view_.stream.begin(), view_.stream.end(),
                       [&](const float* stream) { return overlap(memory, bytes_of(stream, view_.count)); });
  }

 private:
  TriangleView view_;
};

class MeshTriangles {
 public:
  explicit MeshTriangles(const MeshView& mesh) : vertices_(mesh.vertices, mesh.stride), mesh_(mesh) {
    if (mesh.vertices == nullptr && mesh.vertex_count != 0) {
      kernel::fail(InvalidArgument("MeshView::vertices is null; it must point to the first of " +
                                   counted(mesh.vertex_count, "record")));
    }
    require_memory("MeshView::indices", mesh.indices, "indices");
    if (mesh.indices.size() % 3 != 0) {
      kernel::fail(InvalidArgument("MeshView::indices has " + counted_indices(mesh.indices.size()) +
                                   ", which is not a multiple of three; each triangle takes three"));
    }
    const auto bad = std::find_if(mesh.indices.begin(), mesh.indices.end(),
                                  [&](std::uint32_t index) { return index >= mesh.vertex_count; });
    if (bad == mesh.indices.end()) return;
    kernel::fail(InvalidArgument("MeshView::indices[" + std::to_string(bad - mesh.indices.begin()) +
                                 "] = " + std::to_string(*bad) + " is not below the number of vertices, " +
                                 std::to_string(mesh.vertex_count)));
  }
  [[nodiscard]] std::size_t count() const noexcept { return mesh_.size(); }
  void read(std::size_t i, float (&triangle)[coordinates]) const noexcept {
    for (std::size_t v = 0; v != 3; ++v) {
      float vertex[3];
      vertices_.read(mesh_.indices[3 * i + v], vertex);
      std::copy_n(vertex, 3, triangle + 3 * v);
    }
  }
  [[nodiscard]] bool overlaps(std::span<const std::byte> memory) const noexcept {
    return vertices_.overlaps(memory, mesh_.vertex_count, 3) || overlap(memory, bytes_of(mesh_.indices));
  }

 private:
  VectorRecords vertices_;
  MeshView mesh_;
};

/// Throws BadBound for the first triangle with a coordinate that is not finite.
template <class Source>
void require_finite(const Source& source) {
  for (std::size_t i = 0; i != source.count(); ++i) {
    float triangle[coordinates];
    source.read(i, triangle);
    const auto bad = static_cast<std::size_t>(
        std::find_if(triangle, triangle + coordinates, [](float x) { return !std::isfinite(x); }) - triangle);
    if (bad == coordinates) continue;
    kernel::fail(BadBound(i, "triangle " + std::to_string(i) + ": vertex " + std::to_string(bad / 3) + " has " +
                                 "xyz"[bad % 3] + " = " + text(triangle[bad]) + "; vertices must be finite"));
  }
}

template <class Source>
void pack_triangles(const Source& source, std::size_t first, TriangleStream& stream) {
  const std::size_t count = source.count();
  if (first > stream.size() || count > stream.size() - first) {
    kernel::fail(InvalidArgument("update of " + counted(count, "triangle") + " from position " + std::to_string(first) +
                                 " on does not fit a stream of " + std::to_string(stream.size())));
  }
  if (source.overlaps(StreamAccess::memory(stream))) refuse_shared_memory("update", "what is packed", "the stream");
  in_float_environment([&] { require_finite(source); });
  const auto row = StreamAccess::rows(stream, first);
  for (std::size_t i = 0; i != count; ++i) {
    float triangle[coordinates];
    source.read(i, triangle);
    for (std::size_t s = 0; s != coordinates; ++s) row[s][i] = triangle[s];
  }
}

}  // namespace

void pack(std::span<const Triangle> triangles, std::size_t first, TriangleStream& stream) {
  pack_triangles(TriangleArray(triangles), first, stream);
}

void pack(const TriangleView& triangles, std::size_t first, TriangleStream& stream) {
  pack_triangles(TriangleColumns(triangles), first, stream);
}

void pack(const MeshView& mesh, std::size_t first, TriangleStream& stream) {
  pack_triangles(MeshTriangles(mesh), first, stream);
}

}  // namespace shaftcull::kernel
