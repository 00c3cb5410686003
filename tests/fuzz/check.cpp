// SPDX-License-Identifier: MIT
#include "fuzz/check.hpp"
#include "forms.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "columns.hpp"
#include "compiled/shaft_data.hpp"
#include "fuzz/packing.hpp"
#include "oracle/blocking.hpp"
#include "oracle/cases/moving.hpp"
#include "oracle/convex_hull.hpp"
#include "oracle/entry_time.hpp"
#include "oracle/grid_answers.hpp"
#include "oracle/hull.hpp"
#include "oracle/moving_hull.hpp"
#include "oracle/open_contact.hpp"
#include "oracle/shaft_input.hpp"
#include "oracle/triangle.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/first_contact.hpp"
#include "shaftcull/hull.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/occluded.hpp"

namespace shaftcull::fuzz {
namespace {

const std::vector<Isa>& isas() {
  static const std::vector<Isa> available = available_isas();
  return available;
}

bool is_finite(const Vec3& v) { return std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]); }

bool has_nan(const Vec3& v) { return std::isnan(v[0]) || std::isnan(v[1]) || std::isnan(v[2]); }
bool has_nan(const Box& box) { return has_nan(box.lo) || has_nan(box.hi); }
bool has_nan(const Sphere& sphere) { return has_nan(sphere.centre) || std::isnan(sphere.radius); }

bool is_joinable(const Box& box) { return is_finite(box.lo) && is_finite(box.hi) && is_legal(box); }

/// Whether all forms promise the same answer: all but what the headers call unspecified.
bool is_specified(const Box& box) {
  if (is_legal(box)) return true;
  for (std::size_t k = 0; k != 3; ++k) {
    if (box.lo[k] > box.hi[k]) return false;
  }
  return true;  // NaN, and no axis with lo > hi
}
bool is_specified(const Sphere& sphere) {
  const auto is_infinite = [](float x) { return std::isinf(x); };
  return !(sphere.radius < 0) && std::none_of(sphere.centre.begin(), sphere.centre.end(), is_infinite);
}

/// The result of `call`, or nothing if it throws InvalidArgument.
template <class Call>
auto unless_refused(const Call& call) -> std::optional<decltype(call())> {
  try {
    return call();
  } catch (const InvalidArgument&) {
    return std::nullopt;
  }
}

[[noreturn]] void fail(const std::string& what, const Case& it) { throw Fault(what + "\n  " + it.text()); }

/// The shaft, if it may be formed; a fault if it is refused without reason or accepted without right.
std::optional<Shaft> formed(const Case& it) {
  std::optional<Shaft> shaft = unless_refused([&] { return Shaft(it.a, it.b, it.options); });
  const bool is_right = is_joinable(it.a) && is_joinable(it.b);
  if (shaft.has_value() != is_right) fail(is_right ? "refused to form a good shaft" : "formed a bad shaft", it);
  if (!shaft) return shaft;
  for (const Formation formation : {Formation::search, Formation::table64, Formation::table729}) {
    ShaftOptions options = it.options;
    options.formation = formation;
    const Shaft other(it.a, it.b, options);
    const auto is_same = [](const JoiningPlane& p, const JoiningPlane& q) {
      return p.red == q.red && p.blue == q.blue && p.plane == q.plane;
    };
    const auto these = shaft->joining_planes();
    const auto those = other.joining_planes();
    // Planes that cut off equal volumes may come in any order.
    if (!std::is_permutation(these.begin(), these.end(), those.begin(), those.end(), is_same)) {
      fail("formations give different planes", it);
    }
  }
  std::size_t added = 0;
  for (const Plane& plane : it.planes) {
    const bool is_accepted = unless_refused([&] {
                               shaft->add_plane(plane);
                               return true;
                             }).has_value();
    const bool is_good = is_addable(plane);
    if (is_accepted != is_good) fail(is_good ? "refused a good plane" : "added a bad plane", it);
    added += is_good ? 1U : 0U;
  }
  if (shaft->added_planes().size() != added) fail("added planes are not those that were accepted", it);
  return shaft;
}

