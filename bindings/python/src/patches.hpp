// SPDX-License-Identifier: MIT
/// Patches and occluders as Python gives them.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "arrays.hpp"
#include "module.hpp"
#include "shaftcull/visibility.hpp"

namespace shaftcull::python {

/// Boxes of an argument in streams. Errors name the argument.
class BoxesInStreams {
 public:
  BoxesInStreams(const py::object& given, const std::string& name) : in_(boxes_in(given, name)) {
    try {
      if (const BoxView* const view = std::get_if<BoxView>(&in_.where)) {
        view_ = *view;
      } else {
        packed_ = BoxStream(std::get<StridedBoxes>(in_.where));
        view_ = packed_.view();
      }
    } catch (const BadBound& bad) {
      const std::string what = bad.what();
      // Streams also take the empty box, which can be no patch and no occluder.
      throw BadBound(bad.index(), name + ": " + what.substr(0, what.find(", or the box empty")));
    }
  }
  [[nodiscard]] const BoxView& view() const noexcept { return view_; }

 private:
  BoxesIn in_;
  BoxStream packed_;
  BoxView view_;
};

/// A set of patches: of arrays, or the one that shaftcull.Patches holds. Errors name the arguments.
PatchSet patches_in(const py::object& boxes, const py::object& planes, const std::string& name,
                    const std::string& planes_name);

/// What Python knows as shaftcull.Occluders. It never changes.
struct OccludersHolder {
  std::shared_ptr<const Occluders> all;
  std::vector<std::pair<std::string, std::size_t>> first;  ///< what each argument's first occluder is
};

/// The arguments that say what stands between.
struct OccluderArguments {
  const py::object& solids;
  const py::object& hulls;
  const py::object& polygons;
  const py::object& triangles;
  const py::object& faces;
  const py::object& groups;
};

/// Everything that stands between: of arrays, or what shaftcull.Occluders holds. Errors name the arguments.
OccludersHolder occluders_in(const py::object& boxes, const OccluderArguments& more);

/// Its patches in the order of its tree, as Python sees them.
[[nodiscard]] py::array order_of(const PatchSet& set);

void add_patches(py::module_& module);
void add_occluders(py::module_& module);

}  // namespace shaftcull::python
