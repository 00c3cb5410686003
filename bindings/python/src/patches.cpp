// SPDX-License-Identifier: MIT
#include "patches.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <type_traits>
#include <variant>

#include "interrupts.hpp"
#include "results.hpp"
#include "shafts.hpp"

namespace shaftcull::python {

namespace {

/// One plane a patch: (n, 4), or (4,) for all.
std::vector<Plane> patch_planes_in(const py::object& given, const std::string& name, std::size_t patches) {
  if (given.is_none()) return {};
  const py::array_t<float> array = in_c_order(floats_in(given, name));
  const bool for_all = array.ndim() == 1 && array.shape(0) == 4;
  if (!for_all && (array.ndim() != 2 || array.shape(1) != 4 || static_cast<std::size_t>(array.shape(0)) != patches)) {
    throw py::value_error(name + " has shape " + shape_of(array) + "; it must be (" + std::to_string(patches) +
                          ", 4), a plane for each patch, or (4,) for all: normal x, y, z and offset");
  }
  std::vector<Plane> planes(patches);
  for (std::size_t i = 0; i != patches; ++i) {
    const float* const plane = array.data() + (for_all ? 0 : 4 * i);
    planes[i] = {{plane[0], plane[1], plane[2]}, plane[3]};
  }
  return planes;
}

/// Corners of hulls or polygons: an array (n, k, 3), or a sequence of arrays (k, 3).
struct CornersIn {
  std::vector<Vec3> corners;
  std::vector<std::size_t> first{0};
};
CornersIn corners_in(const py::object& given, const std::string& name) {
  CornersIn in;
  if (py::isinstance<py::array>(given)) {
    const py::array_t<float> array = in_c_order(floats_in(given, name));
    if (array.ndim() != 3 || array.shape(2) != 3) {
      throw py::value_error(name + " has shape " + shape_of(array) +
                            "; it must be (n, k, 3), or a list of arrays (k, 3)");
    }
    const auto corners = static_cast<std::size_t>(array.shape(1));
    const float* at = array.data();
    for (py::ssize_t i = 0; i != array.shape(0); ++i) {
      for (std::size_t corner = 0; corner != corners; ++corner, at += 3) in.corners.push_back({at[0], at[1], at[2]});
      in.first.push_back(in.corners.size());
    }
    return in;
  }
  for (const py::handle& one : given) {
    const VectorsIn vectors =
        vectors_in(py::reinterpret_borrow<py::object>(one), name + "[" + std::to_string(in.first.size() - 1) + "]");
    in.corners.insert(in.corners.end(), vectors.vectors.begin(), vectors.vectors.end());
    in.first.push_back(in.corners.size());
  }
  return in;
}

}  // namespace

PatchSet patches_in(const py::object& boxes, const py::object& planes, const std::string& name,
                    const std::string& planes_name) {
  if (py::isinstance<PatchSet>(boxes)) {
    if (!planes.is_none()) throw py::value_error(planes_name + " are given, but " + name + " are Patches already");
    return boxes.cast<PatchSet>();
  }
  const BoxesInStreams in(boxes, name);
  const std::vector<Plane> facing = patch_planes_in(planes, planes_name, in.view().count);
  const py::gil_scoped_release release;
  try {
    return PatchSet(in.view(), facing);
  } catch (const BadBound& bad) {
    throw BadBound(bad.index(), name + ": " + bad.what());
  }
}

OccludersHolder occluders_in(const py::object& boxes, const OccluderArguments& more) {
  if (py::isinstance<OccludersHolder>(boxes)) {
    for (const py::object* const other :
         {&more.solids, &more.hulls, &more.polygons, &more.triangles, &more.faces, &more.groups}) {
      if (!other->is_none()) throw py::value_error("occluders are Occluders already; nothing can be added to them");
    }
    return boxes.cast<OccludersHolder>();
  }
  Occluders all;
  OccludersHolder holder;
  const auto add = [&](const py::object& given, const char* name, auto&& to_all) {
    if (given.is_none()) return;
    try {
      holder.first.emplace_back(name, to_all(given, name));
    } catch (const BadBound& bad) {
      const std::string what = bad.what();
      throw BadBound(bad.index(), what.rfind(name, 0) == 0 ? what : std::string(name) + ": " + what);
    } catch (const InvalidArgument& bad) {
      throw InvalidArgument(std::string(name) + ": " + bad.what());
    }
  };
  add(boxes, "occluders", [&](const py::object& given, const char* name) {
    const BoxesInStreams in(given, name);
    const py::gil_scoped_release release;
    return all.add_boxes(in.view());
  });
  add(more.solids, "solids", [&](const py::object& given, const char* name) {
    const BoxesInStreams in(given, name);
    const py::gil_scoped_release release;
    return all.add_solids(in.view());
  });
  add(more.hulls, "hulls", [&](const py::object& given, const char* name) {
    const CornersIn in = corners_in(given, name);
    const py::gil_scoped_release release;
    return all.add_solid_hulls(in.corners, in.first);
  });
  add(more.polygons, "polygons", [&](const py::object& given, const char* name) {
    const CornersIn in = corners_in(given, name);
    const py::gil_scoped_release release;
    return all.add_polygons(in.corners, in.first);
  });
  add(more.triangles, "triangles", [&](const py::object& given, const char* name) {
    const TrianglesIn in = triangles_in(given, more.faces, name);
    std::vector<std::size_t> first;
    if (!more.groups.is_none()) {
      const IndicesIn groups = indices_in(more.groups, "groups", in.count + 1, "places where a group can begin or end");
      first.assign(groups.indices.begin(), groups.indices.end());
    }
    const py::gil_scoped_release release;
    return std::visit(
        [&]<class Where>(const Where& where) {
          if constexpr (std::is_same_v<Where, TriangleView>) {
            return all.add_triangles(where, first);
          } else {
            return all.add_triangles(TriangleStream(where).view(), first);
          }
        },
        in.where);
  });
  if (more.triangles.is_none() && (!more.faces.is_none() || !more.groups.is_none())) {
    throw py::value_error("faces and groups are of triangles, which are not given");
  }
  holder.all = std::make_shared<const Occluders>(std::move(all));
  return holder;
}

py::array order_of(const PatchSet& set) {
  return array_of(std::vector<std::uint32_t>(set.order().begin(), set.order().end()));
}

void add_occluders(py::module_& module) {
  using py::arg;
  const py::object none = py::none();
  py::class_<OccludersHolder>(module, "Occluders", R"(
What stands between patches, for several calls of visibility(). It never changes. Occluders are numbered from 0 on: first
those of `boxes`, then solids, hulls, polygons, and groups of triangles.

boxes: what may hide something: float32 (n, 6), as everywhere.
solids: boxes that are solid, as walls are. They make pairs 'occluded', also where several are one larger box together.
hulls: convex hulls that are solid: (n, k, 3), or a list of (k, 3), of 4 to 32 corners each.
polygons: flat convex polygons without thickness, by their corners in order: such arrays, of 3 corners or more.
triangles, faces: a mesh, (n, 3, 3), or vertices (v, 3) with faces (f, 3).
groups: integers (g + 1,): group i has triangles groups[i] to groups[i + 1]. Without it the library makes groups.)")
      .def(py::init([](const py::object& boxes, const py::object& solids, const py::object& hulls,
                       const py::object& polygons, const py::object& triangles, const py::object& faces,
                       const py::object& groups) {
             return occluders_in(boxes, {solids, hulls, polygons, triangles, faces, groups});
           }),
           arg("boxes") = none, py::kw_only(), arg("solids") = none, arg("hulls") = none, arg("polygons") = none,
           arg("triangles") = none, arg("faces") = none, arg("groups") = none)
      .def("__len__", [](const OccludersHolder& self) { return self.all->size(); })
      .def_property_readonly(
          "first",
          [](const OccludersHolder& self) {
            py::dict dict;
            for (const auto& [name, number] : self.first) dict[name.c_str()] = number;
            return dict;
          },
          "The number of the first occluder of each argument that was given: {'solids': 0, 'triangles': 12}, say; "
          "boxes are 'occluders'.")
      .def(
          "box",
          [](const OccludersHolder& self, const py::object& occluder) {
            const auto at = indices_in(occluder, "occluder", self.all->size(), "occluders");
            if (at.indices.size() != 1) throw py::value_error("occluder must be one number");
            return array_of(self.all->box(at.indices[0]));
          },
          arg("occluder"), "The box around one occluder: float32 (6,).")
      .def(
          "triangles",
          [](const OccludersHolder& self, const py::object& occluder) {
            const auto at = indices_in(occluder, "occluder", self.all->size(), "occluders");
            if (at.indices.size() != 1) throw py::value_error("occluder must be one number");
            const auto found = self.all->triangles(at.indices[0]);
            return array_of(std::vector<std::uint32_t>(found.begin(), found.end()));
          },
          arg("occluder"), "Which triangles one occluder has: uint32, none if it is no group of triangles.")
      .def("__repr__", [](const OccludersHolder& self) {
        return "<shaftcull.Occluders, " + std::to_string(self.all->size()) + " of them>";
      });
}

void add_patches(py::module_& module) {
  using py::arg;
  const py::object none = py::none();
  py::class_<PatchSet>(module, "Patches", R"(
Patches for several calls of visibility(), in a tree. They never change.

boxes: float32 (n, 6), as everywhere: around facets, points, or cells of a volume.
planes: float32 (n, 4), or (4,) for all: normal and offset. A patch faces where its normal points.)")
      .def(py::init([](const py::object& boxes, const py::object& planes) {
             return patches_in(boxes, planes, "boxes", "planes");
           }),
           arg("boxes"), arg("planes") = none)
      .def("__len__", &PatchSet::size)
      .def_property_readonly("has_planes", &PatchSet::has_planes, "Whether the patches have planes.")
      .def_property_readonly(
          "order", [](const PatchSet& self) { return order_of(self); },
          "uint32 (n,): the indices of the patches in the order of the tree, neighbours in space together. A copy.")
      .def("__repr__",
           [](const PatchSet& self) { return "<shaftcull.Patches, " + std::to_string(self.size()) + " of them>"; });
}

}  // namespace shaftcull::python