/// Answers for all bounds of a case; what lies beyond the last word is 0.
using Words = std::array<std::uint64_t, 2>;

bool bit(const Words& words, std::size_t i) { return (words[i / 64] >> i % 64 & 1U) != 0; }

/// Where a call writes its answers: memory of the exact size, so that AddressSanitizer sees what is written beyond it.
class Page {
 public:
  explicit Page(std::size_t bounds) : words_(bit_words(bounds)) {}

  [[nodiscard]] std::span<std::uint64_t> unwritten() {
    std::fill(words_.begin(), words_.end(), 0x5e5e5e5e5e5e5e5eU);
    return words_;
  }
  [[nodiscard]] Words read() const {
    Words copy{};
    std::copy(words_.begin(), words_.end(), copy.begin());
    return copy;
  }

 private:
  std::vector<std::uint64_t> words_;
};

/// All that can be asked of a shaft and a view.
struct Answers {
  Words culled{};
  Words kept{};
  Words inside{};
  Words inside_alone{};
};

const char* text(Form form) { return form == Form::slab ? "slab" : "planes"; }

template <class Bound>
class Comparison {
 public:
  Comparison(const Case& it, const std::vector<Bound>& bounds, std::optional<unsigned> draw)
      : it_(it), draw_(draw), bounds_(bounds), memory_(bounds), kept_(bounds.size()), inside_(bounds.size()) {}

  void run(const CompiledShaft& shaft, const CompiledShaft* pending) {
    for (const Form form : forms) {
      select_isa(Isa::scalar);
      Answers& scalar = form == Form::slab ? slab_ : planes_;
      scalar = ask_all(shaft, form);
      check(scalar);
      for (const Isa isa : isas()) {
        if (isa == Isa::scalar || !is_drawn(isa)) continue;
        select_isa(isa);
        require_same(shaft, scalar, isa, form);
        if (pending != nullptr && (draw_ || isa == isas().back())) require_same(*pending, scalar, isa, form);
      }
    }
    if constexpr (std::is_same_v<Bound, Box>) {
      for (const Isa isa : isas()) {
        if (!it_.is_moving() && !it_.is_hull() && (isa == Isa::scalar || is_drawn(isa)))
          require_exact_blocking(shaft, isa);
      }
      run_on_triangles(shaft);
    }
    if (!draw_ || *draw_ % 4 == 0) {
      for (const Isa isa : isas()) {
        if (!is_drawn(isa)) continue;
        for (const unsigned doublings : {0U, 6U}) {
          if (!draw_ || (*draw_ / 4 % 2 == 0) == (doublings == 0)) run_on_grid(shaft, isa, doublings);
        }
      }
    }
    for (std::size_t i = 0; i != bounds_.size(); ++i) {
      if (!is_specified(bounds_[i])) continue;
      if (bit(slab_.culled, i) != bit(planes_.culled, i)) fail_at(i, "forms keep differently");
      if (bit(slab_.inside, i) != bit(planes_.inside, i)) fail_at(i, "forms differ about inside");
    }
  }

 private:
  [[nodiscard]] bool is_drawn(Isa isa) const {
    return !draw_ || isas().size() == 1 || isa == isas()[1 + *draw_ / 8 % (isas().size() - 1)];
  }

  void run_on_grid(const CompiledShaft& shaft, Isa isa, unsigned doublings) {
    select_isa(isa);
    const GridAnswers on_grid = grid_answers(shaft, memory_.view(), doublings);
    const auto as_words = [](const std::vector<std::uint64_t>& row) {
      Words words{};
      std::copy(row.begin(), row.end(), words.begin());
      return words;
    };
    require_equal(as_words(on_grid.kept), slab_.culled, "a tile (kept)", isa, Form::slab);
    require_equal(as_words(on_grid.inside), slab_.inside, "a tile (inside)", isa, Form::slab);
  }

