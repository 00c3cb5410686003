// SPDX-License-Identifier: MIT
/// Lists that the library allocates.
#include <cstdint>

#include "arguments.hpp"
#include "status.hpp"

using namespace shaftcull::binding;

extern "C" {

shaftcull_status shaftcull_lists_create(shaftcull_lists** lists) {
  return guarded([&] {
    shaftcull_lists*& out = given(lists, "lists");
    out = new shaftcull_lists{};
  });
}

void shaftcull_lists_free(shaftcull_lists* lists) { delete lists; }

uint64_t shaftcull_lists_count(const shaftcull_lists* lists) { return lists == nullptr ? 0 : lists->lists.size(); }

const uint64_t* shaftcull_lists_offsets(const shaftcull_lists* lists) {
  return lists == nullptr || lists->lists.offsets.empty() ? nullptr : lists->lists.offsets.data();
}

const uint32_t* shaftcull_lists_indices(const shaftcull_lists* lists) {
  return lists == nullptr || lists->lists.indices.empty() ? nullptr : lists->lists.indices.data();
}

}  // extern "C"
