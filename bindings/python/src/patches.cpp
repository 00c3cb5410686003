// SPDX-License-Identifier: MIT
#include "patches.hpp"

#include <cstdint>
#include <optional>
#include <type_traits>
#include <variant>

#include <pybind11/stl.h>

#include "bounds_in.hpp"
#include "results.hpp"

namespace shaftcull::python {

namespace {

/// Corners of hulls or polygons: an array (n, k, 3), or a sequence of arrays (k, 3).
struct CornersIn {
  std::vector<Vec3> corners;
  std::vector<std::size_t> first{0};

  CornersIn(const py::object& given, const std::string& name) {
    const bool array = py::isinstance<py::array>(given);
    if (array && py::reinterpret_borrow<py::array>(given).ndim() != 3) {
      refuse_shape(name, py::reinterpret_borrow<py::array>(given), "(n, k, 3), or a list of arrays (k, 3)");
    }
    for (const py::handle one : given) {
      const std::string its_name = array ? name : name + "[" + std::to_string(first.size() - 1) + "]";
      const VectorsIn in = vectors_in(py::reinterpret_borrow<py::object>(one), its_name);
      corners.insert(corners.end(), in.vectors.begin(), in.vectors.end());
      first.push_back(corners.size());
    }
  }
};

PatchSides sides_in(const std::string& sides) {
  if (sides == "front") return PatchSides::front;
  if (sides == "both") return PatchSides::both;
  throw py::value_error("sides is '" + sides + "'; it must be 'front' or 'both'");
}

/// Whether an argument is corners: an array (n, k, 3), where (n, 2, 3) are boxes, or a list of arrays (k, 3).
bool are_corners(const py::object& given) {
  if (py::isinstance<py::array>(given)) {
    const auto array = py::reinterpret_borrow<py::array>(given);
    return array.ndim() == 3 && array.shape(1) > 2;
  }
  if (!py::isinstance<py::list>(given) && !py::isinstance<py::tuple>(given)) return false;
  if (py::len(given) == 0) return false;
  const py::object first = given[py::int_(0)];
  return py::isinstance<py::array>(first) && py::reinterpret_borrow<py::array>(first).ndim() == 2;
}

/// Whether solids are wanted, or the patches that all questions are about.
using FindSolids = std::variant<bool, const PatchSet*>;

std::optional<SolidSearch> search_in(const FindSolids& wanted) {
  SolidSearch search;
  if (const auto* const patches = std::get_if<const PatchSet*>(&wanted)) {
    search.region = (*patches)->box();
  } else if (!std::get<bool>(wanted)) {
    return std::nullopt;
  }
  return search;
}

/// Adds triangles, in the groups that are given, and solids that are found in them if they are wanted.
std::size_t add_triangles(Occluders& to, const py::object& given, const OccluderArguments& more,
                          OccludersHolder& holder) {
  const BoundsIn<Triangle> in = bounds_in<Triangle>(given, more.faces);
  std::vector<std::size_t> first;
  if (!more.groups.is_none()) {
    const IndicesIn ends = indices_in(more.groups, "groups", in.count + 1, "places where a group can begin or end");
    first.assign(ends.indices.begin(), ends.indices.end());
  }
  const py::gil_scoped_release release;
  const auto add = [&](const TriangleView& triangles) {
    if (!more.search) return to.add_triangles(triangles, first);
    FoundSolids found;
    std::size_t number = 0;
    if (more.groups.is_none()) {
      number = to.add_mesh(triangles, *more.search, &found);
    } else {
      found = find_solids(triangles, *more.search);
      number = to.add_triangles(triangles, first);
      to.add_found(found);
    }
    holder.found = {
        {"hulls", found.hulls()}, {"polygons", found.polygons()}, {"inner_boxes", found.inner_boxes.size()}};
    return number;
  };
  return std::visit(
      [&]<class Where>(const Where& where) {
        if constexpr (std::is_same_v<Where, TriangleView>) {
          return add(where);
        } else {
          return add(TriangleStream(where).view());
        }
      },
      in.where);
}

std::uint32_t number_of(const OccludersHolder& holder, const py::object& occluder) {
  const IndicesIn in = indices_in(occluder, "occluder", holder.all->size(), "occluders");
  if (in.indices.size() != 1) throw py::value_error("occluder must be one number");
  return in.indices[0];
}

py::dict dict_of(const std::vector<std::pair<std::string, std::size_t>>& numbers) {
  py::dict dict;
  for (const auto& [name, number] : numbers) dict[name.c_str()] = number;
  return dict;
}

}  // namespace

PatchSet patches_in(const py::object& boxes, const py::object& planes, const Rounding& rounding,
                    const std::string& name, const std::string& planes_name, PatchSides sides) {
  if (py::isinstance<PatchSet>(boxes)) {
    if (!planes.is_none()) throw py::value_error(planes_name + " are given, but " + name + " are Patches already");
    if (sides == PatchSides::both) throw py::value_error("sides is 'both', but " + name + " are Patches already");
    return boxes.cast<PatchSet>();
  }
  if (are_corners(boxes)) {
    if (!planes.is_none())
      throw py::value_error(planes_name + " are given, but " + name + " are corners, which have some");
    const CornersIn in(boxes, name);
    const py::gil_scoped_release release;
    try {
      return PatchSet(in.corners, in.first, sides);
    } catch (const BadBound& bad) {
      throw BadBound(bad.index(), name + ": " + bad.what());
    }
  }
  if (sides == PatchSides::both && !planes.is_none())
    throw py::value_error(planes_name + " are given, but sides is 'both', and such patches have none");
  const BoxesInStreams in(boxes, name, rounding);
  const std::vector<Plane> facing = planes_in(planes, planes_name, in.count(), 2);
  const py::gil_scoped_release release;
  try {
    return PatchSet(in.view(), facing);
  } catch (const BadBound& bad) {
    throw BadBound(bad.index(), name + ": " + bad.what());
  }
}

OccludersHolder occluders_in(const py::object& boxes, const OccluderArguments& more, const Rounding& rounding) {
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
      const std::size_t first = to_all(given, name);
      holder.first.emplace_back(&given == &boxes ? "boxes" : name, first);
    } catch (const BadBound& bad) {
      const std::string what = bad.what();
      throw BadBound(bad.index(), what.rfind(name, 0) == 0 ? what : std::string(name) + ": " + what);
    } catch (const InvalidArgument& bad) {
      throw InvalidArgument(std::string(name) + ": " + bad.what());
    }
  };
  add(boxes, "occluders", [&](const py::object& given, const char* name) {
    return all.add_boxes(BoxesInStreams(given, name, rounding).view());
  });
  add(more.solids, "solids", [&](const py::object& given, const char* name) {
    return all.add_solids(BoxesInStreams(given, name, no_rounding).view());
  });
  add(more.hulls, "hulls", [&](const py::object& given, const char* name) {
    const CornersIn in(given, name);
    const py::gil_scoped_release release;
    return all.add_solid_hulls(in.corners, in.first);
  });
  add(more.polygons, "polygons", [&](const py::object& given, const char* name) {
    const CornersIn in(given, name);
    return all.add_polygons(in.corners, in.first);
  });
  add(more.triangles, "triangles",
      [&](const py::object& given, const char* /*name*/) { return add_triangles(all, given, more, holder); });
  if (more.triangles.is_none() && (!more.faces.is_none() || !more.groups.is_none() || more.search)) {
    throw py::value_error("faces, groups and find_solids are of triangles, which are not given");
  }
  holder.all = std::make_shared<const Occluders>(std::move(all));
  return holder;
}

