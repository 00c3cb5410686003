// SPDX-License-Identifier: MIT
#include "fuzz/case.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iterator>
#include <limits>
#include <utility>

namespace shaftcull::fuzz {
namespace {

class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  [[nodiscard]] std::size_t left() const { return bytes_.size(); }

  std::uint8_t byte() {
    if (bytes_.empty()) return 0;
    const std::uint8_t first = bytes_.front();
    bytes_ = bytes_.subspan(1);
    return first;
  }
  float number() {
    std::uint8_t raw[sizeof(float)] = {};
    for (std::uint8_t& part : raw) part = byte();
    float x = 0;
    std::memcpy(&x, raw, sizeof x);
    return x;
  }
  Vec3 vec3() {
    const float x = number();
    const float y = number();
    return {x, y, number()};
  }
  Box box() {
    const Vec3 lo = vec3();
    return {lo, vec3()};
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

void sort(Box& box) {
  for (std::size_t k = 0; k != 3; ++k) {
    if (box.lo[k] > box.hi[k]) std::swap(box.lo[k], box.hi[k]);
  }
}

/// A coordinate of the shaft, or the middle between two of them, moved by −2 … 2 ulps.
float derived(const Case& from, std::size_t axis, std::uint8_t code) {
  const float of[4] = {from.a.lo[axis], from.a.hi[axis], from.b.lo[axis], from.b.hi[axis]};
  float x = of[code % 4];
  if ((code & 4U) != 0) x = x / 2 + of[code / 8 % 4] / 2;
  const int steps = code / 32 - 3;
  for (int i = 0; i < std::min(std::abs(steps), 2); ++i) x = std::nextafter(x, steps < 0 ? -INFINITY : INFINITY);
  return x;
}

constexpr std::size_t more_than_a_word = 65;

/// Adds bounds that are decided at a glance until there is a whole word and a rest.
template <class Bound>
void fill(std::vector<Bound>& bounds, const Bound& far_away) {
  if (bounds.size() < more_than_a_word) bounds.resize(more_than_a_word, far_away);
}

}  // namespace

Case Case::read(std::span<const std::uint8_t> bytes) {
  Reader reader(bytes);
  Case it;
  const std::uint8_t options = reader.byte();
  constexpr Formation formations[] = {Formation::search, Formation::table64, Formation::table729, Formation::table729};
  constexpr PlaneOrder orders[] = {PlaneOrder::unsorted, PlaneOrder::by_volume, PlaneOrder::by_added_volume,
                                   PlaneOrder::by_added_volume};
  it.options.formation = formations[options % 4];
  it.options.order = orders[options / 4 % 4];
  it.contact = (options & open_contact) == 0 ? Contact::closed : Contact::open;
  const std::uint8_t shape = reader.byte();
  const unsigned subject = static_cast<unsigned>(shape) >> subject_shift;
  it.subject = static_cast<Subject>(subject == 7 ? 0 : subject);
  it.has_groups = it.subject != Subject::between_boxes || (options & 64U) == 0;
  it.a = reader.box();
  it.b = reader.box();
  if ((shape & sort_corners) != 0) {
    sort(it.a);
    sort(it.b);
  }
  if (it.subject == Subject::shadow) it.reach = reader.number();
  it.planes.reserve(shape % 4);
  for (int i = 0; i != shape % 4; ++i) {
    const Vec3 normal = reader.vec3();
    it.planes.push_back({normal, reader.number()});
  }
  std::vector<float> coordinates;
  coordinates.reserve(6 * most_boxes);
  const bool is_derived = (shape & derive_bounds) != 0;
  while (reader.left() != 0 && coordinates.size() != 6 * most_boxes) {
    coordinates.push_back(is_derived ? derived(it, coordinates.size() % 3, reader.byte()) : reader.number());
  }
  it.boxes.reserve(more_than_a_word);
  it.spheres.reserve(more_than_a_word);
  for (std::size_t i = 0; i + 6 <= coordinates.size(); i += 6) {
    const float* const x = &coordinates[i];
    it.boxes.push_back({{x[0], x[1], x[2]}, {x[3], x[4], x[5]}});
    if ((shape & sort_corners) != 0) sort(it.boxes.back());
  }
  for (std::size_t i = 0; i + 4 <= coordinates.size(); i += 4) {
    const float* const x = &coordinates[i];
    // Derived coordinates keep to their axes, and the radius is the distance between two of the same axis.
    const float* const centre = is_derived ? &coordinates[i / 3 * 3] : x;
    const float radius = is_derived ? x[3] - x[0] : x[3];
    it.spheres.push_back({{centre[0], centre[1], centre[2]}, (shape & sort_corners) != 0 ? std::abs(radius) : radius});
  }
  if ((shape & fill_word) != 0) {
    constexpr float far = std::numeric_limits<float>::max();
    fill(it.boxes, {{far, far, far}, {far, far, far}});
    fill(it.spheres, {{far, far, far}, 0});
  }
  return it;
}

Case::Input Case::input(const std::vector<Plane>& added) const {
  if (is_hull()) {
    HullInput hull{{a.lo, a.hi, b.lo}, {}};
    std::vector<Vec3>& others = subject == Subject::hull ? hull.points : hull.directions;
    others.push_back(b.hi);
    for (const Plane& plane : planes) others.push_back(plane.normal);
    return hull;
  }
  if (!is_moving()) return ShaftInput{a, b, added, contact};
  constexpr MovingInput::Kind kinds[] = {MovingInput::Kind::swept, MovingInput::Kind::swept_infinite,
                                         MovingInput::Kind::shadow, MovingInput::Kind::shadow_without_end};
  const auto kind = kinds[static_cast<std::size_t>(subject) - static_cast<std::size_t>(Subject::swept)];
  return MovingInput{kind, a, b.lo, b, reach, added, contact};
}

Case::Input Case::input() const {
  std::vector<Plane> added;
  std::copy_if(planes.begin(), planes.end(), std::back_inserter(added), is_addable);
  return input(added);
}

std::string Case::text() const {
  const std::string text = std::visit([](const auto& of) { return source_text(of); }, input(planes));
  return is_hull() && contact == Contact::open ? text + ", Contact::open" : text;
}

bool is_addable(const Plane& plane) {
  const auto is_number = [](float x) { return std::isfinite(x); };
  return std::all_of(plane.normal.begin(), plane.normal.end(), is_number) && is_number(plane.offset) &&
         plane.normal != Vec3{};
}

}  // namespace shaftcull::fuzz
