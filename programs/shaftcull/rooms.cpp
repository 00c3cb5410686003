// SPDX-License-Identifier: MIT
#include "rooms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "mesh_parts.hpp"
#include "shaftcull/geometry.hpp"

namespace shaftcull::cli {
namespace {

constexpr float room_side = 4;
constexpr float wall_height = 2.5F;
constexpr float half_wall = 0.1F;
constexpr float door_width = 1;

/// A point of a footprint on the floor.
struct FloorPoint {
  float x;
  float y;
};

class RoomsBuilder {
 public:
  RoomsBuilder(std::size_t columns, std::size_t rows, std::uint64_t seed)
      : columns_(columns), rows_(rows), random_(seed) {}

  MeshScene build() {
    add_floor();
    for (std::size_t j = 0; j <= rows_; ++j) {
      for (std::size_t i = 0; i < columns_; ++i) add_wall(i, j, 0, j == 0 || j == rows_);
    }
    for (std::size_t i = 0; i <= columns_; ++i) {
      for (std::size_t j = 0; j < rows_; ++j) add_wall(i, j, 1, i == 0 || i == columns_);
    }
    for (std::size_t j = 0; j < rows_; ++j) {
      for (std::size_t i = 0; i < columns_; ++i) furnish(at(i), at(j));
    }
    scene_.parts = divide_into_parts(scene_.triangles, (scene_.triangles.size() + usual_parts - 1) / usual_parts);
    return std::move(scene_);
  }

 private:
  static float at(std::size_t i) { return room_side * static_cast<float>(i); }

  float uniform(float lo, float hi) { return lo + (hi - lo) * static_cast<float>(random_() >> 40) * 0x1p-24F; }

  void begin_object(std::string name) {
    scene_.names.push_back(std::move(name));
    scene_.boxes.push_back({});
    first_triangle_ = scene_.triangles.size();
  }

  void add_triangle(const Vec3& a, const Vec3& b, const Vec3& c) {
    const std::array<Vec3, 3> vertex{a, b, c};
    const Box box = box_around(vertex);
    const auto object = static_cast<std::uint32_t>(scene_.names.size() - 1);
    const auto number = static_cast<std::uint32_t>(scene_.triangles.size() - first_triangle_);
    scene_.boxes.back() = number == 0 ? box : joined(scene_.boxes.back(), box);
    scene_.triangles.push_back({box, object, 0, number, vertex});
  }

  void add_quad(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
    add_triangle(a, b, c);
    add_triangle(a, c, d);
  }

  void add_floor() {
    begin_object("floor");
    const float x = at(columns_);
    const float y = at(rows_);
    add_quad({0, 0, 0}, {x, 0, 0}, {x, y, 0}, {0, y, 0});
  }

  /// A prism from `lo` to `hi` over a footprint that goes round counterclockwise.
  void add_prism(std::string name, const std::array<FloorPoint, 4>& base, float lo, float hi) {
    begin_object(std::move(name));
    const auto low = [&](std::size_t i) { return Vec3{base[i % 4].x, base[i % 4].y, lo}; };
    const auto high = [&](std::size_t i) { return Vec3{base[i % 4].x, base[i % 4].y, hi}; };
    for (std::size_t i = 0; i < 4; ++i) add_quad(low(i), low(i + 1), high(i + 1), high(i));
    add_quad(high(0), high(1), high(2), high(3));
    add_quad(low(3), low(2), low(1), low(0));
  }

  void add_wall_box(float x0, float y0, float x1, float y1) {
    add_prism(fmt::format("wall {}", ++walls_), {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}}, 0, wall_height);
  }

  /// The wall along one side of a room: with axis 0 it goes along x. Those along y end where the others begin.
  void add_wall(std::size_t i, std::size_t j, int axis, bool is_outer) {
    const float across = axis == 0 ? at(j) : at(i);
    const auto add = [&](float begin, float end) {
      if (axis == 0) {
        add_wall_box(begin, across - half_wall, end, across + half_wall);
      } else {
        add_wall_box(across - half_wall, begin, across + half_wall, end);
      }
    };
    float begin = axis == 0 ? at(i) : at(j) + half_wall;
    float end = axis == 0 ? at(i + 1) : at(j + 1) - half_wall;
    if (axis == 0 && i == 0) begin -= half_wall;
    if (axis == 0 && i + 1 == columns_) end += half_wall;
    if (is_outer) {
      add(begin, end);
      return;
    }
    const float door = uniform(begin + 0.4F, end - door_width - 0.4F);
    add(begin, door);
    add(door + door_width, end);
  }

