// SPDX-License-Identifier: MIT
/// Views and streams, and what is known of all bounds.
#include <algorithm>
#include <array>
#include <concepts>
#include <memory>
#include <span>
#include <string>
#include <utility>

#include "arguments.hpp"
#include "sources.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::Box;
using shaftcull::BoxStream;
using shaftcull::BoxView;
using shaftcull::Sphere;
using shaftcull::SphereStream;
using shaftcull::SphereView;
using shaftcull::TriangleStream;
using shaftcull::TriangleTree;
using shaftcull::TriangleView;

namespace {

template <class Holder>
concept View = std::same_as<Holder, BoxView> || std::same_as<Holder, SphereView> || std::same_as<Holder, TriangleView>;
template <class Holder>
concept Stream = requires(const Holder& holder) {
  holder.view();
};

/// The floats of any holder.
template <class Holder>
auto streams_of(const Holder& holder) {
  if constexpr (View<Holder>) {
    return holder;
  } else if constexpr (Stream<Holder>) {
    return holder.view();
  } else if constexpr (std::same_as<Holder, TriangleTree>) {
    return holder.triangles();
  } else {
    return holder.leaves();
  }
}

template <class Holder>
constexpr shaftcull_bound_kind kind_of() {
  using Streams = decltype(streams_of(std::declval<const Holder&>()));
  if (std::same_as<Streams, BoxView>) return SHAFTCULL_BOXES;
  return std::same_as<Streams, SphereView> ? SHAFTCULL_SPHERES : SHAFTCULL_TRIANGLES;
}

/// A view of the caller's streams.
template <View AnyView>
AnyView as_view(const float* const* streams, std::uint64_t count) {
  AnyView view;
  view.count = as_count(count, sizeof(float), "streams");
  if (count == 0) return view;
  (void)given(streams, "streams");
  for (std::size_t s = 0; s != view.stream.size(); ++s) {
    if (streams[s] == nullptr) {
      refuse("streams[" + std::to_string(s) + "] is NULL; it must point to the first of " + std::to_string(count) +
             " floats");
    }
    view.stream[s] = streams[s];
  }
  return view;
}

[[noreturn]] void refuse_kind(shaftcull_bound_kind kind) {
  refuse("kind = " + std::to_string(kind) + " is none of SHAFTCULL_BOXES, SHAFTCULL_SPHERES and SHAFTCULL_TRIANGLES");
}

}  // namespace

