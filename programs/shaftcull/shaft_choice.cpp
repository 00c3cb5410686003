// SPDX-License-Identifier: MIT
#include "shaft_choice.hpp"

#include <array>
#include <cstddef>

#include <fmt/format.h>

#include "box_text.hpp"
#include "number.hpp"
#include "shaftcull/error.hpp"
#include "shaftcull/volumes.hpp"

namespace shaftcull::cli {

std::string_view name(ShaftKind kind) {
  constexpr std::array names{"between", "swept", "swept without end", "shadow", "hull"};  // as in the enumeration
  return names[static_cast<std::size_t>(kind)];
}

bool touch(const Box& a, const Box& b) {
  for (std::size_t axis = 0; axis < 3; ++axis) {
    if (a.lo[axis] > b.hi[axis] || a.hi[axis] < b.lo[axis]) return false;
  }
  return true;
}

void ShaftChoice::add_options(CLI::App& subcommand, CLI::Option* to) {
  CLI::Option* swept = subcommand
                           .add_option_function<std::string>(
                               "--swept",
                               [this](const std::string& text) {
                                 motion_ = vector_option("--swept", text, "a displacement");
                                 swept_ = true;
                               },
                               "The volume that a box sweeps over when it moves by this displacement")
                           ->type_name("X,Y,Z");
  subcommand
      .add_flag("--infinite", infinite_,
                "With --swept: the box moves in this direction without end, like sunlight or a falling body")
      ->needs(swept);
  CLI::Option* shadow = subcommand
                            .add_flag("--shadow", shadow_,
                                      "The volume that the second box, an occluder, can shadow from the first, a light")
                            ->excludes(swept);
  subcommand
      .add_option_function<std::string>(
          "--reach",
          [this](const std::string& text) {
            constexpr double largest_reach = 1e38;
            reach_ = static_cast<float>(real_number("--reach", text, 1, largest_reach));
          },
          "With --shadow: up to R times the distance of the occluder (default: without end)")
      ->type_name("R")
      ->needs(shadow);
  subcommand
      .add_option("--contact", contact_,
                  "Bounds that only touch the shaft: closed keeps them, open does not (default: closed)")
      ->check(CLI::IsMember({"closed", "open"}))
      ->type_name("CONTACT");
  if (to != nullptr) to->excludes(swept);
}

void ShaftChoice::add_hull_options(CLI::App& subcommand, std::span<CLI::Option* const> excluded) {
  CLI::Option* hull = subcommand
                          .add_option_function<std::vector<std::string>>(
                              "--hull",
                              [this](const std::vector<std::string>& texts) {
                                hull_ = texts;
                                for (const std::string& text : texts) {
                                  const std::vector<Vec3> corners = corners_option("--hull", text);
                                  points_.insert(points_.end(), corners.begin(), corners.end());
                                }
                              },
                              "The convex hull of these points and boxes, up to 32 corners, instead of a shaft")
                          ->type_name("X,Y,Z|BOX");
  subcommand
      .add_option_function<std::string>(
          "--towards",
          [this](const std::string& text) { directions_ = {vector_option("--towards", text, "a direction")}; },
          "With --hull: extend the hull without end in this direction")
      ->type_name("X,Y,Z")
      ->needs(hull);
  for (CLI::Option* const option : excluded) hull->excludes(option);
  for (const char* const option : {"--swept", "--shadow"}) hull->excludes(subcommand.get_option(option));
}

void ShaftChoice::set_origin(const Origin& origin) {
  if (origin == Origin()) return;
  points_.clear();
  for (const std::string& text : hull_) {
    const std::vector<Vec3> corners = corners_option("--hull", text, origin);
    points_.insert(points_.end(), corners.begin(), corners.end());
  }
}

ShaftKind ShaftChoice::kind() const {
  if (!points_.empty()) return ShaftKind::hull;
  if (swept_) return infinite_ ? ShaftKind::swept_infinite : ShaftKind::swept;
  return shadow_ ? ShaftKind::shadow : ShaftKind::between;
}

FormedShaft ShaftChoice::form(const Box& from, const Box& to) const { return form(from, to, contact()); }

FormedShaft ShaftChoice::form(const Box& from, const Box& to, Contact contact) const {
  CompiledShaft shaft;
  switch (kind()) {
    case ShaftKind::hull:
      if (points_.size() + directions_.size() > ConvexHull::max_vertices) {
        throw InvalidArgument(fmt::format("--hull: {} corners and directions; a hull has at most {}",
                                          points_.size() + directions_.size(), ConvexHull::max_vertices));
      }
      if (directions_ == std::vector<Vec3>{Vec3{}}) {
        throw InvalidArgument("--towards 0,0,0: no direction; give one that is not 0");
      }
      return FormedShaft(ConvexHull(points_, directions_), contact);
    case ShaftKind::swept:
      shaft = swept(from, motion_);
      break;
    case ShaftKind::swept_infinite:
      if (motion_ == Vec3{}) {
        throw InvalidArgument("--swept 0,0,0: no direction for --infinite; give one that is not 0");
      }
      shaft = swept_infinite(from, motion_);
      break;
    case ShaftKind::shadow:
      if (touch(from, to)) {
        throw InvalidArgument(fmt::format(
            "--shadow: light [{}] and occluder [{}] touch, so all of space is in the shadow; give boxes that are apart",
            to_text(from), to_text(to)));
      }
      shaft = reach_ ? shadow(from, to, *reach_) : shadow(from, to);
      break;
    case ShaftKind::between:
      shaft = compile(from, to);
      break;
  }
  set_contact(shaft, contact);
  complete(shaft);
  return FormedShaft(shaft);
}

}  // namespace shaftcull::cli