  /// What blocks in a view is what blocks alone, where the exact predicate is asked.
  void require_exact_blocking(const CompiledShaft& shaft, Isa isa) {
    select_isa(isa);
    std::vector<std::uint32_t> listed(bounds_.size());
    listed.resize(list_occluders(shaft, memory_.view(), listed));
    auto next = listed.begin();
    for (std::size_t i = 0; i != bounds_.size(); ++i) {
      const bool is_listed = next != listed.end() && *next == i;
      if (is_listed) ++next;
      if (is_listed != occluded(shaft, bounds_[i])) {
        fail_at(i, "list_occluders() on " + std::string(name(isa)) + " and occluded() differ");
      }
      if (is_listed && has_nan(bounds_[i])) fail_at(i, "blocks, but has a NaN");
      if (is_listed && it_.planes.empty() && !bit(slab_.culled, i)) fail_at(i, "blocks from outside");
    }
    const std::optional<std::uint32_t> first = find_occluder(shaft, memory_.view());
    if (first.has_value() == listed.empty() || (first && *first != listed[0])) fail("find_occluder() differs", it_);
  }

  /// Triangles made of the boxes' corners: the same bits on every set, and the exact ones where all is finite.
  void run_on_triangles(const CompiledShaft& shaft) {
    std::vector<Triangle> triangles;
    for (std::size_t i = 0; i != bounds_.size(); ++i) {
      const Box& box = bounds_[i];
      const Box& other = bounds_[(i + 1) % bounds_.size()];
      triangles.push_back({{box.lo, Vec3{box.hi[0], box.lo[1], box.hi[2]}, i % 2 == 0 ? box.hi : other.lo}});
    }
    const TriangleColumns memory(triangles);
    CompiledShaft closed = shaft;
    set_contact(closed, Contact::closed);
    for (const TriangleTest test : {TriangleTest::vertices, TriangleTest::exact}) {
      std::optional<std::pair<Words, Words>> scalar;
      for (const Isa isa : isas()) {
        if (isa != Isa::scalar && !is_drawn(isa)) continue;
        select_isa(isa);
        const std::pair<Words, Words> answers = triangles_of(shaft, memory.view(), test);
        if (!scalar) {
          scalar = answers;
          const auto& [kept, inside] = answers;
          for (std::size_t i = 0; i != triangles.size(); ++i) {
            if (!are_finite(triangles[i])) continue;
            require_inside(closed, triangles[i], bit(kept, i), bit(inside, i));
            require_exact_triangle(triangles[i], test, bit(kept, i));
          }
        }
        if (answers != *scalar) fail("triangles on " + std::string(name(isa)) + " differ from scalar", it_);
      }
    }
  }
  /// Bits of triangles that are kept, and of those inside.
  std::pair<Words, Words> triangles_of(const CompiledShaft& shaft, const TriangleView& triangles, TriangleTest test) {
    cull(shaft, triangles, kept_.unwritten(), {.triangle_test = test});
    const Words kept = kept_.read();
    classify(shaft, triangles, kept_.unwritten(), inside_.unwritten(), {.triangle_test = test});
    if (kept_.read() != kept) fail("cull() and classify() keep different triangles", it_);
    return {kept, inside_.read()};
  }
  /// Inside is a triangle that is kept and whose vertices are inside, with closed contact.
  void require_inside(const CompiledShaft& closed, const Triangle& triangle, bool is_kept, bool is_inside) const {
    const bool right = is_kept && std::all_of(triangle.vertex.begin(), triangle.vertex.end(), [&](const Vec3& vertex) {
                         return classify(closed, Box{vertex, vertex}) == Answer::inside;
                       });
    if (is_inside != right) fail("whether a triangle is inside is answered wrongly: " + source_text(triangle), it_);
  }
  static bool are_finite(const Triangle& triangle) {
    return std::all_of(triangle.vertex.begin(), triangle.vertex.end(), is_finite);
  }
  void require_exact_triangle(const Triangle& triangle, TriangleTest test, bool is_kept) const {
    if (draw_ && *draw_ % 8 != 0) return;  // rationals take long
    const Case::Input input = it_.input();
    const auto* const moving = std::get_if<MovingInput>(&input);
    const auto* const hull = std::get_if<HullInput>(&input);
    const bool is_outside = moving != nullptr ? oracle::is_outside(*moving, triangle, test)
                            : hull != nullptr ? oracle::is_outside(*hull, triangle, test, it_.contact)
                                              : oracle::is_outside(std::get<ShaftInput>(input), triangle, test);
    if (is_outside != is_kept) return;
    fail("a triangle is answered wrongly: " + source_text(triangle), it_);
  }

