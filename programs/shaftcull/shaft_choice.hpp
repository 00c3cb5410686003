// SPDX-License-Identifier: MIT
/// Which shaft a command line asks for: the options that cull, draw and stats share.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/origin.hpp"

namespace shaftcull::cli {

enum class ShaftKind : std::uint8_t { between, swept, swept_infinite, shadow, hull };

/// As options and JSON spell it: "swept without end".
[[nodiscard]] std::string_view name(ShaftKind kind);

/// A shaft with its planes, or a convex hull in its place.
class FormedShaft {
 public:
  explicit FormedShaft(const CompiledShaft& shaft) : shaft_(shaft) {}
  FormedShaft(const ConvexHull& hull, Contact contact)
      : hull_(std::make_shared<const ConvexHull>(hull)), shaft_(*hull_) {
    set_contact(shaft_, contact);
  }

  /// Valid as long as this.
  [[nodiscard]] const CompiledShaft& compiled() const { return shaft_; }

 private:
  std::shared_ptr<const ConvexHull> hull_;  // that the shaft refers to
  CompiledShaft shaft_;
};

class ShaftChoice {
 public:
  /// Adds --swept, --infinite, --shadow, --reach and --contact. A body that is swept has no other end: `to` is the
  /// option for that, or null. This must live until the command line has been parsed.
  void add_options(CLI::App& subcommand, CLI::Option* to);
  /// Adds --hull and --towards. `excluded` are the options that a hull has no use for.
  void add_hull_options(CLI::App& subcommand, std::span<CLI::Option* const> excluded);

  /// Makes the corners of --hull relative to an origin. Call it after the command line has been parsed.
  void set_origin(const Origin& origin);

  [[nodiscard]] ShaftKind kind() const;
  [[nodiscard]] bool has_from() const { return kind() != ShaftKind::hull; }
  [[nodiscard]] bool has_to() const { return kind() == ShaftKind::between || kind() == ShaftKind::shadow; }
  /// The displacement of what is swept, or its direction if it has no end.
  [[nodiscard]] const Vec3& motion() const { return motion_; }
  /// Where a shadow ends, in distances of the occluder, if it does.
  [[nodiscard]] const std::optional<float>& reach() const { return reach_; }
  /// Of a hull.
  [[nodiscard]] const std::vector<Vec3>& points() const { return points_; }
  [[nodiscard]] const std::vector<Vec3>& directions() const { return directions_; }
  [[nodiscard]] Contact contact() const { return contact_ == "open" ? Contact::open : Contact::closed; }

  /// The shaft of boxes `from` and `to`; neither is read where the kind has no such end. Throws InvalidArgument, naming
  /// options, for what no shaft can be made of.
  [[nodiscard]] FormedShaft form(const Box& from, const Box& to) const;
  [[nodiscard]] FormedShaft form(const Box& from, const Box& to, Contact contact) const;

 private:
  bool swept_ = false;
  bool infinite_ = false;
  bool shadow_ = false;
  std::optional<float> reach_;
  Vec3 motion_{};
  std::vector<std::string> hull_;  ///< the texts of points_
  std::vector<Vec3> points_;
  std::vector<Vec3> directions_;
  std::string contact_ = "closed";
};

/// Whether two boxes have a common point: such a light and occluder have no shadow.
[[nodiscard]] bool touch(const Box& a, const Box& b);

}  // namespace shaftcull::cli
