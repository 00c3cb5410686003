// SPDX-License-Identifier: MIT
/// Arrays of test-ready shafts.
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

/// Shafts [first, first + count) were overwritten by such that refer to no hull.
void let_go_of_hulls(shaftcull_shafts& shafts, std::uint64_t first, std::size_t count) noexcept {
  if (shafts.hulls.empty()) return;
  std::fill_n(shafts.hulls.begin() + static_cast<std::ptrdiff_t>(first), count, nullptr);
}

/// Sets one shaft to what `make` makes.
template <class Make>
shaftcull_status set_one(shaftcull_shafts* shafts, std::uint64_t shaft, Make&& make) noexcept {
  return guarded([&] {
    CompiledShaft& out = shaft_at(shafts, shaft);
    out = make();
    let_go_of_hulls(*shafts, shaft, 1);
  });
}

/// Sets `count` shafts, which `make` writes to the span that it gets.
template <class Make>
void set_some(shaftcull_shafts* shafts, std::uint64_t first, std::uint64_t count, Make&& make) {
  const std::span<CompiledShaft> out = shafts_from(shafts, first, count);
  make(out);
  let_go_of_hulls(*shafts, first, out.size());
}

/// Planes of a batch, copied.
struct CopiedBatchPlanes {
  std::vector<Plane> a;
  std::vector<Plane> b;

  explicit CopiedBatchPlanes(const shaftcull_batch_planes* planes) {
    if (planes == nullptr) return;
    a = as_planes(planes->a, planes->a_count, "planes.a");
    b = as_planes(planes->b, planes->b_count, "planes.b");
  }
  [[nodiscard]] BatchPlanes get() const noexcept { return {a, b}; }
};