  Words culled(const CompiledShaft& shaft, Form form) {
    cull(in_form(shaft, form), memory_.view(), kept_.unwritten());
    return kept_.read();
  }
  std::pair<Words, Words> classified(const CompiledShaft& shaft, Form form) {
    // Without bounds there are no words of kept ones, and those inside are asked for alone.
    if (bounds_.empty()) static_cast<void>(culled(shaft, form));
    classify(in_form(shaft, form), memory_.view(), kept_.unwritten(), inside_.unwritten());
    return {kept_.read(), inside_.read()};
  }
  Words inside_alone(const CompiledShaft& shaft) {
    classify(shaft, memory_.view(), {}, inside_.unwritten());
    return inside_.read();
  }

  Answers ask_all(const CompiledShaft& shaft, Form form) {
    Answers answers;
    std::tie(answers.kept, answers.inside) = classified(shaft, form);
    answers.culled = culled(shaft, form);
    // Without kept bounds, the form makes no difference.
    answers.inside_alone = form == Form::slab ? inside_alone(shaft) : slab_.inside_alone;
    return answers;
  }

  /// Asks the active instruction set.
  void require_same(const CompiledShaft& shaft, const Answers& scalar, Isa isa, Form form) {
    require_equal(culled(shaft, form), scalar.culled, "cull()", isa, form);
    if (form == Form::slab)
      require_equal(inside_alone(shaft), scalar.inside_alone, "classify() (inside alone)", isa, form);
    const auto [kept, inside] = classified(shaft, form);
    require_equal(kept, scalar.kept, "classify() (kept)", isa, form);
    require_equal(inside, scalar.inside, "classify() (inside)", isa, form);
  }

  [[noreturn]] void fail_at(std::size_t i, const std::string& what) const {
    fail(what + "\n  bound " + std::to_string(i) + ": " + source_text(bounds_[i]), it_);
  }

  void require_equal(const Words& answers, const Words& scalar, const char* what, Isa isa, Form form) const {
    if (answers == scalar) return;
    const std::string where = std::string(what) + " on " + std::string(name(isa)) + ", form " + text(form);
    for (std::size_t i = 0; i != bounds_.size(); ++i) {
      if (bit(answers, i) != bit(scalar, i)) fail_at(i, where + " differs from scalar");
    }
    fail(where + " writes past the last bound", it_);
  }

  void check(const Answers& answers) const {
    if (answers.kept != answers.culled) fail("cull() and classify() keep differently", it_);
    for (std::size_t i = 0; i != bounds_.size(); ++i) {
      if (bit(answers.inside, i) && !bit(answers.kept, i)) fail_at(i, "inside but not kept");
      if (bit(answers.inside_alone, i) && has_nan(bounds_[i])) fail_at(i, "NaN inside");
      if (is_specified(bounds_[i]) && bit(answers.inside, i) != bit(answers.inside_alone, i)) {
        fail_at(i, "inside alone is another answer");
      }
    }
    const std::size_t rest = bounds_.size() % 64;
    if (rest == 0) return;
    for (const Words* words : {&answers.culled, &answers.inside, &answers.inside_alone}) {
      if ((*words)[bounds_.size() / 64] >> rest != 0) fail("bits past the last bound are set", it_);
    }
  }

