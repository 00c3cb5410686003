// SPDX-License-Identifier: MIT
/// Swept boxes, with and without an end, and shadows: what they keep, and what is reached first.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "columns.hpp"
#include "hashes/cases.hpp"
#include "hashes/digest.hpp"
#include "hashes/hashes.hpp"
#include "hashes/moving_shaft.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/first_contact.hpp"

namespace shaftcull::hashes {
namespace {

struct Scene {
  CompiledShaft shaft;
  std::vector<Box> boxes;
  std::vector<Sphere> spheres;
};

/// Many bounds touch the path of a corner.
Scene scene(std::size_t s, Numbers& numbers) {
  const Number number = number_of(s);
  const Box a = box(numbers, number);
  const Box b = box(numbers, number);
  const int kind = numbers.below(4);
  Scene scene{moving_shaft(kind, a, b, point(numbers, number)), {}, {}};
  for (std::size_t i = 0; i != bounds_a_scene; ++i) {
    const bool touches = !is_wild(s) && numbers.below(2) == 0;
    const Vec3 p = touches ? edge_point(numbers, scene.shaft.a(), scene.shaft.b()) : point(numbers, number);
    scene.boxes.push_back(numbers.below(4) == 0 ? Box{p, p} : sorted(p, point(numbers, number)));
    scene.spheres.push_back({p, numbers.below(4) == 0 ? 0.0F : std::abs((numbers.*number)())});
  }
  return scene;
}

std::uint64_t of_moving(std::uint64_t scenes, Way way, Contact contact) {
  Numbers numbers;
  Digest digest;
  for (std::size_t s = 0; s != scenes; ++s) {
    Scene here = scene(s, numbers);
    set_contact(here.shaft, contact);
    add_answers(here.shaft, BoxColumns(here.boxes).view(), way, digest);
    add_answers(here.shaft, SphereColumns(here.spheres).view(), way, digest);
  }
  return digest.value();
}

template <class View>
FirstContact contact_of(const CompiledShaft& shaft, const CompiledShaft& in_form, const View& view, Way way) {
  if (way != Way::many) return first_contact(in_form, view);
  FirstContact contact;
  first_contact_many({&shaft, 1}, view, {&contact, 1});
  return contact;
}

CompiledShaft in_form(const CompiledShaft& shaft, Way way) {
  CompiledShaft in_form = shaft;
  if (way == Way::planes) set_form(in_form, Form::planes);
  return in_form;
}

/// The first contact, and when each of the bounds that are kept is reached.
template <class View>
void add_times(const CompiledShaft& shaft, const View& view, Way way, Digest& digest) {
  const CompiledShaft formed = in_form(shaft, way);
  const FirstContact contact = contact_of(shaft, formed, view, way);
  digest.add(contact ? contact.index : ~std::uint64_t{0});
  digest.add_float(contact.time);
  std::vector<std::uint32_t> kept;
  list(formed, view, kept);
  std::vector<float> times(kept.size());
  entry_times(shaft, view, kept, times);
  for (const float time : times) digest.add_float(time);
}

/// The normal of the contact with each bound alone that is kept.
template <class View>
void add_normals(const CompiledShaft& shaft, const View& view, Way way, Digest& digest) {
  const CompiledShaft formed = in_form(shaft, way);
  for (std::size_t i = 0; i != view.count; ++i) {
    View one = view;
    for (const float*& stream : one.stream) stream += i;
    one.count = 1;
    for (const float n : contact_of(shaft, formed, one, way).normal) digest.add_float(n);
  }
}

}  // namespace

std::uint64_t moving_boxes(std::uint64_t scenes, Way way) { return of_moving(scenes, way, Contact::closed); }
std::uint64_t moving_boxes_open(std::uint64_t scenes, Way way) { return of_moving(scenes, way, Contact::open); }

std::uint64_t first_contacts(std::uint64_t scenes, Way way) {
  Numbers numbers;
  Digest digest;
  for (std::size_t s = 0; s != scenes; ++s) {
    const Scene here = scene(s, numbers);
    add_times(here.shaft, BoxColumns(here.boxes).view(), way, digest);
    add_times(here.shaft, SphereColumns(here.spheres).view(), way, digest);
  }
  return digest.value();
}

std::uint64_t contact_normals(std::uint64_t scenes, Way way) {
  Numbers numbers;
  Digest digest;
  for (std::size_t s = 0; s != scenes; ++s) {
    const Scene here = scene(s, numbers);
    add_normals(here.shaft, BoxColumns(here.boxes).view(), way, digest);
    add_normals(here.shaft, SphereColumns(here.spheres).view(), way, digest);
  }
  return digest.value();
}

}  // namespace shaftcull::hashes
