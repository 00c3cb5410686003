// SPDX-License-Identifier: MIT
/// list_many(), list_classified_many() and list_blocking_many() of boxes and spheres.
#include <array>
#include <cstddef>

#include "flat/batch_job.hpp"
#include "flat/list_rows.hpp"
#include "shaftcull/blocked.hpp"
#include "shaftcull/many.hpp"

namespace SHAFTCULL_INTERFACE shaftcull {
namespace {

/// Lists bounds of one kind, those kept, or of two: those that overlap and those inside.
template <class View, std::size_t kinds>
void list_rows(std::span<const CompiledShaft> shafts, const View& bounds, const std::array<IndexLists*, kinds>& lists,
               const char* call,
               kernel::Bits kind_of_bits = kinds == 2 ? kernel::Bits::kept_and_inside : kernel::Bits::kept) {
  const kernel::BatchJob<View> job(shafts, bounds, kind_of_bits);
  kernel::require_index_width(call, bounds.count);
  kernel::list_rows(job, lists);
}

template <class View>
void list_kept(std::span<const CompiledShaft> shafts, const View& bounds, IndexLists& lists) {
  list_rows<View, 1>(shafts, bounds, {&lists}, "list_many()");
}

template <class View>
void list_classes(std::span<const CompiledShaft> shafts, const View& bounds, IndexLists& overlap, IndexLists& inside) {
  if (&overlap == &inside) kernel::refuse_shared_memory("list_classified_many", "overlap", "inside");
  list_rows<View, 2>(shafts, bounds, {&overlap, &inside}, "list_classified_many()");
}

}  // namespace

void list_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, IndexLists& lists) {
  list_kept(shafts, boxes, lists);
}
void list_many(std::span<const CompiledShaft> shafts, const SphereView& spheres, IndexLists& lists) {
  list_kept(shafts, spheres, lists);
}

void list_classified_many(std::span<const CompiledShaft> shafts, const BoxView& boxes, IndexLists& overlap,
                          IndexLists& inside) {
  list_classes(shafts, boxes, overlap, inside);
}
void list_classified_many(std::span<const CompiledShaft> shafts, const SphereView& spheres, IndexLists& overlap,
                          IndexLists& inside) {
  list_classes(shafts, spheres, overlap, inside);
}

void list_blocking_many(std::span<const CompiledShaft> shafts, const BoxView& solids, IndexLists& lists) {
  list_rows<BoxView, 1>(shafts, solids, {&lists}, "list_blocking_many()", kernel::Bits::blocking);
}

}  // namespace shaftcull
