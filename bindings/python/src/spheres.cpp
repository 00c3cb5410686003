// SPDX-License-Identifier: MIT
#include "module.hpp"
#include "streams.hpp"

namespace shaftcull::python {

void add_sphere_streams(py::module_& module) {
  const auto in = [](const py::object& given, const std::string& name) { return spheres_in(given, name); };
  py::class_<Viewed<SphereView>, HolderOf<Sphere>> view(module, "SphereView", R"(
Spheres in arrays of the caller's, which are kept and never copied.

spheres: float32 whose columns are contiguous: (n, 4) in Fortran order; a tuple (centres, radii) of such (n, 3) and
    (n,); or a tuple of four (n,).

Values are not checked, and may change between questions.)");
  add_view<SphereView>(view, "SphereView", "spheres",
                       "a transpose of (4, n), numpy.asfortranarray(spheres), or four arrays (n,)", in);

  py::class_<Streamed<SphereStream>, HolderOf<Sphere>> stream(module, "SphereStream", R"(
A copy of spheres, checked, in separate aligned streams: 16 bytes per sphere.

spheres: float32 (n, 4): centre x, y, z and radius; a tuple (centres, radii) of (n, 3) and (n,); or a tuple of four
    (n,). BadBound, with the index, for NaN, a centre that is not finite, or a negative radius.)");
  add_stream<SphereStream>(stream, "SphereStream", "spheres", in);
}

}  // namespace shaftcull::python