extern "C" {

shaftcull_status shaftcull_view_create(shaftcull_bound_kind kind, const float* const* streams, uint64_t count,
                                       shaftcull_bounds** bounds) {
  return guarded([&] {
    shaftcull_bounds*& out = given(bounds, "bounds");
    switch (kind) {
      case SHAFTCULL_BOXES:
        out = new shaftcull_bounds{as_view<BoxView>(streams, count)};
        break;
      case SHAFTCULL_SPHERES:
        out = new shaftcull_bounds{as_view<SphereView>(streams, count)};
        break;
      case SHAFTCULL_TRIANGLES:
        out = new shaftcull_bounds{as_view<TriangleView>(streams, count)};
        break;
      default:
        refuse_kind(kind);
    }
  });
}

shaftcull_status shaftcull_view_set(shaftcull_bounds* view, const float* const* streams, uint64_t count) {
  return guarded([&] {
    std::visit(
        [&]<class Holder>(Holder& holder) {
          if constexpr (View<Holder>) {
            holder = as_view<Holder>(streams, count);
          } else {
            refuse("view is " + name_of(*view) + "; only a view can be pointed at other memory");
          }
        },
        given(view, "view").holder);
  });
}

shaftcull_status shaftcull_stream_create(const shaftcull_source* source, shaftcull_bounds** bounds) {
  return guarded([&] {
    shaftcull_bounds*& out = given(bounds, "bounds");
    (void)use_source(as_source(source, "source"), [&](const auto& records) {
      using Records = std::remove_cvref_t<decltype(records)>;
      if constexpr (std::is_constructible_v<BoxStream, const Records&>) {
        out = new shaftcull_bounds{BoxStream(records)};
      } else if constexpr (std::is_constructible_v<SphereStream, const Records&>) {
        out = new shaftcull_bounds{SphereStream(records)};
      } else {
        out = new shaftcull_bounds{TriangleStream(records)};
      }
    });
  });
}

shaftcull_status shaftcull_stream_create_empty(shaftcull_bound_kind kind, uint64_t count, shaftcull_bounds** bounds) {
  return guarded([&] {
    shaftcull_bounds*& out = given(bounds, "bounds");
    switch (kind) {
      case SHAFTCULL_BOXES:
        out = new shaftcull_bounds{BoxStream(as_count(count, sizeof(Box), "boxes"))};
        break;
      case SHAFTCULL_SPHERES:
        out = new shaftcull_bounds{SphereStream(as_count(count, sizeof(Sphere), "spheres"))};
        break;
      case SHAFTCULL_TRIANGLES:
        out = new shaftcull_bounds{TriangleStream(as_count(count, sizeof(shaftcull::Triangle), "triangles"))};
        break;
      default:
        refuse_kind(kind);
    }
  });
}

shaftcull_status shaftcull_stream_update(shaftcull_bounds* stream, uint64_t first, const shaftcull_source* source) {
  return guarded([&] {
    shaftcull_bounds& bounds = given(stream, "stream");
    const Source from = as_source(source, "source");
    const bool fits = std::visit(
        [&]<class Holder>(Holder& holder) {
          if constexpr (Stream<Holder>) {
            return use_source(
                from, [&](const auto& records) requires requires { holder.update(0, records); } {
                  holder.update(as_size(first, "first"), records);
                });
          } else {
            return false;
          }
        },
        bounds.holder);
    if (!fits) {
      refuse("stream is " + name_of(bounds) + "; a stream is updated, by a source of bounds of its own kind" +
             " (shaftcull_tree_update() updates trees)");
    }
  });
}

shaftcull_status shaftcull_bounds_copy(const shaftcull_bounds* bounds, shaftcull_bounds** copy) {
  return guarded([&] {
    shaftcull_bounds*& out = given(copy, "copy");
    out = new shaftcull_bounds(given(bounds, "bounds"));
  });
}

void shaftcull_bounds_free(shaftcull_bounds* bounds) { delete bounds; }

shaftcull_status shaftcull_bounds_describe(const shaftcull_bounds* bounds, shaftcull_bounds_info* info) {
  return guarded([&] {
    shaftcull_bounds_info& out = given(info, "info");
    const shaftcull_bounds& all = given(bounds, "bounds");
    std::visit(
        [&]<class Holder>(const Holder& holder) {
          out = {};
          out.kind = kind_of<Holder>();
          out.count = streams_of(holder).count;
          out.holder = View<Holder> ? SHAFTCULL_VIEW : Stream<Holder> ? SHAFTCULL_STREAM : SHAFTCULL_TREE;
          out.memory_bytes = all.layers.size() * sizeof(uint32_t);
          out.has_layers = all.layers.empty() ? 0 : 1;
          if constexpr (!View<Holder>) out.memory_bytes += holder.memory_bytes();
          if constexpr (requires { holder.needs_refit(); }) {
            out.needs_refit = holder.needs_refit() ? 1 : 0;
            out.has_layers = holder.has_layers() ? 1 : 0;
          }
        },
        all.holder);
  });
}

shaftcull_status shaftcull_bounds_streams(const shaftcull_bounds* bounds, const float* streams[9]) {
  return guarded([&] {
    (void)given(streams, "streams");
    std::visit(
        [&](const auto& holder) {
          const auto view = streams_of(holder);
          std::fill(std::copy(view.stream.begin(), view.stream.end(), streams), streams + 9, nullptr);
        },
        given(bounds, "bounds").holder);
  });
}

}  // extern "C"
