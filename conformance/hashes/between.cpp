// SPDX-License-Identifier: MIT
/// Shafts between two boxes: what they keep, and what blocks them.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "columns.hpp"
#include "hashes/cases.hpp"
#include "hashes/digest.hpp"
#include "hashes/hashes.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/occluded.hpp"

namespace shaftcull::hashes {
namespace {

void add_blocking(const CompiledShaft& shaft, const BoxView& view, Digest& digest) {
  std::vector<std::uint32_t> listed;
  list_occluders(shaft, view, listed);
  for (const std::uint32_t index : listed) digest.add(index);
  digest.add(view.count);
}

/// Shafts between two boxes, a quarter of them on a lattice, a quarter of any floats, half of them with added planes;
/// boxes and spheres, of which many touch. `blocking`: what blocks is asked in place of what is kept.
std::uint64_t of_pairs(std::uint64_t scenes, Way way, Contact contact, bool blocking = false) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  Numbers numbers;
  Digest digest;
  for (std::size_t s = 0; s != scenes; ++s) {
    const bool is_wild = s % 4 == 3;
    const Number number = is_wild ? &Numbers::any : s % 4 == 0 ? &Numbers::grid : &Numbers::fine;
    const Box a = box(numbers, number);
    Box b = box(numbers, number);
    if (s % 4 == 2) {  // faces that nearly coincide
      const auto axis = static_cast<std::size_t>(numbers.below(3));
      b.lo[axis] = numbers.near(a.lo[axis]);
      b.hi[axis] = numbers.near(a.hi[axis]);
      b = sorted(b.lo, b.hi);
    }
    std::vector<Plane> planes;
    for (int left = s % 8 < 4 ? 0 : 1 + numbers.below(2); left != 0; --left) {
      const Vec3 normal = point(numbers, number);
      if (normal != Vec3{}) planes.push_back({normal, (numbers.*number)()});
    }

    std::vector<Box> boxes;
    std::vector<Sphere> spheres;
    for (std::size_t i = 0; i != bounds_a_scene; ++i) {
      const bool touches = !is_wild && numbers.below(2) == 0;
      const Vec3 p = touches ? edge_point(numbers, a, b) : point(numbers, number);
      boxes.push_back(numbers.below(4) == 0 ? Box{p, p} : sorted(p, point(numbers, number)));
      spheres.push_back({p, numbers.below(4) == 0 ? 0.0F : std::abs((numbers.*number)())});
    }
    boxes[s % bounds_a_scene].hi[s % 3] = nan;
    spheres[s % bounds_a_scene].centre[s % 3] = nan;

    CompiledShaft compiled = compile(a, b, planes);
    complete(compiled);
    set_contact(compiled, contact);
    if (blocking) {
      for (Box& box : boxes) {
        if (numbers.below(2) == 0) box = around_middle(numbers, a, b);
      }
      add_blocking(compiled, BoxColumns(boxes).view(), digest);
      continue;
    }
    add_answers(compiled, BoxColumns(boxes).view(), way, digest);
    add_answers(compiled, SphereColumns(spheres).view(), way, digest);
  }
  return digest.value();
}

}  // namespace

std::uint64_t between_boxes(std::uint64_t scenes, Way way) { return of_pairs(scenes, way, Contact::closed); }
std::uint64_t between_boxes_open(std::uint64_t scenes, Way way) { return of_pairs(scenes, way, Contact::open); }
std::uint64_t what_blocks(std::uint64_t scenes, Way way) { return of_pairs(scenes, way, Contact::closed, true); }

}  // namespace shaftcull::hashes
