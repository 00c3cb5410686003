// SPDX-License-Identifier: MIT
#include "exact/tangent_planes.hpp"

#include <algorithm>

#include "support/exact_floats.hpp"

namespace shaftcull::kernel {
namespace {

/// Whether all points lie behind a plane; with open contact, on it or behind it.
bool has_behind(const PlaneOfPoints& plane, const TangentPlanes::Points& points, Contact contact,
                float tolerance) noexcept {
  if (points.around != nullptr && plane.is_behind(*points.around, tolerance)) return true;
  const int most = contact == Contact::open ? 0 : -1;
  return std::all_of(points.all.begin(), points.all.end(),
                     [&](const Vec3& x) { return plane.side(x, tolerance) <= most; });
}

}  // namespace

void TangentPlanes::Places::add_edges_of(const Patch& edges, std::size_t corners, bool is_of_second) {
  const std::size_t count = edges.corners.size();
  for (std::size_t i = 0; i + 1 < count; ++i) {
    for (std::size_t j = i + 1; j != count; ++j) {
      if (!edges.is_box && j != i + 1 && (i != 0 || j + 1 != count)) continue;
      for (std::size_t k = 0; k != corners; ++k) {
        order.push_back(static_cast<std::uint16_t>(all.size()));
        all.push_back(
            {is_of_second, static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(j), static_cast<std::uint8_t>(k)});
      }
    }
  }
}

void TangentPlanes::begin(const Patch& a, const Patch& b) {
  a_ = a;
  b_ = b;
  const auto kind = [](const Patch& patch) { return 2 * patch.corners.size() + (patch.is_box ? 1 : 0); };
  places_ = &places_of_kinds_[kind(a) * most_kinds + kind(b)];
  if (places_->all.empty()) {
    places_->add_edges_of(a, b.corners.size(), false);
    places_->add_edges_of(b, a.corners.size(), true);
  }
  states_.assign(places_->all.size(), State::unknown);
  if (planes_.size() < states_.size()) planes_.resize(states_.size());
}

/// The plane at a place, if it touches both patches.
std::optional<PlaneOfPoints> TangentPlanes::tangent_at(const Place& place) const noexcept {
  const std::span<const Vec3> one = place.is_of_second ? b_.corners : a_.corners;
  const std::span<const Vec3> other = place.is_of_second ? a_.corners : b_.corners;
  const Vec3& p = one[place.i];
  const Vec3& q = one[place.j];
  const Vec3& r = other[place.k];
  if (p == q || r == p || r == q) return std::nullopt;  // as between neighbours
  const PlaneOfPoints plane(p, q, r);
  int front = 0;
  const auto turns = [&](const Vec3& corner) {
    const int side = plane.side(corner, 0);
    if (side == 0) return false;
    if (front == 0) front = side;
    return side != front;
  };
  for (std::size_t c = 0; c != one.size(); ++c) {
    if (c != place.i && c != place.j && turns(one[c])) return std::nullopt;
  }
  for (std::size_t c = 0; c != other.size(); ++c) {
    if (c != place.k && turns(other[c])) return std::nullopt;
  }
  if (front == 0) return std::nullopt;
  return front > 0 ? plane : PlaneOfPoints(p, r, q);
}

/// Whether the plane at a place touches both patches. Then it is in planes_.
bool TangentPlanes::is_tangent(std::size_t place) {
  if (states_[place] == State::unknown) {
    const std::optional<PlaneOfPoints> plane = tangent_at(places_->all[place]);
    states_[place] = plane ? State::tangent : State::no_tangent;
    if (plane) planes_[place] = *plane;
  }
  return states_[place] == State::tangent;
}

bool TangentPlanes::separate(const Points& points, Contact contact, float tolerance) {
  std::vector<std::uint16_t>& order = places_->order;
  const auto parting = std::find_if(order.begin(), order.end(), [&](std::uint16_t place) {
    return is_tangent(place) && has_behind(planes_[place], points, contact, tolerance);
  });
  if (parting == order.end()) return false;
  std::rotate(order.begin(), parting, parting + 1);
  return true;
}

}  // namespace shaftcull::kernel
