// SPDX-License-Identifier: MIT
#include "scenes/interior.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include "scenes/random.hpp"

namespace shaftcull::bench {
namespace {

constexpr std::uint32_t rooms = 4;  // along each side
constexpr float room = 6;
constexpr float wall = 0.2F;
constexpr float height = 3;
constexpr float door_height = 2.1F;
constexpr float slab = 0.3F;        // floor and ceiling
constexpr unsigned meshed = 16;     // pieces of an edge of the icosahedron: 5,120 triangles
constexpr float from_walls = 0.1F;  // how far furniture stays from them

/// Where wall `line` begins and ends across itself; room i is from wall_end(i) to wall_begin(i + 1).
float wall_begin(std::uint32_t line) { return static_cast<float>(line) * (room + wall); }
float wall_end(std::uint32_t line) { return wall_begin(line) + wall; }

std::uint32_t room_number(std::uint32_t x, std::uint32_t y) { return y * rooms + x; }

class Builder {
 public:
  Builder(PatchSize size, std::uint32_t seed) : maker_(size), random_(seed) {}

  PatchScene build() {
    add_shell();
    for (std::size_t axis = 0; axis != 2; ++axis) {
      for (std::uint32_t line = 1; line != rooms; ++line) {
        for (std::uint32_t along = 0; along != rooms; ++along) add_wall_with_door(axis, line, along);
      }
    }
    for (std::uint32_t y = 0; y != rooms; ++y) {
      for (std::uint32_t x = 0; x != rooms; ++x) furnish(x, y);
    }
    return maker_.take();
  }

 private:
  /// What stands in a room, as seen from above: a circle, and where it is between floor and ceiling.
  struct Place {
    double x;
    double y;
    double radius;
    double bottom;
    double top;
  };

  /// Floor, ceiling, outer walls and the pillars where inner walls cross.
  void add_shell() {
    const float end = wall_end(rooms);
    maker_.add_box({{0, 0, -slab}, {end, end, 0}});
    maker_.add_box({{0, 0, height}, {end, end, height + slab}});
    for (std::uint32_t y = 0; y != rooms; ++y) {
      for (std::uint32_t x = 0; x != rooms; ++x) {
        const Box below{{wall_end(x), wall_end(y), -slab}, {wall_begin(x + 1), wall_begin(y + 1), 0}};
        Box above = below;
        above.lo[2] = height;
        above.hi[2] = height + slab;
        maker_.cut_face(below, 2, true, room_number(x, y));
        maker_.cut_face(above, 2, false, room_number(x, y));
      }
    }
    for (std::size_t axis = 0; axis != 2; ++axis) {
      const std::size_t along = 1 - axis;
      for (const std::uint32_t line : {0U, rooms}) {
        Box outer{{0, 0, 0}, {end, end, height}};
        outer.lo[axis] = wall_begin(line);
        outer.hi[axis] = wall_end(line);
        if (axis == 1) {  // between those of the other axis
          outer.lo[along] = wall_end(0);
          outer.hi[along] = wall_begin(rooms);
        }
        maker_.add_box(outer);
        for (std::uint32_t i = 0; i != rooms; ++i) {
          Box part = outer;
          part.lo[along] = wall_end(i);
          part.hi[along] = wall_begin(i + 1);
          const std::uint32_t across = line == 0 ? 0 : rooms - 1;
          maker_.cut_face(part, axis, line == 0, axis == 0 ? room_number(across, i) : room_number(i, across));
        }
      }
    }
    for (std::uint32_t y = 1; y != rooms; ++y) {
      for (std::uint32_t x = 1; x != rooms; ++x) {
        maker_.add_box({{wall_begin(x), wall_begin(y), 0}, {wall_end(x), wall_end(y), height}});
      }
    }
  }

  /// The wall across `axis` at `line`, beside the room `number` along it: left and right of its door, and above.
  void add_wall_with_door(std::size_t axis, std::uint32_t line, std::uint32_t number) {
    const std::size_t along = 1 - axis;
    const std::uint32_t low = axis == 0 ? room_number(line - 1, number) : room_number(number, line - 1);
    const std::uint32_t high = axis == 0 ? room_number(line, number) : room_number(number, line);
    Box whole{{0, 0, 0}, {0, 0, height}};
    whole.lo[axis] = wall_begin(line);
    whole.hi[axis] = wall_end(line);
    whole.lo[along] = wall_end(number);
    whole.hi[along] = wall_begin(number + 1);
    const float width = random_.uniform(0.8F, 1.3F);
    const float door = random_.uniform(whole.lo[along] + 0.3F, whole.hi[along] - 0.3F - width);
    const float door_end = door + width;
    const auto part = [&](float from, float to, float bottom, float top) {
      Box box = whole;
      box.lo[along] = from;
      box.hi[along] = to;
      box.lo[2] = bottom;
      box.hi[2] = top;
      return box;
    };
    for (const Box& box : {part(whole.lo[along], door, 0, height), part(door_end, whole.hi[along], 0, height),
                           part(door, door_end, door_height, height)}) {
      maker_.add_box(box);
      maker_.cut_face(box, axis, false, low);
      maker_.cut_face(box, axis, true, high);
    }
    maker_.cut_face(part(whole.lo[along], door, 0, door_height), along, true, low);
    maker_.cut_face(part(door_end, whole.hi[along], 0, door_height), along, false, low);
    maker_.cut_face(part(door, door_end, door_height, height), 2, false, low);
  }

