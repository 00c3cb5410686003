// SPDX-License-Identifier: MIT
#include "shaftcull/view_factors.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include "bounds_in.hpp"
#include "long_call.hpp"
#include "module.hpp"
#include "patches.hpp"
#include "results.hpp"
#include "shafts.hpp"

namespace shaftcull::python {
namespace {

using py::arg;

/// What Python knows as shaftcull.ViewFactors: arrays that own their memory.
struct Factors {
  py::array data;
  py::array indices;
  py::array indptr;
  py::array area;
  py::array sum;
  py::array error;
  py::array left_out;
  py::dict counts;
};

Factors factors_of(ViewFactors&& of) {
  std::vector<std::int32_t> indices(of.column.begin(), of.column.end());
  std::vector<std::int64_t> indptr(of.first.begin(), of.first.end());
  return {array_of(std::move(of.factor)),   array_of(std::move(indices)), array_of(std::move(indptr)),
          array_of(std::move(of.area)),     array_of(std::move(of.sum)),  array_of(std::move(of.error)),
          array_of(std::move(of.left_out)), counts_of(of.counts)};
}

void add_class(py::module_& module) {
  py::class_<Factors>(module, "ViewFactors", R"(
View factors of all pairs, as a sparse matrix in rows:
scipy.sparse.csr_array((f.data, f.indices, f.indptr), f.shape). Row i has the factors from patch i.)")
      .def_property_readonly(
          "data", [](const Factors& self) { return self.data; },
          "The factors, which are above 0, row by row: float64 (nnz,).")
      .def_property_readonly(
          "indices", [](const Factors& self) { return self.indices; },
          "The patch to which each factor is, ascending in a row: int32 (nnz,).")
      .def_property_readonly(
          "indptr", [](const Factors& self) { return self.indptr; },
          "Where the factors of each row begin; then the end of the last: int64 (n + 1,).")
      .def_property_readonly(
          "shape", [](const Factors& self) { return py::make_tuple(self.area.size(), self.area.size()); },
          "(n, n), for n patches.")
      .def_property_readonly(
          "area", [](const Factors& self) { return self.area; }, "The area of each patch: float64 (n,).")
      .def_property_readonly(
          "row_sum", [](const Factors& self) { return self.sum; },
          R"(
The sum of each row, left-out factors included: float64 (n,). 1 - row_sum is the share that meets no patch:
the sky.)")
      .def_property_readonly(
          "error", [](const Factors& self) { return self.error; },
          "The estimated standard error of each sum: float64 (n,).")
      .def_property_readonly(
          "left_out", [](const Factors& self) { return self.left_out; },
          "The part of each sum that is left out, because factors are below `least`: float64 (n,).")
      .def_property_readonly(
          "counts", [](const Factors& self) { return self.counts; },
          "The number of pairs that are 'undecided', 'clear', 'occluded' and 'facing_away': a dict of int.")
      .def("__repr__", [](const Factors& self) {
        return "<shaftcull.ViewFactors of " + std::to_string(self.area.size()) + " patches, " +
               std::to_string(self.data.size()) + " above 0>";
      });
}

}  // namespace

void add_view_factors(py::module_& module) {
  add_class(module);
  const py::object none = py::none();
  module.def(
      "view_factors",
      [](const py::object& patches, const py::object& planes, const py::object& occluders, const py::object& triangles,
         const py::object& faces, std::uint32_t rays, double error, std::uint64_t seed, double least, bool close_rows,
         float tolerance, std::size_t memory, std::uint32_t part, std::uint32_t parts, const py::object& progress) {
        const Rounding exact = rounding_in(py::none());
        const PatchSet set = patches_in(patches, planes, exact, "patches", "planes");
        const py::object nothing = py::none();
        std::optional<SolidSearch> search;
        if (!triangles.is_none()) search = SolidSearch{.region = set.box()};
        const OccludersHolder between =
            occluders_in(occluders, {nothing, nothing, nothing, triangles, faces, nothing, search}, exact);
        ViewFactorOptions options;
        options.rays = rays;
        options.error = error;
        options.seed = seed;
        options.least = least;
        options.close_rows = close_rows;
        options.tolerance = tolerance;
        options.memory = memory;
        options.part = part;
        options.parts = parts;
        return factors_of(while_hearing(
            options, progress, [&](const ViewFactorOptions& asked) { return view_factors(set, *between.all, asked); }));
      },
      arg("patches"), py::kw_only(), arg("planes") = none, arg("occluders") = none, arg("triangles") = none,
      arg("faces") = none, arg("rays") = ViewFactorOptions().rays, arg("error") = ViewFactorOptions().error,
      arg("seed") = ViewFactorOptions().seed, arg("least") = ViewFactorOptions().least, arg("close_rows") = false,
      arg("tolerance") = 0.0F, arg("memory") = ViewFactorOptions().memory, arg("part") = 0, arg("parts") = 1,
      arg("progress") = none, R"(
The view factors of every two patches. Clear pairs have view_factor(), and pairs that are occluded or face
away have 0. For all other pairs, rays estimate the factors. The result has the same bits for any number of
processors. Returns a ViewFactors.

patches: corners, float32 (n, k, 3), counterclockwise as seen from the side to which they radiate; flat
    boxes, float32 (n, 6), with planes; or Patches. planes: float32 (n, 4), or (4,) for all.
occluders: boxes, which count as solid; or Occluders. triangles with faces: the objects between patches,
    including the bodies that patches belong to, in place of Occluders; the call finds solids in them.
rays: the largest number of rays per pair, 1 to 65536. error: a pair gets fewer rays if the standard error of
    its factors is at most this. seed: determines the points of rays.
least: pairs both of whose factors are below this are left out; left_out has their sums.
close_rows: whether rows are scaled to sum to 1, as those of a closed room do; ValueError if the sums are far from
    1.
tolerance: as for visibility(). memory: limit in bytes for answers in progress, without the factors, 1 MB or
    more.
part, parts: as for visibility(). The sum of the matrices of all parts is the matrix of all pairs. row_sum and
    left_out are summed, too, and `error` is the square root of the sum of squares. `close_rows` needs parts=1.
progress: called as progress(done, total) several times per second, on this thread; if it raises, the call
    ends.

TypeError, ValueError, IndexError or BadBound names the argument that does not fit; patches without planes,
and Patches with sides='both', do not fit. Runs on all processors. Other threads of Python continue, and
Ctrl-C ends the call. RuntimeError in a child of fork() whose parent has made parallel calls.)");
  module.def(
      "view_factor",
      [](const py::object& from_corners, const py::object& to_corners) {
        return view_factor(vectors_in(from_corners, "from_corners").vectors,
                           vectors_in(to_corners, "to_corners").vectors);
      },
      arg("from_corners"), arg("to_corners"), R"(
The view factor from one flat convex polygon to another with nothing between them, from 0 to 1. The part of a
polygon that is behind the plane of the other does not count. The error is below 1e-8 of the factor, or
1e-11.

from_corners, to_corners: float32 (k, 3), 3 to 8 corners, counterclockwise as seen from the front. ValueError
    for another number of corners, for a corner that is not finite, and if the first polygon has no area.)");
}

}  // namespace shaftcull::python
