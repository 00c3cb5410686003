// SPDX-License-Identifier: MIT
/// Patches and occluders as Python gives them.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "module.hpp"
#include "shaftcull/solids.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull::python {

/// A set of patches: of arrays, or the one that shaftcull.Patches holds. Errors name the arguments.
PatchSet patches_in(const py::object& boxes, const py::object& planes, const Rounding& rounding,
                    const std::string& name, const std::string& planes_name, PatchSides sides = PatchSides::front);

/// What Python knows as shaftcull.Occluders. It never changes.
struct OccludersHolder {
  std::shared_ptr<const Occluders> all;
  std::vector<std::pair<std::string, std::size_t>> first;  ///< the number of each argument's first occluder
  std::vector<std::pair<std::string, std::size_t>> found;  ///< how many solids of each kind were found in triangles
};

/// All arguments that name occluders, except boxes.
struct OccluderArguments {
  const py::object& solids;
  const py::object& hulls;
  const py::object& polygons;
  const py::object& triangles;
  const py::object& faces;
  const py::object& groups;
  std::optional<SolidSearch> search = std::nullopt;  ///< for solids in the triangles
};

/// All occluders: of arrays, or those that shaftcull.Occluders holds. Errors name the arguments.
OccludersHolder occluders_in(const py::object& boxes, const OccluderArguments& more, const Rounding& rounding);

}  // namespace shaftcull::python