  void furnish(std::uint32_t x, std::uint32_t y) {
    left_ = wall_end(x);
    front_ = wall_end(y);
    zone_ = room_number(x, y);
    places_.clear();
    add_piece(2.0F, 2.0F, 0.9F, 1.1F, 0, 0.4F, 0.55F);  // a bed
    for (int i = 0; i != 2; ++i) add_table();
    for (int i = 0; i != 3; ++i) add_piece(0.8F, 1.2F, 0.4F, 0.5F, 0, 1.6F, 2.2F);      // cupboards
    for (int i = 0; i != 4; ++i) add_piece(0.35F, 0.45F, 0.35F, 0.45F, 0, 0.4F, 0.5F);  // stools
    for (int i = 0; i != 3; ++i) add_sphere();
  }

  double between(float low, float high) { return static_cast<double>(random_.uniform(low, high)); }

  /// Somewhere in the room where nothing stands yet; nothing if no such place was found.
  std::optional<Place> free_place(double radius, double bottom, double top) {
    const double margin = radius + static_cast<double>(from_walls);
    for (int attempt = 0; attempt != 4096; ++attempt) {
      Place place{0, 0, radius, bottom, top};
      place.x = static_cast<double>(left_) + margin + between(0, 1) * (static_cast<double>(room) - 2 * margin);
      place.y = static_cast<double>(front_) + margin + between(0, 1) * (static_cast<double>(room) - 2 * margin);
      bool free = true;
      for (const Place& other : places_) {
        const double dx = place.x - other.x;
        const double dy = place.y - other.y;
        const double apart = radius + other.radius;
        free = free && (dx * dx + dy * dy > apart * apart || bottom >= other.top || top <= other.bottom);
      }
      if (!free) continue;
      places_.push_back(place);
      return place;
    }
    return std::nullopt;
  }

  /// A turned box that stands on the floor, without patches below.
  void add_piece(float least_length, float most_length, float least_depth, float most_depth, double bottom,
                 float least_top, float most_top) {
    const double length = between(least_length, most_length);
    const double depth = between(least_depth, most_depth);
    const double top = between(least_top, most_top);
    const Turn turn(between(0, 1));
    const std::array<double, 2> half{length / 2, depth / 2};
    const std::optional<Place> place = free_place(std::sqrt(half[0] * half[0] + half[1] * half[1]), bottom, top);
    if (!place) return;
    const TurnedBox box = turned_box({place->x, place->y}, half, bottom, top, turn);
    maker_.add_turned(box);
    for (std::size_t axis = 0; axis != 3; ++axis) {
      if (axis != 2) maker_.cut_face(box, turn, axis, false, zone_);
      maker_.cut_face(box, turn, axis, true, zone_);
    }
  }

  /// A top on four legs.
  void add_table() {
    constexpr double thickness = 0.04;
    constexpr double leg = 0.03;  // half its side
    const std::array<double, 2> half{between(0.6F, 0.9F), between(0.35F, 0.45F)};
    const double top = between(0.7F, 0.78F);
    const Turn turn(between(0, 1));
    const std::optional<Place> place = free_place(std::sqrt(half[0] * half[0] + half[1] * half[1]), 0, top);
    if (!place) return;
    const TurnedBox board = turned_box({place->x, place->y}, half, top - thickness, top, turn);
    maker_.add_turned(board);
    for (std::size_t axis = 0; axis != 3; ++axis) {
      maker_.cut_face(board, turn, axis, false, zone_);
      maker_.cut_face(board, turn, axis, true, zone_);
    }
    for (unsigned corner = 0; corner != 4; ++corner) {
      const double x = ((corner & 1U) != 0 ? 1 : -1) * (half[0] - 2 * leg);
      const double y = ((corner & 2U) != 0 ? 1 : -1) * (half[1] - 2 * leg);
      const std::array<double, 2> at{place->x + turn.cosine * x - turn.sine * y,
                                     place->y + turn.sine * x + turn.cosine * y};
      const TurnedBox box = turned_box(at, {leg, leg}, 0, top - thickness, turn);
      maker_.add_turned(box);
      for (std::size_t axis = 0; axis != 2; ++axis) {
        maker_.cut_face(box, turn, axis, false, zone_);
        maker_.cut_face(box, turn, axis, true, zone_);
      }
    }
  }

  void add_sphere() {
    constexpr double around = 1.2;  // its patches lie a little outside
    const float radius = random_.uniform(0.26F, 0.4F);
    const double reach = around * static_cast<double>(radius);
    const double middle = between(0.8F, 2.5F);
    const std::optional<Place> place = free_place(reach, middle - reach, middle + reach);
    if (!place) return;
    maker_.add_sphere({static_cast<float>(place->x), static_cast<float>(place->y), static_cast<float>(middle)}, radius,
                      meshed, zone_);
  }

  PatchSceneMaker maker_;
  Random random_;
  float left_ = 0;  // of the room that is furnished
  float front_ = 0;
  std::uint32_t zone_ = 0;
  std::vector<Place> places_;
};

}  // namespace

PatchScene interior(PatchSize size, std::uint32_t seed) { return Builder(size, seed).build(); }

}  // namespace shaftcull::bench
