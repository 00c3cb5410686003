// SPDX-License-Identifier: MIT
/// Arrays of shafts.
#include <algorithm>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "arguments.hpp"
#include "sources.hpp"
#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::BatchPlanes;
using shaftcull::CompiledShaft;
using shaftcull::IndexPair;
using shaftcull::Plane;

namespace {

/// Called when shafts that refer to no hull have overwritten [first, first + count).
void let_go_of_hulls(shaftcull_shafts& shafts, std::uint64_t first, std::size_t count) noexcept {
  if (shafts.hulls.empty()) return;
  std::fill_n(shafts.hulls.begin() + static_cast<std::ptrdiff_t>(first), count, nullptr);
}

/// Sets `count` shafts, which `make` writes to the span that it gets.
template <class Make>
void set_range(shaftcull_shafts* shafts, std::uint64_t first, std::uint64_t count, Make&& make) {
  const std::span<CompiledShaft> out = shafts_from(shafts, first, count);
  make(out);
  let_go_of_hulls(*shafts, first, out.size());
}

/// Sets shafts for pairs of boxes: make(boxes a, boxes b, out, planes, pairs…), where pairs are left out if there is
/// one shaft for each two boxes at the same position.
template <class Make>
shaftcull_status set_pairs(shaftcull_shafts* shafts, std::uint64_t first, std::uint64_t count,
                           const shaftcull_source* a, const char* name_a, const shaftcull_source* b, const char* name_b,
                           const shaftcull_index_pair* pairs, const shaftcull_batch_planes* planes,
                           Make&& make) noexcept {
  return guarded([&] {
    const BoxesInStreams boxes_a(a, name_a);
    const BoxesInStreams boxes_b(b, name_b);
    static constexpr shaftcull_batch_planes no_planes{};
    const shaftcull_batch_planes& each = planes == nullptr ? no_planes : *planes;
    const std::vector<Plane> planes_a = as_planes(each.a, each.a_count, "planes.a");
    const std::vector<Plane> planes_b = as_planes(each.b, each.b_count, "planes.b");
    const BatchPlanes all_planes{planes_a, planes_b};
    set_range(shafts, first, count, [&](std::span<CompiledShaft> out) {
      if (pairs == nullptr && count != 0) {
        make(boxes_a.view(), boxes_b.view(), out, all_planes);
      } else {
        make(boxes_a.view(), boxes_b.view(), out, all_planes, copied<IndexPair>(pairs, count, "pairs"));
      }
    });
  });
}

/// Sets shafts of moving bodies: make(bodies, vectors, out, planes).
template <class Make>
shaftcull_status set_moving(shaftcull_shafts* shafts, std::uint64_t first, std::uint64_t count,
                            const shaftcull_source* bodies, const float* vectors, const char* name,
                            const shaftcull_plane* planes, std::uint64_t plane_count, Make&& make) noexcept {
  return guarded([&] {
    const BoxesInStreams boxes(bodies, "bodies");
    set_range(shafts, first, count, [&](std::span<CompiledShaft> out) {
      make(boxes.view(), as_vectors(vectors, count, name), out, as_planes(planes, plane_count, "planes"));
    });
  });
}

}  // namespace

