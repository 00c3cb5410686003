// SPDX-License-Identifier: MIT
/// Patches that lie on a solid hull: the face that each lies in. The hull does not hide such a patch from one with a
/// corner in front of that face.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "exact/hull_mesh.hpp"
#include "kernels/siblings/siblings.hpp"
#include "visibility/patch_tree.hpp"

namespace shaftcull::kernel {

/// Of patches side by side, at most 64, those that have a face of a hull none of whose corners they are behind, and its
/// plane: a point with normal·p above the limit is certainly in front.
struct OwnFaces {
  std::uint64_t lanes = 0;
  alignas(64) float normal[3][most_siblings] = {};
  alignas(64) float limit[most_siblings] = {};
};

/// What was found of patches and hulls, as the same ones meet again and again.
class OwnFacesCache {
 public:
  /// Of the patches from `first` on, and a hull with that number. Null if none of them touches the box around it.
  const OwnFaces* of(const PatchTree& tree, std::uint32_t first, unsigned count, std::uint32_t hull,
                     const HullMesh& mesh, const BoxRow& around, float tolerance, float coordinate);

 private:
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  struct Known {
    const PatchTree* tree = nullptr;
    std::uint32_t first = 0;
    std::uint32_t hull = 0;
    std::uint32_t at = none;
  };

  std::vector<Known> known_;
  std::vector<OwnFaces> faces_;
};

}  // namespace shaftcull::kernel