  const Case& it_;
  std::optional<unsigned> draw_;
  const std::vector<Bound>& bounds_;
  decltype(columns(std::vector<Bound>{})) memory_;
  Page kept_;
  Page inside_;
  Answers slab_;
  Answers planes_;
};

/// Whether the slab forms are the same.
bool same_slab(const CompiledShaft& one, const CompiledShaft& other) {
  const kernel::ShaftData& p = kernel::data_of(one);
  const kernel::ShaftData& q = kernel::data_of(other);
  return std::equal(std::begin(p.slab_scale), std::end(p.slab_scale), std::begin(q.slab_scale)) &&
         std::equal(std::begin(p.slab_shift), std::end(p.slab_shift), std::begin(q.slab_shift)) &&
         std::equal(std::begin(p.slab_near), std::end(p.slab_near), std::begin(q.slab_near)) &&
         p.slab_margin == q.slab_margin && p.slab_uppers == q.slab_uppers && p.slab_form == q.slab_form &&
         one.a() == other.a() && one.b() == other.b();
}

/// The pair as one of a batch, on every instruction set: refused if it must be, and the same bits wherever in the
/// batch.
std::optional<CompiledShaft> batched(const Case& it) {
  constexpr std::size_t copies = 17;  // whole vectors of all widths, and a rest
  const BoxColumns a(std::vector<Box>(copies, it.a));
  const BoxColumns b(std::vector<Box>(copies, it.b));
  std::vector<CompiledShaft> out(copies);
  std::optional<CompiledShaft> scalar;
  for (const Isa isa : isas()) {
    select_isa(isa);
    std::fill(out.begin(), out.end(), CompiledShaft{});
    const bool is_accepted = unless_refused([&] {
                               compile_batch(a.view(), b.view(), out);
                               return true;
                             }).has_value();
    if (is_accepted != (is_joinable(it.a) && is_joinable(it.b))) fail("a batch refuses or takes a pair wrongly", it);
    if (!is_accepted) continue;
    if (!scalar) scalar = out[0];
    for (const CompiledShaft& shaft : out) {
      if (!same_slab(shaft, *scalar)) fail("a batch on " + std::string(name(isa)) + " differs from scalar", it);
    }
  }
  return scalar;
}

/// Whether the calls that form it take what the case describes, planes left out.
bool is_formable(const MovingInput& input) {
  if (!is_joinable(input.box)) return false;
  if (!input.is_shadow()) {
    return is_finite(input.displacement) && (!input.is_endless() || input.displacement != Vec3{});
  }
  return is_joinable(input.light) && are_apart(input.light, input.box) &&
         (input.is_endless() || (std::isfinite(input.reach) && input.reach >= 1));
}
bool is_formable(const HullInput& input) {
  return std::all_of(input.points.begin(), input.points.end(), is_finite) &&
         std::all_of(input.directions.begin(), input.directions.end(),
                     [](const Vec3& direction) { return is_finite(direction) && direction != Vec3{}; });
}

/// The shaft of a moving box, if it may be formed; a fault if it is refused without reason or accepted without right.
std::optional<CompiledShaft> formed(const Case& it, const MovingInput& input) {
  std::optional<CompiledShaft> shaft = unless_refused([&] { return shaft_of(input); });
  const bool is_right = is_formable(input);
  if (shaft.has_value() != is_right) fail(is_right ? "refused to form a good shaft" : "formed a bad shaft", it);
  MovingInput with_all = input;
  with_all.added = it.planes;
  const bool are_good = std::all_of(it.planes.begin(), it.planes.end(), is_addable);
  if (unless_refused([&] { return shaft_of(with_all); }).has_value() != (is_right && are_good))
    fail(are_good ? "refused good planes" : "added a bad plane", it);
  return shaft;
}

