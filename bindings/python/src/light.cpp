// SPDX-License-Identifier: MIT
#include <cstddef>
#include <cstdint>
#include <span>

#include "arrays.hpp"
#include "bounds_in.hpp"
#include "interrupts.hpp"
#include "module.hpp"
#include "patches.hpp"
#include "shaftcull/rays.hpp"

namespace shaftcull::python {

using py::arg;

void add_light(py::module_& module) {
  const py::object none = py::none();
  module.def(
      "lit_fractions",
      [](const py::object& patches, const py::object& directions, const py::object& planes, const py::object& occluders,
         const py::object& triangles, const py::object& faces, std::uint32_t rays, double error, std::uint64_t seed,
         float tolerance) {
        const Rounding exact = rounding_in(py::none());
        const PatchSet set = patches_in(patches, planes, exact, "patches", "planes");
        const VectorsIn lights = vectors_in(directions, "directions");
        const py::object nothing = py::none();
        const OccludersHolder between =
            occluders_in(occluders, {nothing, nothing, nothing, triangles, faces, nothing}, exact);
        const std::span<const Vec3> towards = lights.vectors;
        py::array_t<float> fractions({set.size(), towards.size()});
        const std::span<float> written(fractions.mutable_data(), set.size() * towards.size());
        begin_parallel();
        {
          const py::gil_scoped_release release;
          lit_fractions(set, *between.all, towards, written,
                        {.rays = rays, .error = error, .seed = seed, .tolerance = tolerance});
        }
        return fractions;
      },
      arg("patches"), arg("directions"), py::kw_only(), arg("planes") = none, arg("occluders") = none,
      arg("triangles") = none, arg("faces") = none, arg("rays") = RayOptions().rays, arg("error") = RayOptions().error,
      arg("seed") = RayOptions().seed, arg("tolerance") = RayOptions().tolerance, R"(
The fraction of each patch that is lit from each direction, by rays: float32 (n, m), from 0 to 1. 0 if the
patch faces away. If each direction to the sun stands for some hours, lit @ hours are the hours of sun.

patches, planes, occluders, triangles, faces: as for view_factors(), but Patches may have sides='both'.
directions: directions to lights that are infinitely far away, float32 (m, 3), of any length.
rays: the number of rays from a patch to each light, 1 to 65536. error: a patch gets fewer rays if its
    standard error is at most this.
seed: determines the points. tolerance: as for visibility().

TypeError, ValueError, IndexError or BadBound names the argument that does not fit. Runs on all processors.
Other threads of Python continue. RuntimeError in a child of fork() whose parent has made parallel calls.)");
}

}  // namespace shaftcull::python
