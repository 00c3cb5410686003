// SPDX-License-Identifier: MIT
#include "lists.hpp"

#include <cstdint>

#include "status.hpp"

using namespace shaftcull::binding;
using shaftcull::IndexLists;

namespace {

/// The elements of lists, if these are of the type Lists and there are any.
template <class Lists, class Elements>
const auto* elements_of(const shaftcull_lists* lists, Elements&& elements) {
  const Lists* const found = lists == nullptr ? nullptr : std::get_if<Lists>(&lists->lists);
  return found == nullptr || elements(*found).empty() ? nullptr : elements(*found).data();
}

}  // namespace

extern "C" {

shaftcull_status shaftcull_lists_create(shaftcull_lists_kind kind, shaftcull_lists** lists) {
  return guarded([&] {
    shaftcull_lists*& out = given(lists, "lists");
    switch (kind) {
      case SHAFTCULL_LISTS_OF_INDICES:
        out = new shaftcull_lists{IndexLists()};
        break;
      case SHAFTCULL_LISTS_OF_RANGES:
        out = new shaftcull_lists{RangeLists()};
        break;
      default:
        refuse("kind = " + std::to_string(kind) +
               " is none of SHAFTCULL_LISTS_OF_INDICES and SHAFTCULL_LISTS_OF_RANGES");
    }
  });
}

void shaftcull_lists_free(shaftcull_lists* lists) { delete lists; }

uint64_t shaftcull_lists_count(const shaftcull_lists* lists) {
  if (lists == nullptr) return 0;
  return std::visit([](const auto& of) -> uint64_t { return of.offsets.empty() ? 0 : of.offsets.size() - 1; },
                    lists->lists);
}

const uint64_t* shaftcull_lists_offsets(const shaftcull_lists* lists) {
  if (lists == nullptr) return nullptr;
  return std::visit([](const auto& of) { return of.offsets.empty() ? nullptr : of.offsets.data(); }, lists->lists);
}

const uint32_t* shaftcull_lists_indices(const shaftcull_lists* lists) {
  return elements_of<IndexLists>(
      lists, [](const auto& of) -> const auto& { return of.indices; });
}

const shaftcull_leaf_range* shaftcull_lists_ranges(const shaftcull_lists* lists) {
  return elements_of<RangeLists>(
      lists, [](const auto& of) -> const auto& { return of.ranges; });
}

}  // extern "C"