/// Likewise a convex hull.
std::optional<ConvexHull> formed(const Case& it, const HullInput& input) {
  std::optional<ConvexHull> hull = unless_refused([&] { return ConvexHull(input.points, input.directions); });
  const bool is_right = is_formable(input);
  if (hull.has_value() != is_right) fail(is_right ? "refused to form a good hull" : "formed a bad hull", it);
  return hull;
}

/// The shaft of a hull, with the contact of the case.
CompiledShaft shaft_of(const Case& it, const ConvexHull& hull) {
  CompiledShaft shaft = hull;
  set_contact(shaft, it.contact);
  return shaft;
}

/// A fault unless the oracle's answers about the first bounds are those of the shaft.
template <class Hull>
void require_exact(const Case& it, const CompiledShaft& shaft, const Hull& hull, std::size_t most_bounds) {
  const auto check = [&](const auto& bound, const auto& corrected) {
    const Answer answer = classify(shaft, bound);
    const Answer right = corrected(answer);
    if (answer == right) return;
    fail(source_text(bound) + "\n  is " + shaftcull::text(right) + ", answered " + shaftcull::text(answer), it);
  };
  for (std::size_t i = 0; i != std::min(most_bounds, it.boxes.size()); ++i) {
    const Box& box = it.boxes[i];
    if (!is_legal(box) || (it.is_moving() && !is_joinable(box))) continue;
    check(box, [&](Answer) { return hull.answer(box); });
  }
  for (std::size_t i = 0; i != std::min(most_bounds, it.spheres.size()); ++i) {
    const Sphere& sphere = it.spheres[i];
    const bool is_between = !it.is_moving() && !it.is_hull();
    if (!is_legal(sphere) || (!is_between && !std::isfinite(sphere.radius))) continue;
    check(sphere, [&](Answer answer) {
      if constexpr (requires { hull.corrected(sphere, answer); }) {
        return hull.corrected(sphere, answer);
      } else {
        static_cast<void>(answer);
        return hull.answer(sphere);
      }
    });
  }
}

/// Entry times of the first boxes that are kept, and infinity for the others.
template <class TimeOf>
void require_exact_times(const Case& it, const CompiledShaft& shaft, std::size_t most_bounds, const TimeOf& time_of) {
  std::vector<Box> boxes(it.boxes.begin(),
                         it.boxes.begin() + static_cast<std::ptrdiff_t>(std::min(most_bounds, it.boxes.size())));
  boxes.erase(std::remove_if(boxes.begin(), boxes.end(), [](const Box& box) { return !is_joinable(box); }),
              boxes.end());
  const BoxColumns memory(boxes);
  std::vector<std::uint32_t> indices;
  for (std::size_t i = 0; i != boxes.size(); ++i) indices.push_back(static_cast<std::uint32_t>(i));
  std::vector<float> times(boxes.size());
  entry_times(shaft, memory.view(), indices, times);
  for (std::size_t i = 0; i != boxes.size(); ++i) {
    const bool is_kept = keeps(shaft, boxes[i]);
    const std::optional<mpq_class> time = time_of(boxes[i]);
    if (is_kept && !time) fail(source_text(boxes[i]) + "\n  is kept, but never reached", it);
    const float right = is_kept ? oracle::rounded_down(*time) : std::numeric_limits<float>::infinity();
    if (times[i] != right) fail(source_text(boxes[i]) + "\n  is reached at another time", it);
  }
}

void check_exact_between(const Case& it, const ShaftInput& of, std::size_t most_bounds) {
  if (!is_joinable(it.a) || !is_joinable(it.b)) return;
  const CompiledShaft shaft = shaft_of(of);
  if (of.contact == Contact::open) {
    require_exact(it, shaft, oracle::OpenHull(of), most_bounds);
  } else {
    require_exact(it, shaft, oracle::Hull(of.a, of.b, of.added), most_bounds);
  }
  for (std::size_t i = 0; i != std::min(most_bounds, it.boxes.size()); ++i) {
    const bool right = oracle::blocks(of.a, of.b, it.boxes[i]);
    if (occluded(shaft, it.boxes[i]) != right) {
      fail(source_text(it.boxes[i]) + (right ? "\n  blocks" : "\n  does not block") + ", answered otherwise", it);
    }
  }
  require_exact_times(it, shaft, most_bounds, [&](const Box& box) { return oracle::entry_time(of.a, of.b, box); });
}