/// One of the batches of moving bodies: Batch is called with the views, vectors, shafts and planes.
template <class Batch>
void set_moving(shaftcull_shafts* shafts, std::uint64_t first, const shaftcull_source* bodies, const float* vectors,
                const char* name, const shaftcull_plane* planes, std::uint64_t plane_count, Batch&& batch) {
  const BatchBoxes boxes(bodies, "bodies");
  set_some(shafts, first, boxes.view().count, [&](std::span<CompiledShaft> out) {
    const std::vector<shaftcull::Vec3> copies = as_vectors(vectors, boxes.view().count, name);
    batch(boxes.view(), copies, out, as_planes(planes, plane_count, "planes"));
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

uint64_t shaftcull_shafts_count(const shaftcull_shafts* shafts) {
  return shafts == nullptr ? 0 : shafts->compiled.size();
}

shaftcull_status shaftcull_shafts_copy(shaftcull_shafts* shafts, uint64_t first, const shaftcull_shafts* source,
                                       uint64_t source_first, uint64_t count) {
  return guarded([&] {
    const std::span<const CompiledShaft> from = shafts_of(&given(source, "source"), source_first, count);
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
    out.form = static_cast<uint32_t>(compiled.form());
    out.is_hull = !shafts->hulls.empty() && shafts->hulls[static_cast<std::size_t>(shaft)] != nullptr ? 1 : 0;
  });
}

shaftcull_status shaftcull_shafts_set_between(shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_box* a,
                                              const shaftcull_box* b, shaftcull_contact contact) {
  return set_one(shafts, shaft,
                 [&] { return shaftcull::compile(as_box(a, "a"), as_box(b, "b"), as_contact(contact)); });
}

shaftcull_status shaftcull_shafts_set_formed(shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_shaft* formed) {
  return set_one(shafts, shaft, [&] { return shaftcull::compile(given(formed, "formed").formed); });
}

shaftcull_status shaftcull_shafts_set_swept(shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_box* body,
                                            const float displacement[3], const shaftcull_plane* planes,
                                            uint64_t plane_count) {
  return set_one(shafts, shaft, [&] {
    return shaftcull::swept(as_box(body, "body"), as_vector(displacement, "displacement"),
                            as_planes(planes, plane_count, "planes"));
  });
}

shaftcull_status shaftcull_shafts_set_swept_infinite(shaftcull_shafts* shafts, uint64_t shaft,
                                                     const shaftcull_box* body, const float direction[3],
                                                     const shaftcull_plane* planes, uint64_t plane_count) {
  return set_one(shafts, shaft, [&] {
    return shaftcull::swept_infinite(as_box(body, "body"), as_vector(direction, "direction"),
                                     as_planes(planes, plane_count, "planes"));
  });
}

shaftcull_status shaftcull_shafts_set_shadow(shaftcull_shafts* shafts, uint64_t shaft, const shaftcull_box* light,
                                             const shaftcull_box* occluder, const float* reach,
                                             const shaftcull_plane* planes, uint64_t plane_count) {
  return set_one(shafts, shaft, [&] {
    const std::vector<Plane> copies = as_planes(planes, plane_count, "planes");
    return reach == nullptr ? shaftcull::shadow(as_box(light, "light"), as_box(occluder, "occluder"), copies)
                            : shaftcull::shadow(as_box(light, "light"), as_box(occluder, "occluder"), *reach, copies);
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

shaftcull_status shaftcull_shafts_set_between_batch(shaftcull_shafts* shafts, uint64_t first, const shaftcull_source* a,
                                                    const shaftcull_source* b, const shaftcull_index_pair* pairs,
                                                    uint64_t pair_count, const shaftcull_batch_planes* planes,
                                                    shaftcull_contact contact) {
  return guarded([&] {
    const BatchBoxes boxes_a(a, "a");
    const BatchBoxes boxes_b(b, "b");
    const CopiedBatchPlanes copies(planes);
    set_some(shafts, first, pair_count, [&](std::span<CompiledShaft> out) {
      if (pairs == nullptr && pair_count != 0) {
        shaftcull::compile_batch(boxes_a.view(), boxes_b.view(), out, copies.get(), as_contact(contact));
      } else {
        shaftcull::compile_batch(boxes_a.view(), boxes_b.view(), copied<IndexPair>(pairs, pair_count, "pairs"), out,
                                 copies.get(), as_contact(contact));
      }
    });
  });
}

shaftcull_status shaftcull_shafts_set_swept_batch(shaftcull_shafts* shafts, uint64_t first,
                                                  const shaftcull_source* bodies, const float* displacements,
                                                  const shaftcull_plane* planes, uint64_t plane_count) {
  return guarded([&] {
    set_moving(shafts, first, bodies, displacements, "displacements", planes, plane_count,
               [](auto&&... arguments) { shaftcull::swept_batch(arguments...); });
  });
}

shaftcull_status shaftcull_shafts_set_swept_infinite_batch(shaftcull_shafts* shafts, uint64_t first,
                                                           const shaftcull_source* bodies, const float* directions,
                                                           const shaftcull_plane* planes, uint64_t plane_count) {
  return guarded([&] {
    set_moving(shafts, first, bodies, directions, "directions", planes, plane_count,
               [](auto&&... arguments) { shaftcull::swept_infinite_batch(arguments...); });
  });
}

shaftcull_status shaftcull_shafts_set_shadow_batch(shaftcull_shafts* shafts, uint64_t first,
                                                   const shaftcull_source* lights, const shaftcull_source* occluders,
                                                   const shaftcull_index_pair* pairs, uint64_t pair_count,
                                                   const float* reach, const shaftcull_batch_planes* planes) {
  return guarded([&] {
    const BatchBoxes from(lights, "lights");
    const BatchBoxes over(occluders, "occluders");
    const CopiedBatchPlanes copies(planes);
    set_some(shafts, first, pair_count, [&](std::span<CompiledShaft> out) {
      if (pairs == nullptr && pair_count != 0) {
        if (reach == nullptr) {
          shaftcull::shadow_batch(from.view(), over.view(), out, copies.get());
        } else {
          shaftcull::shadow_batch(from.view(), over.view(), *reach, out, copies.get());
        }
        return;
      }
      const std::vector<IndexPair> indices = copied<IndexPair>(pairs, pair_count, "pairs");
      if (reach == nullptr) {
        shaftcull::shadow_batch(from.view(), over.view(), indices, out, copies.get());
      } else {
        shaftcull::shadow_batch(from.view(), over.view(), indices, *reach, out, copies.get());
      }
    });
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

shaftcull_status shaftcull_shafts_set_form(shaftcull_shafts* shafts, uint64_t first, uint64_t count,
                                           shaftcull_form form) {
  return guarded([&] { shaftcull::set_form(shafts_from(shafts, first, count), as_form(form)); });
}

}  // extern "C"
