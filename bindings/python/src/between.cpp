// SPDX-License-Identifier: MIT
/// Shafts from arrays of boxes.

#include <numeric>

#include "arrays.hpp"
#include "interrupts.hpp"
#include "module.hpp"
#include "shafts.hpp"

namespace shaftcull::python {

namespace {

/// Boxes of an argument in streams, as batches take them. Those that do not lie so are packed.
class Streams {
 public:
  Streams(const BoxesIn& boxes, const std::string& name) {
    if (const auto* const view = std::get_if<BoxView>(&boxes.where)) {
      view_ = *view;
      return;
    }
    try {
      packed_ = BoxStream(std::get<StridedBoxes>(boxes.where));
    } catch (const BadBound& error) {
      throw BadBound(error.index(), name + ": " + error.what());
    }
    view_ = packed_.view();
  }

  [[nodiscard]] const BoxView& view() const noexcept { return view_; }

 private:
  BoxStream packed_;
  BoxView view_;
};

/// Which box goes with which: as many pairs as there will be shafts.
std::vector<IndexPair> pairs_of(const BoxesIn& a, const BoxesIn& b, const std::string& name_a,
                                const std::string& name_b) {
  if (!a.one && !b.one && a.count != b.count) {
    throw py::value_error("there are " + std::to_string(a.count) + " boxes in " + name_a + ", but " +
                          std::to_string(b.count) + " in " + name_b +
                          "; they must be equally many, or one of them a single box");
  }
  std::vector<IndexPair> pairs(a.one ? b.count : a.count);
  for (std::size_t i = 0; i != pairs.size(); ++i) {
    const auto index = static_cast<std::uint32_t>(i);
    pairs[i] = {a.one ? 0 : index, b.one ? 0 : index};
  }
  return pairs;
}

std::vector<IndexPair> pairs_in(const py::object& given, const BoxesIn& a, const BoxesIn& b) {
  const IndicesIn in = indices_in(given, "pairs", std::max(a.count, b.count), "boxes");
  if (in.shape.size() != 2 || in.shape[1] != 2) {
    if (in.indices.empty()) return {};
    throw py::value_error("pairs must have shape (n, 2): the index of a box of the first array, then of the second");
  }
  std::vector<IndexPair> pairs(in.shape[0]);
  for (std::size_t i = 0; i != pairs.size(); ++i) {
    pairs[i] = {in.indices[2 * i], in.indices[2 * i + 1]};
    if (pairs[i].a >= a.count || pairs[i].b >= b.count) {
      throw py::index_error("pairs: pair " + std::to_string(i) + " is (" + std::to_string(pairs[i].a) + ", " +
                            std::to_string(pairs[i].b) + "), but there are " + std::to_string(a.count) + " and " +
                            std::to_string(b.count) + " boxes, from 0 on");
    }
  }
  return pairs;
}

/// Two arrays of boxes, and the pairs of them that shafts are made of.
struct Pairs {
  BoxesIn a;
  BoxesIn b;
  std::vector<IndexPair> pairs;
  std::vector<Plane> planes_a;
  std::vector<Plane> planes_b;
  bool one;