void add_patches(py::module_& module) {
  using py::arg;
  const py::object none = py::none();
  py::class_<PatchSet>(module, "Patches", R"(
Patches in a tree, for several calls of visibility(). They never change. len() is the number of patches.

boxes: float32 (n, 6), or as for BoxStream: boxes around facets, points, or cells of a volume. Or corners of
    convex polygons, float32 (n, k, 3) or a list of arrays (k, 3), 3 to 8 corners each: a polygon faces the
    side from which its corners run counter-clockwise, and takes no plane from `planes`.
sides: 'both' is for polygons that are seen from both sides; two polygons in one plane face away. Boxes
    without planes are seen from all sides.
planes: float32 (n, 4), or (4,) for all: normal and offset. A patch faces where its normal points. Planes are
    never rounded outwards: round planes of float64 with astype(numpy.float32).
rounding: 'outwards' also accepts boxes of float64, and contains them: pairs that are clear or occluded are
    so as given, too.

BadBound, with the index, for a box that is not finite or has lo > hi, and for a plane without a normal.
TypeError or ValueError for other arrays.)")
      .def(py::init([](const py::object& boxes, const py::object& planes, const py::object& rounding,
                       const std::string& sides) {
             return patches_in(boxes, planes, rounding_in(rounding), "boxes", "planes", sides_in(sides));
           }),
           arg("boxes"), arg("planes") = none, py::kw_only(), arg("rounding") = none, arg("sides") = "front")
      .def("__len__", &PatchSet::size)
      .def_property_readonly("has_planes", &PatchSet::has_planes, "bool: whether the patches have planes.")
      .def_property_readonly(
          "order", [](const PatchSet& self) { return copy_of(self.order()); }, R"(
uint32 (n,): the indices of the patches in the order of the tree, neighbours in space together. A copy.)")
      .def("__repr__",
           [](const PatchSet& self) { return "<shaftcull.Patches, " + std::to_string(self.size()) + " of them>"; });

  py::class_<OccludersHolder>(module, "Occluders", R"(
The occluders between patches, for several calls of visibility(). They never change. len() is the number of
occluders. They are numbered from 0: first the boxes of `boxes`, then solids, hulls, polygons, and groups of
triangles.

boxes: boxes around things that may hide something: float32 (n, 6), or as for BoxStream.
solids: solid boxes, such as walls. They make pairs 'occluded', also if several form one larger box together.
hulls: solid convex hulls: float32 (n, k, 3), or a list of (k, 3), with 4 or more corners each.
polygons: flat convex polygons without thickness: arrays as for hulls, with 3 or more corners in order.
triangles, faces: a mesh, float32 (n, 3, 3), or vertices (v, 3) with faces, integers (f, 3).
groups: integers (g + 1,): group i has triangles groups[i] to groups[i + 1]. With None, the library makes
    groups.
find_solids: True finds bodies, walls and floors in the triangles, which make pairs 'occluded'; `found` has
    their numbers. They are not occluders, except for bodies that are upright boxes. Without groups, these
    follow the groups of triangles, and their own triangles are in no group. Closed surfaces must face
    outwards to be bodies. Pass Patches instead of True if only these are compared: then bodies may be open
    on or beyond one face of the box around them, as buildings without a bottom are on level ground.
rounding: 'outwards' also accepts `boxes` of float64, and contains them: a pair that is clear is so as given,
    too. The other arguments are never rounded outwards, since a larger solid hides too much: use
    astype(numpy.float32).

BadBound, with the index, for a value that is not finite or lo > hi. TypeError, ValueError or IndexError
names the argument that does not fit.)")
      .def(py::init([](const py::object& boxes, const py::object& solids, const py::object& hulls,
                       const py::object& polygons, const py::object& triangles, const py::object& faces,
                       const py::object& groups, const FindSolids& find_solids, const py::object& rounding) {
             return occluders_in(boxes, {solids, hulls, polygons, triangles, faces, groups, search_in(find_solids)},
                                 rounding_in(rounding));
           }),
           arg("boxes") = none, py::kw_only(), arg("solids") = none, arg("hulls") = none, arg("polygons") = none,
           arg("triangles") = none, arg("faces") = none, arg("groups") = none, arg("find_solids") = false,
           arg("rounding") = none)
      .def("__len__", [](const OccludersHolder& self) { return self.all->size(); })
      .def_property_readonly(
          "found", [](const OccludersHolder& self) { return dict_of(self.found); }, R"(
How many solids were found in the triangles: a dict with 'hulls' (convex bodies), 'polygons' and
'inner_boxes' (boxes inside other bodies); empty without find_solids.)")
      .def_property_readonly(
          "first", [](const OccludersHolder& self) { return dict_of(self.first); },
          R"(
The number of the first occluder of each argument that was given: a dict such as
{'boxes': 0, 'triangles': 12}.)")
      .def(
          "box",
          [](const OccludersHolder& self, const py::object& occluder) {
            return array_of(self.all->box(number_of(self, occluder)));
          },
          arg("occluder"), "The box around one occluder: float32 (6,). IndexError for a number out of range.")
      .def(
          "triangles",
          [](const OccludersHolder& self, const py::object& occluder) {
            return copy_of(self.all->triangles(number_of(self, occluder)));
          },
          arg("occluder"), R"(
The triangles of one occluder: uint32 (k,), empty unless it is a group of triangles. IndexError for a number
out of range.)")
      .def("__repr__", [](const OccludersHolder& self) {
        return "<shaftcull.Occluders, " + std::to_string(self.all->size()) + " of them>";
      });
}

}  // namespace shaftcull::python
