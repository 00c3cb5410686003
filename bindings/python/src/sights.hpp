// SPDX-License-Identifier: MIT
/// What visibility() found, as Python sees it.
#pragma once

#include <cstdint>

#include "module.hpp"
#include "patches.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull::python {

/// Kinds of pairs by name.
[[nodiscard]] py::dict counts_of(const SightCounts& counts);

/// What Python knows as shaftcull.Visibility.
struct Sights {
  Visibility all;
  PatchSet a;
  PatchSet b;
  bool of_one_set;
  bool has_candidates;
  OccludersHolder occluders;

  /// Calls use(i, j) for each pair of a kind, by the user's indices.
  template <class Use>
  void for_each(Sight sight, Use&& use) const {
    for (const PairBlock& product : all.products) {
      if (product.sight != sight) continue;
      for (const std::uint32_t i : a.order().subspan(product.a.first, product.a.count)) {
        for (const std::uint32_t j : b.order().subspan(product.b.first, product.b.count)) use(i, j);
      }
    }
    if (sight != Sight::undecided) return;
    for (const PatchPair& pair : all.undecided) use(pair.a, pair.b);
  }
};

void add_sights(py::module_& module);

}  // namespace shaftcull::python
