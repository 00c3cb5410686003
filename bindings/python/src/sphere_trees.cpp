// SPDX-License-Identifier: MIT
#include "module.hpp"
#include "trees.hpp"

namespace shaftcull::python {

void add_sphere_trees(py::module_& module) {
  py::class_<TreeOf<Sphere>, HolderOf<Sphere>> tree(module, "SphereTree", R"(
A tree over a copy of spheres, sorted by space. Answers equal those of a SphereStream.

spheres: float32 (n, 4): centre x, y, z and radius; a tuple (centres, radii) of (n, 3) and (n,); or a tuple of four
    (n,).

Many threads may ask at once. A change, such as update(), must be alone: RuntimeError otherwise.)");
  add_tree<Sphere>(tree, "SphereTree", "spheres");
}

}  // namespace shaftcull::python
