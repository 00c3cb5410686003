// SPDX-License-Identifier: MIT
/// Shafts from arrays: between boxes, of moving boxes, and shadows.

#include <algorithm>
#include <cmath>
#include <limits>

#include "arrays.hpp"
#include "bounds_in.hpp"
#include "module.hpp"
#include "shafts.hpp"

namespace shaftcull::python {

namespace {

/// How many shafts two arguments make, of which one may be a single thing that goes with all of the other.
std::size_t shafts_between(bool one_a, std::size_t a, bool one_b, std::size_t b, const std::string& a_name,
                           const std::string& b_name) {
  if (!one_a && !one_b && a != b) {
    throw py::value_error("there are " + std::to_string(a) + " " + a_name + ", but " + std::to_string(b) + " " +
                          b_name + "; they must be equally many, or one of them single");
  }
  return one_a ? b : a;
}

/// Shafts that form(shafts) makes without the interpreter lock.
template <class Form>
Shafts formed(std::size_t count, bool one, const std::string& contact, Form&& form) {
  const Contact touching = contact_in(contact);
  ShaftStorage storage;
  {
    const py::gil_scoped_release release;
    storage.compiled.resize(count);
    form(std::span<CompiledShaft>(storage.compiled));
    if (touching == Contact::open) set_contact(storage.compiled, touching);
  }
  return shafts_of(std::move(storage), one);
}

/// Two arrays of boxes, their planes, and the pairs of them that shafts are made of.
struct Pairs {
  BoxesInStreams a;
  BoxesInStreams b;
  std::vector<IndexPair> pairs;
  std::vector<Plane> planes_a;
  std::vector<Plane> planes_b;
  bool one;

  Pairs(const py::object& boxes_a, const py::object& boxes_b, const py::object& given, const py::object& of_a,
        const py::object& of_b, const Rounding& rounding, const std::string& a_name, const std::string& b_name)
      : a(boxes_a, a_name, rounding),
        b(boxes_b, b_name, rounding),
        planes_a(planes_in(of_a, "planes_" + a_name, a.count(), 3)),
        planes_b(planes_in(of_b, "planes_" + b_name, b.count(), 3)),
        one(given.is_none() && a.one() && b.one()) {
    if (given.is_none()) {
      pairs.resize(shafts_between(a.one(), a.count(), b.one(), b.count(), "boxes in " + a_name, "in " + b_name));
      for (std::size_t i = 0; i != pairs.size(); ++i) {
        const auto index = static_cast<std::uint32_t>(i);
        pairs[i] = {a.one() ? 0 : index, b.one() ? 0 : index};
      }
      return;
    }
    const IndicesIn in = indices_in(given, "pairs", std::max(a.count(), b.count()), "boxes");
    if (!in.indices.empty() && (in.shape.size() != 2 || in.shape[1] != 2)) {
      throw py::value_error("pairs must have shape (n, 2): the index of a box of the first array, then of the second");
    }
    for (std::size_t i = 0; i != in.indices.size(); i += 2) {
      pairs.push_back({in.indices[i], in.indices[i + 1]});
      if (pairs.back().a >= a.count() || pairs.back().b >= b.count()) {
        throw py::index_error("pairs: pair " + std::to_string(i / 2) + " is (" + std::to_string(pairs.back().a) + ", " +
                              std::to_string(pairs.back().b) + "), but there are " + std::to_string(a.count()) +
                              " and " + std::to_string(b.count()) + " boxes, from 0 on");
      }
    }
  }
};

Shafts shadow(const py::object& lights, const py::object& occluders, const py::object& reach, const py::object& pairs,
              const py::object& planes_lights, const py::object& planes_occluders, const std::string& contact,
              const py::object& rounding) {
  const Pairs in(lights, occluders, pairs, planes_lights, planes_occluders, rounding_in(rounding), "lights",
                 "occluders");
  const BatchPlanes planes{in.planes_a, in.planes_b};
  if (reach.is_none()) {
    return formed(in.pairs.size(), in.one, contact,
                  [&](auto shafts) { shadow_batch(in.a.view(), in.b.view(), in.pairs, shafts, planes); });
  }
  const Doubles number(numbers_in(reach, "reach", rounding_in(rounding)));
  if (number.size() != 1) throw py::value_error("reach is one number for all, not shape " + shape_of(number));
  return formed(in.pairs.size(), in.one, contact, [&, up_to = rounded_up(number.data()[0])](auto shafts) {
    shadow_batch(in.a.view(), in.b.view(), in.pairs, up_to, shafts, planes);
  });
}

/// A body that moves by the nearest float32 of a displacement, and contains the given one all the way: it grows by what
/// rounding the displacement leaves out.
void round_displacement(const double* displacement, Box& body, Vec3& by) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (std::size_t axis = 0; axis != 3; ++axis) {
    by[axis] = static_cast<float>(displacement[axis]);
    const double left = displacement[axis] - static_cast<double>(by[axis]);
    if (left < 0) body.lo[axis] = rounded_down(std::nextafter(static_cast<double>(body.lo[axis]) + left, -infinity));
    if (left > 0) body.hi[axis] = rounded_up(std::nextafter(static_cast<double>(body.hi[axis]) + left, infinity));
  }
}

/// Bodies that move by vectors, or in their directions without end.
template <bool infinite>
Shafts moving(const py::object& given_bodies, const py::object& vectors, const py::object& given_planes,
              const std::string& contact, const py::object& rounding) {
  const char* const name = infinite ? "directions" : "displacements";
  const BoxesInStreams in(given_bodies, "bodies", rounding_in(rounding));
  const py::array numbers = numbers_in(vectors, name, infinite ? no_rounding : rounding_in(rounding));
  const bool one = is_one_vector(numbers, name);
  const Doubles ways(numbers);
  const std::size_t count =
      shafts_between(in.one(), in.count(), one, static_cast<std::size_t>(ways.size() / 3), "bodies", name);
  const std::vector<Plane> planes = planes_in(given_planes, "planes", count, 3);
  return formed(count, in.one() && one, contact, [&](auto shafts) {
    std::vector<Box> bodies(count);
    std::vector<Vec3> by(count);
    for (std::size_t i = 0; i != count; ++i) {
      bodies[i] = in.view()[in.one() ? 0 : i];
      round_displacement(ways.data() + (one ? 0 : 3 * i), bodies[i], by[i]);
    }
    const BoxStream stream = packed(strided(bodies), "bodies");
    infinite ? swept_infinite_batch(stream, by, shafts, planes) : swept_batch(stream, by, shafts, planes);
  });
}

}  // namespace