extern "C" {

shaftcull_status shaftcull_shafts_create(uint64_t count, shaftcull_shafts** shafts) {
  return guarded([&] {
    shaftcull_shafts*& out = given(shafts, "shafts");
    auto array = std::make_unique<shaftcull_shafts>();
    array->compiled.resize(as_count(count, sizeof(CompiledShaft), "shafts"));
    out = array.release();
  });
}

void shaftcull_shafts_free(shaftcull_shafts* shafts) { delete shafts; }

shaftcull_status shaftcull_shafts_copy(shaftcull_shafts* shafts, uint64_t first, const shaftcull_shafts* source,
                                       uint64_t source_first, uint64_t count) {
  return guarded([&] {
    const std::span<const CompiledShaft> from = shafts_from(&given(source, "source"), source_first, count);
    const std::span<CompiledShaft> to = shafts_from(shafts, first, count);
    if (!source->hulls.empty()) shafts->hulls.resize(shafts->compiled.size());  // the one thing here that may throw
    const bool backwards = shafts == source && first > source_first;
    const auto copy = [backwards](const auto begin, const auto end, const auto target) {
      if (backwards) {
        std::copy_backward(begin, end, target + (end - begin));
      } else {
        std::copy(begin, end, target);
      }
    };
    copy(from.begin(), from.end(), to.begin());
    if (source->hulls.empty()) {
      let_go_of_hulls(*shafts, first, to.size());
    } else {
      const auto hulls = source->hulls.begin() + static_cast<std::ptrdiff_t>(source_first);
      copy(hulls, hulls + static_cast<std::ptrdiff_t>(count),
           shafts->hulls.begin() + static_cast<std::ptrdiff_t>(first));
    }
  });
}

shaftcull_status shaftcull_shafts_describe(const shaftcull_shafts* shafts, uint64_t shaft,
                                           shaftcull_shafts_info* info) {
  return guarded([&] {
    const CompiledShaft& compiled = shaft_at(shafts, shaft);
    shaftcull_shafts_info& out = given(info, "info");
    out.a = converted<shaftcull_box>(compiled.a());
    out.b = converted<shaftcull_box>(compiled.b());
    out.formed = compiled.formed() ? 1 : 0;
    out.has_planes = compiled.has_planes() ? 1 : 0;
    out.contact = static_cast<uint32_t>(compiled.contact());
    out.is_hull = !shafts->hulls.empty() && shafts->hulls[static_cast<std::size_t>(shaft)] != nullptr ? 1 : 0;
  });
}

shaftcull_status shaftcull_shafts_set_between(shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                              const shaftcull_source* a, const shaftcull_source* b,
                                              const shaftcull_index_pair* pairs, const shaftcull_batch_planes* planes,
                                              shaftcull_contact contact) {
  return set_pairs(shafts, first, count, a, "a", b, "b", pairs, planes,
                   [contact](const auto& from, const auto& to, std::span<CompiledShaft> out, const auto& added,
                             const auto&... named) {
                     shaftcull::compile_batch(from, to, named..., out, added, as_contact(contact));
                   });
}

shaftcull_status shaftcull_shafts_set_swept(shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                            const shaftcull_source* bodies, const float* displacements,
                                            shaftcull_sweep sweep, const shaftcull_plane* planes,
                                            uint64_t plane_count) {
  return set_moving(
      shafts, first, count, bodies, displacements, "displacements", planes, plane_count,
      [sweep](const auto&... arguments) {
        switch (sweep) {
          case SHAFTCULL_SWEPT:
            return shaftcull::swept_batch(arguments...);
          case SHAFTCULL_SWEPT_INFINITE:
            return shaftcull::swept_infinite_batch(arguments...);
          default:
            refuse("sweep = " + std::to_string(sweep) + " is neither SHAFTCULL_SWEPT nor SHAFTCULL_SWEPT_INFINITE");
        }
      });
}

shaftcull_status shaftcull_shafts_set_shadow(shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                             const shaftcull_source* lights, const shaftcull_source* occluders,
                                             const shaftcull_index_pair* pairs, const float* reach,
                                             const shaftcull_batch_planes* planes) {
  return set_pairs(shafts, first, count, lights, "lights", occluders, "occluders", pairs, planes,
                   [reach](const auto& from, const auto& over, std::span<CompiledShaft> out, const auto& added,
                           const auto&... named) {
                     if (reach == nullptr) {
                       shaftcull::shadow_batch(from, over, named..., out, added);
                     } else {
                       shaftcull::shadow_batch(from, over, named..., *reach, out, added);
                     }
                   });
}

shaftcull_status shaftcull_shafts_set_hull(shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_hull* hull) {
  return guarded([&] {
    CompiledShaft& out = shaft_at(shafts, shaft);
    const auto& shared = given(hull, "hull").hull;
    shafts->hulls.resize(shafts->compiled.size());
    out = shared->compiled();
    shafts->hulls[static_cast<std::size_t>(shaft)] = shared;
  });
}

shaftcull_status shaftcull_shafts_complete(shaftcull_shafts* shafts, uint64_t first, uint64_t count) {
  return guarded([&] {
    for (CompiledShaft& shaft : shafts_from(shafts, first, count)) shaftcull::complete(shaft);
  });
}

shaftcull_status shaftcull_shafts_set_contact(shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                              shaftcull_contact contact) {
  return guarded([&] { shaftcull::set_contact(shafts_from(shafts, first, count), as_contact(contact)); });
}

}  // extern "C"
