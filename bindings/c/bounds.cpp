// SPDX-License-Identifier: MIT
/// Views, streams and trees: making, updating and describing them, and their layers.
#include <algorithm>
#include <limits>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "sources.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::Box;
using shaftcull::BoxStream;
using shaftcull::BoxTree;
using shaftcull::BoxView;
using shaftcull::Sphere;
using shaftcull::SphereStream;
using shaftcull::SphereTree;
using shaftcull::SphereView;
using shaftcull::Triangle;
using shaftcull::TriangleStream;
using shaftcull::TriangleTree;
using shaftcull::TriangleView;

namespace {

template <class Holder>
constexpr shaftcull_bound_kind kind_of() {
  if constexpr (Dynamic<Holder> || Snapshot<Holder>) {
    using State = std::remove_cvref_t<decltype(state_of(std::declval<const Holder&>()))>;
    return std::same_as<State, shaftcull::BoxTreeSnapshot> ? SHAFTCULL_BOXES : SHAFTCULL_SPHERES;
  } else {
    using Streams = decltype(streams_of(std::declval<const Holder&>()));
    if (std::same_as<Streams, BoxView>) return SHAFTCULL_BOXES;
    return std::same_as<Streams, SphereView> ? SHAFTCULL_SPHERES : SHAFTCULL_TRIANGLES;
  }
}

template <class Holder>
constexpr shaftcull_holder holder_of() {
  if (View<Holder>) return SHAFTCULL_VIEW;
  if (Stream<Holder>) return SHAFTCULL_STREAM;
  if (Dynamic<Holder>) return SHAFTCULL_DYNAMIC_TREE;
  return Snapshot<Holder> ? SHAFTCULL_SNAPSHOT : SHAFTCULL_TREE;
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

/// Bounds in the first of these holders that can be made of the source.
template <class Boxes, class Spheres, class Triangles>
shaftcull_bounds* new_bounds(const shaftcull_source* source) {
  shaftcull_bounds* made = nullptr;
  (void)use_source(as_source(source, "source"), [&made]<class Records>(const Records& records) {
    if constexpr (std::is_constructible_v<Boxes, const Records&>) {
      made = new shaftcull_bounds{Boxes(records)};
    } else if constexpr (std::is_constructible_v<Spheres, const Records&>) {
      made = new shaftcull_bounds{Spheres(records)};
    } else {
      made = new shaftcull_bounds{Triangles(records)};
    }
  });
  return made;
}

/// A stream of as many empty bounds as the source has records.
shaftcull_bounds* new_empty_stream(const shaftcull_source& source) {
  switch (source.kind) {
    case SHAFTCULL_SOURCE_SPHERES:
      return new shaftcull_bounds{SphereStream(as_count(source.count, sizeof(Sphere), "spheres"))};
    case SHAFTCULL_SOURCE_TRIANGLES:
      return new shaftcull_bounds{TriangleStream(as_count(source.count, sizeof(Triangle), "triangles"))};
    default:
      return new shaftcull_bounds{BoxStream(as_count(source.count, sizeof(Box), "boxes"))};
  }
}

/// Puts bounds with these indices into other layers.
void change_layers(std::vector<std::uint32_t>& all, std::span<const std::uint32_t> indices,
                   std::span<const std::uint32_t> layers) {
  if (indices.empty()) return;
  if (all.empty()) refuse("bounds have no layers; give all of them some first, with NULL for indices");
  for (std::size_t i = 0; i != indices.size(); ++i) {
    if (indices[i] >= all.size()) {
      refuse("indices[" + std::to_string(i) + "] = " + std::to_string(indices[i]) +
             " is not below the number of bounds that have layers, " + std::to_string(all.size()));
    }
  }
  for (std::size_t i = 0; i != indices.size(); ++i) all[indices[i]] = layers[i];
}

}  // namespace

std::string shaftcull::binding::name_of(const shaftcull_bounds& bounds) {
  return std::visit(
      []<class Holder>(const Holder& /*holder*/) {
        static constexpr const char* kinds[] = {"boxes", "spheres", "triangles"};
        static constexpr const char* holders[] = {"a view of ", "a stream of ", "a tree of ", "a dynamic tree of ",
                                                  "a snapshot of "};
        return std::string(holders[holder_of<Holder>() - 1]) + kinds[kind_of<Holder>() - 1];
      },
      bounds.holder);
}

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

shaftcull_status shaftcull_stream_create(const shaftcull_source* source, shaftcull_bounds** bounds) {
  return guarded([&] {
    shaftcull_bounds*& out = given(bounds, "bounds");
    out = has_no_data(given(source, "source"), "source") ? new_empty_stream(*source)
                                                         : new_bounds<BoxStream, SphereStream, TriangleStream>(source);
  });
}

shaftcull_status shaftcull_tree_create(const shaftcull_source* source, shaftcull_bounds** tree) {
  return guarded([&] {
    shaftcull_bounds*& out = given(tree, "tree");
    out = new_bounds<BoxTree, SphereTree, TriangleTree>(source);
  });
}

shaftcull_status shaftcull_bounds_copy(const shaftcull_bounds* bounds, shaftcull_bounds** copy) {
  return guarded([&] {
    shaftcull_bounds*& out = given(copy, "copy");
    const shaftcull_bounds& all = given(bounds, "bounds");
    out = std::visit(
        [&all]<class Holder>(const Holder& holder) {
          if constexpr (Dynamic<Holder>) {
            return new shaftcull_bounds{holder.snapshot()};
          } else {
            return new shaftcull_bounds{holder, all.layers};
          }
        },
        all.holder);
  });
}

void shaftcull_bounds_free(shaftcull_bounds* bounds) { delete bounds; }

shaftcull_status shaftcull_bounds_update(shaftcull_bounds* bounds, uint64_t first, const shaftcull_source* source) {
  return guarded([&] {
    shaftcull_bounds& all = given(bounds, "bounds");
    const Source from = as_source(source, "source");
    const bool fits = std::visit(
        [&]<class Holder>(Holder& holder) {
          if constexpr (Stream<Holder>) {
            return use_source(
                from, [&](const auto& records) requires requires { holder.update(0, records); } {
                  holder.update(as_size(first, "first"), records);
                });
          } else if constexpr (ChangingTree<Holder>) {
            if (first != 0) {
              refuse("first = " + std::to_string(first) + "; all bounds of a tree are updated, from 0 on" +
                     " (shaftcull_tree_update_some() updates some)");
            }
            return use_source(
                from, [&](const auto& records) requires requires { holder.update(records); } {
                  holder.update(records);
                });
          } else {
            return false;
          }
        },
        all.holder);
    if (!fits) {
      refuse("bounds are " + name_of(all) +
             "; a stream, or a tree that is not dynamic, is updated by a source of its " + "own kind of bounds");
    }
  });
}

shaftcull_status shaftcull_bounds_set_layers(shaftcull_bounds* bounds, const uint32_t* indices, const uint32_t* layers,
                                             uint64_t count) {
  return guarded([&] {
    shaftcull_bounds& all = given(bounds, "bounds");
    const std::span<const uint32_t> which = as_span_if_given(indices, count, "indices");
    const std::span<const uint32_t> from =
        indices == nullptr ? as_span_if_given(layers, count, "layers") : as_span(layers, count, "layers");
    std::visit(
        [&]<class Holder>(Holder& holder) {
          if constexpr (Dynamic<Holder>) {
            if (indices == nullptr) refuse("indices is NULL; for a dynamic tree it must name the bounds of the layers");
            std::vector<shaftcull::BoundId> ids;
            for (std::size_t i = 0; i != which.size(); ++i) {
              ids.push_back(holder.id_of(which[i]));
              if (ids.back().index != shaftcull::BoundId::none) continue;
              refuse("indices[" + std::to_string(i) + "] = " + std::to_string(which[i]) + " has no bound");
            }
            for (std::size_t i = 0; i != ids.size(); ++i) holder.set_layers(ids[i], from[i]);
          } else if constexpr (Snapshot<Holder>) {
            refuse("bounds are " + name_of(all) + ", which never changes");
          } else if constexpr (std::same_as<Holder, TriangleTree>) {
            refuse("bounds are " + name_of(all) + ", which has no layers; a view or stream of triangles may have some");
          } else if (indices != nullptr) {
            if constexpr (ChangingTree<Holder>) {
              holder.set_layers(which, from);
            } else {
              change_layers(all.layers, which, from);
            }
          } else if (const std::size_t size = streams_of(holder).count; count != size) {
            refuse("count = " + std::to_string(count) + ", and bounds are " + name_of(all) + " with " +
                   std::to_string(size) + " of them; without indices, there must be layers for each");
          } else if constexpr (!ChangingTree<Holder>) {
            all.layers = std::vector<std::uint32_t>(from.begin(), from.end());  // `from` may be the same memory
          } else if (layers != nullptr) {
            holder.set_layers(from);
          } else {
            holder.clear_layers();
          }
        },
        all.holder);
  });
}

shaftcull_status shaftcull_bounds_describe(const shaftcull_bounds* bounds, shaftcull_bounds_info* info) {
  return guarded([&] {
    shaftcull_bounds_info& out = given(info, "info");
    const shaftcull_bounds& all = given(bounds, "bounds");
    std::visit(
        [&]<class Holder>(const Holder& holder) {
          constexpr float infinity = std::numeric_limits<float>::infinity();
          out = {};
          out.memory_bytes = all.layers.size() * sizeof(uint32_t);
          out.layers = first_of(std::span(all.layers));
          out.box = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
          out.kind = kind_of<Holder>();
          out.holder = holder_of<Holder>();
          if constexpr (Dynamic<Holder> || Snapshot<Holder>) {
            out.count = state_of(holder).index_end();
            out.box = converted<shaftcull_box>(state_of(holder).box());
          } else {
            const auto streams = streams_of(holder);
            out.count = streams.count;
            std::copy(streams.stream.begin(), streams.stream.end(), out.streams);
          }
          if constexpr (requires { holder.memory_bytes(); }) out.memory_bytes += holder.memory_bytes();
          if constexpr (ChangingTree<Holder>) out.needs_refit = holder.needs_refit() ? 1 : 0;
          if constexpr (requires { holder.layers(); }) out.layers = first_of(holder.layers());
          if constexpr (requires { holder.order(); }) {
            out.order = first_of(holder.order());
            if (out.needs_refit == 0) out.box = converted<shaftcull_box>(holder.box());
          }
        },
        all.holder);
  });
}

}  // extern "C"