void check_exact_moving(const Case& it, const MovingInput& of, std::size_t most_bounds) {
  if (!is_formable(of)) return;
  const CompiledShaft shaft = shaft_of(of);
  if (of.contact == Contact::open) {
    require_exact(it, shaft, oracle::OpenHull(of), most_bounds);
  } else {
    require_exact(it, shaft, oracle::MovingHull(of), most_bounds);
  }
  require_exact_times(it, shaft, most_bounds, [&](const Box& box) { return oracle::entry_time(of, box); });
}

void check_exact_hull(const Case& it, const HullInput& of, std::size_t most_bounds) {
  if (!is_formable(of)) return;
  const ConvexHull hull(of.points, of.directions);
  const CompiledShaft shaft = shaft_of(it, hull);
  if (it.contact == Contact::open) {
    require_exact(it, shaft, oracle::OpenConvexHull(of), most_bounds);
  } else {
    require_exact(it, shaft, oracle::ConvexHull(of), most_bounds);
  }
}

void check_between_boxes(const Case& it, std::optional<unsigned> draw) {
  const std::optional<CompiledShaft> batch = batched(it);
  const std::optional<Shaft> formed_one = formed(it);
  if (!formed_one) return;
  CompiledShaft shaft = compile(*formed_one);
  CompiledShaft pending = compile(it.a, it.b, formed_one->added_planes());
  if (!same_slab(shaft, *batch) || !same_slab(shaft, pending)) fail("compile() and compile_batch() differ", it);
  set_contact(shaft, it.contact);
  set_contact(pending, it.contact);
  Comparison<Box>(it, it.boxes, draw).run(shaft, &pending);
  Comparison<Sphere>(it, it.spheres, draw).run(shaft, &pending);
}

void check_moving(const Case& it, const MovingInput& input, std::optional<unsigned> draw) {
  const std::optional<CompiledShaft> pending = formed(it, input);
  if (!pending) return;
  CompiledShaft shaft = *pending;
  complete(shaft);
  Comparison<Box>(it, it.boxes, draw).run(shaft, &*pending);
  Comparison<Sphere>(it, it.spheres, draw).run(shaft, &*pending);
}

void check_hull(const Case& it, const HullInput& input, std::optional<unsigned> draw) {
  const std::optional<ConvexHull> hull = formed(it, input);
  if (!hull) return;
  const CompiledShaft shaft = shaft_of(it, *hull);
  Comparison<Box>(it, it.boxes, draw).run(shaft, nullptr);
  Comparison<Sphere>(it, it.spheres, draw).run(shaft, nullptr);
}

}  // namespace

void check_answers(const Case& it, std::optional<unsigned> draw) {
  const Isa before = active_isa();
  check_packing(it);
  const Case::Input input = it.input();
  if (const auto* const moving = std::get_if<MovingInput>(&input)) {
    check_moving(it, *moving, draw);
  } else if (const auto* const hull = std::get_if<HullInput>(&input)) {
    check_hull(it, *hull, draw);
  } else {
    check_between_boxes(it, draw);
  }
  select_isa(before);
}

void check_exact(const Case& it, std::size_t most_bounds) {
  const Case::Input input = it.input();
  if (const auto* const moving = std::get_if<MovingInput>(&input)) {
    check_exact_moving(it, *moving, most_bounds);
  } else if (const auto* const hull = std::get_if<HullInput>(&input)) {
    check_exact_hull(it, *hull, most_bounds);
  } else {
    check_exact_between(it, std::get<ShaftInput>(input), most_bounds);
  }
}

}  // namespace shaftcull::fuzz