Shafts between(const py::object& a, const py::object& b, const py::object& pairs, const py::object& planes_a,
               const py::object& planes_b, const std::string& contact, const Rounding& rounding) {
  const Pairs in(a, b, pairs, planes_a, planes_b, rounding, "a", "b");
  return formed(in.pairs.size(), in.one, contact, [&](auto shafts) {
    compile_batch(in.a.view(), in.b.view(), in.pairs, shafts, {in.planes_a, in.planes_b});
  });
}

void add_volumes(py::class_<Shafts>& shafts) {
  using py::arg;
  const py::object none = py::none();
  shafts
      .def_static(
          "between",
          [](const py::object& a, const py::object& b, const py::object& pairs, const py::object& planes_a,
             const py::object& planes_b, const std::string& contact, const py::object& rounding) {
            return between(a, b, pairs, planes_a, planes_b, contact, rounding_in(rounding));
          },
          arg("a"), arg("b"), py::kw_only(), arg("pairs") = none, arg("planes_a") = none, arg("planes_b") = none,
          arg("contact") = "closed", arg("rounding") = none, R"(
Shafts between boxes. A shaft holds all segments from a[i] to b[i], and so everything that can stand between
the two. Two single boxes make one shaft, of shape (). Otherwise the shape is (n,), or (m,) with pairs.

a, b: boxes, float32: (n, 6) with lo x, y, z, then hi x, y, z; (n, 2, 3); a tuple (lo, hi) of (n, 3); a tuple
    of six (n,); or one box, (6,) or (2, 3), which is paired with every box of the other argument.
pairs: integers (m, 2): shaft i is between a[pairs[i, 0]] and b[pairs[i, 1]].
planes_a, planes_b: float32 (n, k, 4), k planes per box, or (k, 4) for all boxes: normal and offset. Bounds
    with normal . p > offset at all their points p are left out. At most 16 planes per shaft in all. Planes
    are never rounded outwards: no float32 half-space contains a float64 one, unless their normals are
    parallel.
contact: 'closed' keeps bounds that only touch a shaft, 'open' does not.
rounding: 'outwards' also accepts boxes of float64; each shaft then contains the shaft of the given boxes.

TypeError or ValueError names the argument that does not fit. BadBound, with the index, for a box that is not
finite or has lo > hi; IndexError for an index in pairs that is out of range. Runs on the calling thread.
Other threads of Python continue.)")
      .def_static("swept", &moving<false>, arg("bodies"), arg("displacements"), py::kw_only(), arg("planes") = none,
                  arg("contact") = "closed", arg("rounding") = none, R"(
The volumes that bodies sweep when they move by displacements: bodies[i] + t * displacements[i], t from
0 to 1. The end position of a body need not be a float32, and is not rounded.

bodies: boxes, as for between(). displacements: float32 (n, 3), or (3,) for all bodies.
planes: float32 (n, k, 4), k planes per shaft, or (k, 4) for all shafts. contact: as for between().
rounding: 'outwards' also accepts float64. Displacements are rounded to nearest, and bodies grow by the
    rounding error, so each shaft contains the exact volume.

Errors and threads: as for between().)")
      .def_static("swept_infinite", &moving<true>, arg("bodies"), arg("directions"), py::kw_only(),
                  arg("planes") = none, arg("contact") = "closed", arg("rounding") = none, R"(
The volumes that bodies sweep when they move in directions without end: bodies[i] + t * directions[i],
t >= 0. swept_infinite(receivers, towards_sun) contains everything that can cast the sun's shadow on
receivers.

bodies: boxes, as for between(). directions: float32 (n, 3) of any length but 0, or (3,) for all bodies.
planes, contact: as for swept().
rounding: 'outwards' also accepts bodies of float64; each shaft then contains the given body. Directions must
    be float32, since a rounded direction leads to other places at a great distance.

Errors and threads: as for between().)")
      .def_static("shadow", &shadow, arg("lights"), arg("occluders"), arg("reach") = none, py::kw_only(),
                  arg("pairs") = none, arg("planes_lights") = none, arg("planes_occluders") = none,
                  arg("contact") = "closed", arg("rounding") = none, R"(
The volumes that occluders can shadow from lights, or hide from viewpoints: all points behind occluders[i] as
seen from points of lights[i], and the occluder itself.

lights, occluders: boxes, as for between(); a light and its occluder must be apart. A light may be a point:
    points() makes its box.
reach: the shadow ends at this multiple of the distance of the occluder from the light; 1 or more. With None,
    it has no end.
pairs, planes_lights, planes_occluders, contact: as for between().
rounding: 'outwards' also accepts float64; each shaft then contains the exact shadow.

Errors and threads: as for between(). ValueError for a light and an occluder that are not apart.)");
}

}  // namespace shaftcull::python