  Pairs(const py::object& boxes_a, const py::object& boxes_b, const py::object& given, const py::object& of_a,
        const py::object& of_b, const std::string& name_a, const std::string& name_b)
      : a(boxes_in(boxes_a, name_a)),
        b(boxes_in(boxes_b, name_b)),
        pairs(given.is_none() ? pairs_of(a, b, name_a, name_b) : pairs_in(given, a, b)),
        planes_a(planes_in(of_a, "planes_" + name_a, a.count)),
        planes_b(planes_in(of_b, "planes_" + name_b, b.count)),
        one(given.is_none() && a.one && b.one) {}
};

Shafts shadow(const py::object& lights, const py::object& occluders, const py::object& reach, const py::object& pairs,
              const py::object& planes_lights, const py::object& planes_occluders, const std::string& contact) {
  const Contact touching = contact_in(contact);
  const Pairs in(lights, occluders, pairs, planes_lights, planes_occluders, "lights", "occluders");
  const bool ends = !reach.is_none();
  float up_to = 0;
  if (ends) {
    const py::array_t<float> number = floats_in(reach, "reach");
    if (number.size() != 1) throw py::value_error("reach is one number for all, not shape " + shape_of(number));
    up_to = number.data()[0];
  }
  ShaftStorage storage;
  {
    const py::gil_scoped_release release;
    const Streams a(in.a, "lights");
    const Streams b(in.b, "occluders");
    storage.compiled.resize(in.pairs.size());
    const BatchPlanes planes{in.planes_a, in.planes_b};
    if (ends) {
      shadow_batch(a.view(), b.view(), in.pairs, up_to, storage.compiled, planes);
    } else {
      shadow_batch(a.view(), b.view(), in.pairs, storage.compiled, planes);
    }
    if (touching == Contact::open) set_contact(storage.compiled, touching);
  }
  return shafts_of(std::move(storage), in.one);
}

using MovingBatch = void (*)(const BoxView&, std::span<const Vec3>, std::span<CompiledShaft>, std::span<const Plane>);

/// Bodies that move by vectors; one of either goes with all of the other.
Shafts moving(const py::object& boxes, const py::object& given, const py::object& planes, const std::string& contact,
              const char* name, MovingBatch batch) {
  const Contact touching = contact_in(contact);
  const BoxesIn bodies = boxes_in(boxes, "bodies");
  const VectorsIn in = vectors_in(given, name);
  if (!bodies.one && !in.one && bodies.count != in.vectors.size()) {
    throw py::value_error("there are " + std::to_string(bodies.count) + " bodies, but " +
                          std::to_string(in.vectors.size()) + " " + name +
                          "; they must be equally many, or one of them single");
  }
  const std::size_t count = bodies.one ? in.vectors.size() : bodies.count;
  const std::vector<Plane> given_planes = planes_in(planes, "planes", bodies.count);
  ShaftStorage storage;
  {
    const py::gil_scoped_release release;
    const Streams packed(bodies, "bodies");
    storage.compiled.resize(count);
    std::vector<Vec3> repeated;
    std::span<const Vec3> vectors = in.vectors;
    if (in.one && count != 1) {
      repeated.assign(count, in.vectors[0]);
      vectors = repeated;
    }
    BoxView view = packed.view();
    std::vector<Plane> repeated_planes;
    std::span<const Plane> all_planes = given_planes;
    BoxStream repeated_bodies;
    if (bodies.one && count != 1) {
      const std::vector<Box> copies(count, view[0]);
      repeated_bodies = BoxStream(copies);
      view = repeated_bodies.view();
      for (std::size_t i = 0; i != count; ++i) {
        repeated_planes.insert(repeated_planes.end(), given_planes.begin(), given_planes.end());
      }
      all_planes = repeated_planes;
    }
    batch(view, vectors, storage.compiled, all_planes);
    if (touching == Contact::open) set_contact(storage.compiled, touching);
  }
  return shafts_of(std::move(storage), bodies.one && in.one);
}

}  // namespace

Shafts between(const py::object& a, const py::object& b, const py::object& pairs, const py::object& planes_a,
               const py::object& planes_b, const std::string& contact) {
  const Contact touching = contact_in(contact);
  const Pairs in(a, b, pairs, planes_a, planes_b, "a", "b");
  ShaftStorage storage;
  {
    const py::gil_scoped_release release;
    const Streams view_a(in.a, "a");
    const Streams view_b(in.b, "b");
    storage.compiled.resize(in.pairs.size());
    compile_batch(view_a.view(), view_b.view(), in.pairs, storage.compiled, {in.planes_a, in.planes_b}, touching);
  }
  return shafts_of(std::move(storage), in.one);
}

void add_kinds(py::class_<Shafts>& shafts) {
  using py::arg;
  const py::object none = py::none();
  shafts
      .def_static("between", &between, arg("a"), arg("b"), py::kw_only(), arg("pairs") = none, arg("planes_a") = none,
                  arg("planes_b") = none, arg("contact") = "closed", R"(
Shafts between boxes: what can stand between a[i] and b[i].

a, b: boxes, float32: (n, 6) with lo x, lo y, lo z, hi x, hi y, hi z; (n, 2, 3); a tuple (lo, hi) of (n, 3); a
    tuple of six (n,); or one box, (6,) or (2, 3), which goes with each of the other.
pairs: integers (m, 2); shaft i is then between a[pairs[i, 0]] and b[pairs[i, 1]].
planes_a, planes_b: float32 (n, k, 4), k planes for each box, or (k, 4) for all: normal and offset. Bounds with
    normal . p > offset are left out. At most 16 in all for a shaft.
contact: 'closed' keeps bounds that only touch a shaft, 'open' does not.

Two single boxes make one shaft, of shape (). Else the shape is (n,) or (m,).)")
      .def_static(
          "swept",
          [](const py::object& bodies, const py::object& displacements, const py::object& planes,
             const std::string& contact) {
            return moving(bodies, displacements, planes, contact, "displacements",
                          [](const BoxView& boxes, std::span<const Vec3> vectors, std::span<CompiledShaft> out,
                             std::span<const Plane> added) { swept_batch(boxes, vectors, out, added); });
          },
          arg("bodies"), arg("displacements"), py::kw_only(), arg("planes") = none, arg("contact") = "closed", R"(
What bodies sweep over that move by displacements: bodies[i] + t * displacements[i], t from 0 to 1. Nothing is
rounded: where a body ends need not be a float32.

bodies: boxes, as those of between(). displacements: float32 (n, 3), or (3,) for all bodies.
planes: float32 (n, k, 4) or (k, 4), as those of between().)")
      .def_static(
          "swept_infinite",
          [](const py::object& bodies, const py::object& directions, const py::object& planes,
             const std::string& contact) {
            return moving(bodies, directions, planes, contact, "directions",
                          [](const BoxView& boxes, std::span<const Vec3> vectors, std::span<CompiledShaft> out,
                             std::span<const Plane> added) { swept_infinite_batch(boxes, vectors, out, added); });
          },
          arg("bodies"), arg("directions"), py::kw_only(), arg("planes") = none, arg("contact") = "closed", R"(
What bodies sweep over that move in directions without end: bodies[i] + t * directions[i], t >= 0. What can cast the
sun's shadow on receivers is swept_infinite(receivers, towards_sun).

bodies: boxes, as those of between(). directions: float32 (n, 3) of any length but 0, or (3,) for all bodies.)")
      .def_static("shadow", &shadow, arg("lights"), arg("occluders"), arg("reach") = none, py::kw_only(),
                  arg("pairs") = none, arg("planes_lights") = none, arg("planes_occluders") = none,
                  arg("contact") = "closed", R"(
What occluders can shadow from lights, or hide from viewpoints: all points behind occluders[i] as seen from points of
lights[i], and the occluder itself.

lights, occluders: boxes, as those of between(), which must be apart. A light may be a point: points() makes its box.
reach: 1 or more; how many times as far from the light as the occluder the shadow goes. None: without end.
pairs, planes_lights, planes_occluders, contact: as those of between().)");
}

}  // namespace shaftcull::python
