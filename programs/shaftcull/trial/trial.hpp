// SPDX-License-Identifier: MIT
/// Trials: what `shaftcull verify` compares, a shaft with a few dozen bounds and their right answers.
///
/// What trials are about is in between_boxes.cpp, moving_boxes.cpp and convex_hull.cpp, and what they ask in
/// classify.cpp, occluded.cpp, first_contact.cpp and triangles.cpp: right answers, and the library's.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "oracle/cases/families.hpp"
#include "oracle/cases/moving.hpp"
#include "oracle/convex_hull.hpp"
#include "oracle/random.hpp"
#include "oracle/shaft_input.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/function_ref.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/triangles.hpp"

namespace shaftcull::cli {

/// What is counted of bounds; sums of trials are sums of their members.
struct TrialCounts {
  std::uint64_t bounds = 0;
  std::uint64_t outside = 0;
  std::uint64_t inside = 0;
  std::uint64_t blocking = 0;          ///< boxes that block the shaft
  std::uint64_t undecided_slab = 0;    ///< left to the exact predicates, in slab form
  std::uint64_t undecided_planes = 0;  ///< likewise, in plane form
  std::uint64_t touching = 0;          ///< of those that rationals decided, exactly on the boundary
  std::uint64_t by_rationals = 0;      ///< right answers that come from rational arithmetic
  std::uint64_t wrong = 0;             ///< bounds with a wrong answer on any instruction set, in any form

  TrialCounts& operator+=(const TrialCounts& other) noexcept;
};

/// A shaft and bounds of one family, in memory as awkward as a view allows. The same for the same seed and number.
class Trial {
 public:
  /// Works out the right answers too. Families and the two shapes of bounds take turns by `number`, and so do, less
  /// often, kinds of moving boxes and convex hulls.
  Trial(std::uint64_t seed, std::uint64_t number, std::size_t bounds);

  /// What trials are about: families of shafts between two boxes, then kinds of moving boxes, then convex hulls, of
  /// points and directions, and between two ends.
  static constexpr std::size_t subjects = std::size(families) + std::size(moving_kinds) + 2;
  [[nodiscard]] static const char* subject_name(std::size_t subject) noexcept;

  /// How many bounds the trial of that number has when it is not cut short: mostly a word of them.
  [[nodiscard]] static std::size_t natural_size(std::uint64_t number) noexcept;

  [[nodiscard]] std::size_t subject() const noexcept { return subject_; }
  [[nodiscard]] const TrialCounts& counts() const noexcept { return counts_; }
  [[nodiscard]] bool has_spheres() const noexcept { return spheres_; }
  /// A description for every wrong bound, with all that is needed to see it again.
  [[nodiscard]] const std::vector<std::string>& failures() const noexcept { return failures_; }

  /// Asks every trial all questions in every form, on the active instruction set, and notes wrong answers.
  static void ask(std::span<Trial> trials);

 private:
  void make_between_boxes(Random& random, const Family& family, unsigned index);
  void make_moving(Random& random, MovingKind kind);
  void make_hull(Random& random);
  void make_hull_between_ends(Random& random);
  void set(std::size_t i, const Box& box) noexcept;
  void set(std::size_t i, const Sphere& sphere) noexcept;
  void note(std::size_t i, Answer right) noexcept;
  [[nodiscard]] BoxView boxes() const noexcept;
  [[nodiscard]] SphereView sphere_view() const noexcept;
  /// Calls f with the view of its bounds.
  template <class Function>
  void with_view(const Function& f) const {
    if (spheres_) {
      f(sphere_view());
    } else {
      f(boxes());
    }
  }
  void ask_all(const CompiledShaft& shaft, const char* how);
  /// Notes a bound as wrong for every bit that differs; `what` tells the question.
  void compare(const std::vector<std::uint64_t>& got, const std::vector<std::uint64_t>& right,
               FunctionRef<std::string()> what);

  // Questions. Of each, first what works out the right answers, then what asks the library, wherever it has any.
  void count_undecided();
  void ask_classes(const CompiledShaft& shaft, const char* how);
  template <class View>
  void ask_view(const CompiledShaft& shaft, const View& view, const char* how);
  template <class View>
  void ask_tree(const CompiledShaft& shaft, const View& view, const char* how);

  void note_blocking(std::size_t i, const ShaftInput& input);
  void note_blocking(std::size_t i, const HullInput& input);
  void ask_blocking(const CompiledShaft& shaft, const char* how);

  void sometimes_find_first_contact(Random& random);
  template <class View, class TimeOf, class NormalOf>
  void find_first_contact(const View& bounds, const TimeOf& time_of, const NormalOf& normal_of);
  void ask_first_contact(const CompiledShaft& shaft, const char* how);

  void sometimes_find_triangles(Random& random);
  template <class Input>
  void find_triangles(Random& random, const Input& input);
  void ask_triangles(const CompiledShaft& shaft, const char* how);

  void fail(std::size_t bound, const std::string& what);
  [[nodiscard]] std::string bound_text(std::size_t i) const;

  std::uint64_t number_;
  std::size_t subject_;
  std::size_t count_;
  bool spheres_;
  bool batched_ = false;  ///< its shaft is formed by a call for many, too
  std::variant<ShaftInput, MovingInput, HullInput> input_;
  std::optional<ConvexHull> hull_;  ///< that shaft_ refers to, if it is one
  CompiledShaft shaft_{};
  std::vector<float> memory_;
  std::size_t start_[6] = {};  ///< of each stream in memory_
  std::vector<std::uint64_t> kept_;
  std::vector<std::uint64_t> inside_;
  std::vector<std::uint64_t> blocking_;           ///< of shafts between two boxes or two ends
  std::optional<FirstContact> first_;             ///< right, if it is asked for
  std::vector<Triangle> triangles_;               ///< if triangles are asked about: as many as bounds
  std::vector<std::uint64_t> kept_triangles_[2];  ///< right, by TriangleTest
  std::vector<std::uint64_t> wrong_;
  TrialCounts counts_;
  std::vector<std::string> failures_;
};

}  // namespace shaftcull::cli