  void furnish(float x, float y) {
    const float table_x = x + uniform(0.6F, 1.2F);
    const float table_y = y + uniform(0.6F, 2);
    const float table_width = uniform(0.7F, 1.1F);
    add_prism(fmt::format("table {}", ++tables_),
              {{{table_x, table_y},
                {table_x + table_width, table_y},
                {table_x + table_width, table_y + 0.8F},
                {table_x, table_y + 0.8F}}},
              0, 0.75F);
    // Named one by one: which argument is drawn first is the compiler's choice.
    const float cupboard_x = x + uniform(3.05F, 3.15F);
    add_cupboard(cupboard_x, y + uniform(0.9F, 3.1F));
    const float radius = uniform(0.2F, 0.35F);
    const float ball_x = x + uniform(0.6F, 1.9F);
    add_ball({ball_x, y + uniform(3.2F, 3.4F), radius}, radius);
  }

  void add_cupboard(float x, float y) {
    // A direction of length 1 without a sine, which differs from machine to machine.
    const float t = uniform(-0.5F, 0.5F);
    const float c = (1 - t * t) / (1 + t * t);
    const float s = 2 * t / (1 + t * t);
    const auto corner = [&](float along, float across) {
      return FloorPoint{x + c * along - s * across, y + s * along + c * across};
    };
    add_prism(fmt::format("cupboard {}", ++cupboards_),
              {corner(-0.3F, -0.6F), corner(0.3F, -0.6F), corner(0.3F, 0.6F), corner(-0.3F, 0.6F)}, 0,
              uniform(1.4F, 2.1F));
  }

  /// An octahedron whose faces were divided into sixteen, blown up.
  void add_ball(const Vec3& centre, float radius) {
    begin_object(fmt::format("ball {}", ++balls_));
    constexpr int parts = 4;
    for (int octant = 0; octant < 8; ++octant) {
      const std::array<float, 3> sign{(octant & 1) != 0 ? -1.0F : 1.0F, (octant & 2) != 0 ? -1.0F : 1.0F,
                                      (octant & 4) != 0 ? -1.0F : 1.0F};
      const bool is_mirrored = sign[0] * sign[1] * sign[2] < 0;
      const auto point = [&](int i, int j) {
        const std::array<double, 3> flat{static_cast<double>(i), static_cast<double>(j),
                                         static_cast<double>(parts - i - j)};
        const double length = std::sqrt(flat[0] * flat[0] + flat[1] * flat[1] + flat[2] * flat[2]);
        Vec3 p{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
          p[axis] = centre[axis] + sign[axis] * radius * static_cast<float>(flat[axis] / length);
        }
        return p;
      };
      const auto add = [&](const Vec3& a, const Vec3& b, const Vec3& c) {
        if (is_mirrored) {
          add_triangle(a, c, b);
        } else {
          add_triangle(a, b, c);
        }
      };
      for (int i = 0; i < parts; ++i) {
        for (int j = 0; i + j < parts; ++j) {
          add(point(i, j), point(i + 1, j), point(i, j + 1));
          if (i + j + 2 <= parts) add(point(i + 1, j), point(i + 1, j + 1), point(i, j + 1));
        }
      }
    }
  }

  std::size_t columns_;
  std::size_t rows_;
  std::mt19937_64 random_;
  MeshScene scene_;
  std::size_t first_triangle_ = 0;
  std::size_t walls_ = 0;
  std::size_t tables_ = 0;
  std::size_t cupboards_ = 0;
  std::size_t balls_ = 0;
};

}  // namespace

MeshScene make_rooms(std::size_t rooms, std::uint64_t seed) {
  auto rows = static_cast<std::size_t>(std::sqrt(static_cast<double>(rooms)));
  while (rooms % rows != 0) --rows;
  return RoomsBuilder(rooms / rows, rows, seed).build();
}

}  // namespace shaftcull::cli
