#include "trial.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <type_traits>

#include <fmt/format.h>

#include "oracle/blocking.hpp"
#include "oracle/cases/families.hpp"
#include "oracle/cases/hulls.hpp"
#include "oracle/cases/moving.hpp"
#include "oracle/cases/triangles.hpp"
#include "oracle/entry_time.hpp"
#include "oracle/grid_answers.hpp"
#include "oracle/hull.hpp"
#include "oracle/moving_hull.hpp"
#include "oracle/open_contact.hpp"
#include "oracle/quick_hull.hpp"
#include "oracle/random.hpp"
#include "oracle/triangle.hpp"
#include "shaftcull/blocked.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/kinds.hpp"
#include "shaftcull/query.hpp"
#include "shaftcull/shaft.hpp"
#include "shaftcull/tree.hpp"
#include "undecided.hpp"

namespace shaftcull::cli {
namespace {

/// Of the answers that the quick oracle proves, one in this many is worked out in rationals all the same.
constexpr unsigned second_opinion = 64;

/// Of the trials with boxes, one in this many is asked for first contact: rationals work it out.
constexpr unsigned contact_trials = 8;

/// Of the trials, one in this many is about open contact: rationals work out all of its answers.
constexpr unsigned open_trials = 32;

/// Likewise about triangles, for the same reason.
constexpr unsigned triangle_trials = 64;

/// Likewise about moving boxes and convex hulls. Of those with moving boxes one in a few is about open contact.
constexpr std::uint64_t other_trials = 6;
constexpr unsigned open_moving_trials = 4;

/// Sebastiano Vigna's splitmix64: neighbouring numbers become unrelated seeds.
constexpr std::uint64_t mixed(std::uint64_t x) noexcept {
  x += 0x9e3779b97f4a7c15;
  x = (x ^ (x >> 30U)) * 0xbf58476d1ce4e5b9;
  x = (x ^ (x >> 27U)) * 0x94d049bb133111eb;
  return x ^ (x >> 31U);
}

Shaft formed(Random& random, const ShaftInput& input) {
  ShaftOptions options;
  options.contact = input.contact;
  options.formation = static_cast<Formation>(random.below(3));
  options.order = static_cast<PlaneOrder>(random.below(3));
  Shaft shaft(input.a, input.b, options);
  for (const Plane& plane : input.added) shaft.add_plane(plane);
  return shaft;
}

std::uint64_t population(const std::vector<std::uint64_t>& words) {
  std::uint64_t count = 0;
  for (const std::uint64_t word : words) count += static_cast<std::uint64_t>(std::popcount(word));
  return count;
}

constexpr std::uint64_t bit(std::size_t i) noexcept { return std::uint64_t{1} << i % 64; }

bool is_finite(const Triangle& triangle) {
  return std::all_of(triangle.vertex.begin(), triangle.vertex.end(), [](const Vec3& vertex) {
    return std::isfinite(vertex[0]) && std::isfinite(vertex[1]) && std::isfinite(vertex[2]);
  });
}

/// The same shaft, formed by the call for many.
CompiledShaft batch_of(const MovingInput& input) {
  const BoxStream boxes(std::vector<Box>{input.box});
  const BoxStream lights(std::vector<Box>{input.light});
  const std::span<const Vec3> displacements(&input.displacement, 1);
  CompiledShaft shaft;
  const std::span<CompiledShaft> out(&shaft, 1);
  switch (input.kind) {
    case MovingKind::swept:
      swept_batch(boxes.view(), displacements, out, input.added);
      break;
    case MovingKind::swept_without_end:
      swept_without_end_batch(boxes.view(), displacements, out, input.added);
      break;
    case MovingKind::shadow:
      shadow_batch(lights.view(), boxes.view(), input.reach, out, {.b = input.added});
      break;
    case MovingKind::shadow_without_end:
      shadow_batch(lights.view(), boxes.view(), out, {.b = input.added});
      break;
  }
  set_contact(shaft, input.contact);
  return shaft;
}

/// Whose turn it is: what a trial is about depends on its number alone.
struct Turn {
  std::size_t subject;
  bool has_spheres;
  unsigned round;  ///< how often it was that subject's turn before, with either shape of bounds

  explicit Turn(std::uint64_t number) noexcept {
    const bool is_other = number % other_trials == other_trials - 1;
    const std::uint64_t turn = is_other ? number / other_trials : number - number / other_trials;
    const std::size_t first = is_other ? std::size(families) : 0;
    const std::size_t count = is_other ? Trial::subjects - std::size(families) : std::size(families);
    subject = first + static_cast<std::size_t>(turn % count);
    has_spheres = turn / count % 2 != 0;
    round = static_cast<unsigned>(turn / count / 2);
  }
};

}  // namespace

TrialCounts& TrialCounts::operator+=(const TrialCounts& other) noexcept {
  bounds += other.bounds;
  outside += other.outside;
  inside += other.inside;
  blocking += other.blocking;
  undecided_slab += other.undecided_slab;
  undecided_planes += other.undecided_planes;
  touching += other.touching;
  by_rationals += other.by_rationals;
  wrong += other.wrong;
  return *this;
}

std::size_t Trial::natural_size(std::uint64_t number) noexcept {
  const std::uint64_t mix = mixed(number);
  return mix % 8 == 0 ? 1 + static_cast<std::size_t>(mix >> 8U) % 150 : 64;
}

Trial::Trial(std::uint64_t seed, std::uint64_t number, std::size_t bounds)
    : number_(number),
      subject_(Turn(number).subject),
      count_(bounds),
      spheres_(Turn(number).has_spheres),
      kept_(words_for(bounds)),
      inside_(words_for(bounds)),
      blocking_(words_for(bounds)),
      wrong_(words_for(bounds)) {
  Random random(mixed(seed) ^ number);
  // Streams of any alignment, with NaN around them: a kernel that reads past its view shows it.
  const std::size_t streams = spheres_ ? 4 : 6;
  memory_.assign(streams * (count_ + 16), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t s = 0; s != streams; ++s) start_[s] = s * (count_ + 16) + random.below(16);
  if (subject_ < std::size(families)) {
    make_between_boxes(random, families[subject_], Turn(number).round);
  } else if (subject_ < std::size(families) + std::size(moving_kinds)) {
    make_moving(random, moving_kinds[subject_ - std::size(families)]);
  } else {
    make_hull(random);
  }
  counts_.bounds = count_;
  counts_.outside = count_ - population(kept_);
  counts_.inside = population(inside_);
  counts_.blocking = population(blocking_);
  if (spheres_) {
    count_undecided(sphere_view());
  } else {
    count_undecided(boxes());
  }
}

void Trial::make_between_boxes(Random& random, const Family& family, unsigned index) {
  ShaftInput input = family.shaft(random, index);
  if ((mixed(number_) >> 40U) % open_trials == 0) input.contact = Contact::open;
  input_ = input;
  shaft_ = compile(formed(random, input));
  batched_ = input.added.empty() && random.one_in(2);

  const oracle::QuickHull quick(input);
  std::optional<oracle::Hull> exact;
  std::optional<oracle::OpenHull> open;
  if (input.contact == Contact::open) open.emplace(input);
  const auto answer_by_oracle = [&](std::size_t i, const auto& bound) {
    const std::optional<Answer> proved = quick.answer(bound);
    Answer right{};
    if (open) {
      right = open->answer(bound);
      ++counts_.by_rationals;
      if (proved && *proved == Answer::outside && right != Answer::outside)
        fail(i, "oracles disagree: open contact keeps what closed contact does not");
    } else if (proved && !random.one_in(second_opinion)) {
      right = *proved;
    } else {
      if (!exact) exact.emplace(input.a, input.b, input.added);
      right = exact->answer(bound);
      ++counts_.by_rationals;
      if (!proved && right != Answer::outside && exact->touches(bound)) ++counts_.touching;
      if (proved && *proved != right)
        fail(i, fmt::format("oracles disagree: rationals {}, intervals {}", text(right), text(*proved)));
    }
    note(i, right);
  };
  for (std::size_t i = 0; i != count_; ++i) {
    if (spheres_) {
      const Sphere sphere = family.sphere(random, input, quick);
      set(i, sphere);
      answer_by_oracle(i, sphere);
    } else {
      const Box box = random.one_in(8) ? blocking_box(random, input) : family.box(random, input);
      set(i, box);
      answer_by_oracle(i, box);
      // What blocks meets the shaft between the boxes; whether a plane that was added is in the way does not matter.
      const bool is_outside = input.added.empty() && (kept_[i / 64] & bit(i)) == 0;
      if (!is_outside && oracle::blocks(input.a, input.b, box)) blocking_[i / 64] |= bit(i);
    }
  }
  if (random.one_in(contact_trials)) {
    find_first_contact([&](const auto& bound) { return oracle::entry_time(input.a, input.b, bound); });
  }
  if (!spheres_ && random.one_in(triangle_trials)) find_triangles(random, input, input);
}

void Trial::make_moving(Random& random, MovingKind kind) {
  const MovingFamily& family = moving_families[random.below(std::size(moving_families))];
  MovingInput input = family.input(random, kind);
  if (random.one_in(open_moving_trials)) input.contact = Contact::open;
  input_ = input;
  shaft_ = shaft_of(input);
  if (random.one_in(2)) complete(shaft_);
  batched_ = random.one_in(2);

  const oracle::MovingHull closed(input);
  std::optional<oracle::OpenHull> open;
  if (input.contact == Contact::open) open.emplace(input);
  const auto answer_by_oracle = [&](std::size_t i, const auto& bound) {
    set(i, bound);
    note(i, open ? open->answer(bound) : closed.answer(bound));
    ++counts_.by_rationals;
  };
  for (std::size_t i = 0; i != count_; ++i) {
    if (spheres_) {
      answer_by_oracle(i, family.sphere(random, input, closed));
    } else {
      answer_by_oracle(i, family.box(random, input));
    }
  }
  if (random.one_in(contact_trials)) {
    find_first_contact([&](const auto& bound) { return oracle::entry_time(input, bound); });
  }
  if (!spheres_ && random.one_in(triangle_trials)) find_triangles(random, input, part_of(random, input));
}

void Trial::make_hull(Random& random) {
  const HullFamily& family = hull_families[random.below(std::size(hull_families))];
  const HullInput input = family.input(random);
  input_ = input;
  hull_.emplace(input.points, input.directions);
  shaft_ = hull_->compiled();
  const oracle::ConvexHull exact(input);
  for (std::size_t i = 0; i != count_; ++i) {
    if (spheres_) {
      // Some may be kept that miss the hull: all instruction sets must answer as this one does, and that must be one of
      // the answers that are right.
      const Sphere sphere = family.sphere(random, input, exact);
      set(i, sphere);
      note(i, exact.corrected(sphere, classify(shaft_, sphere)));
    } else {
      const Box box = family.box(random, input);
      set(i, box);
      note(i, exact.answer(box));
    }
    ++counts_.by_rationals;
  }
}

const char* Trial::subject_name(std::size_t subject) noexcept {
  constexpr const char* kind_names[] = {"swept", "swept without end", "shadow", "shadow without end"};
  static_assert(std::size(kind_names) == std::size(moving_kinds));
  if (subject < std::size(families)) return families[subject].name;
  subject -= std::size(families);
  return subject < std::size(kind_names) ? kind_names[subject] : "convex hulls";
}

void Trial::set(std::size_t i, const Box& box) noexcept {
  for (std::size_t k = 0; k != 3; ++k) {
    memory_[start_[k] + i] = box.lo[k];
    memory_[start_[k + 3] + i] = box.hi[k];
  }
}

void Trial::set(std::size_t i, const Sphere& sphere) noexcept {
  for (std::size_t k = 0; k != 3; ++k) memory_[start_[k] + i] = sphere.centre[k];
  memory_[start_[3] + i] = sphere.radius;
}

void Trial::note(std::size_t i, Answer right) noexcept {
  if (right != Answer::outside) kept_[i / 64] |= bit(i);
  if (right == Answer::inside) inside_[i / 64] |= bit(i);
}

BoxView Trial::boxes() const noexcept {
  BoxView view;
  for (std::size_t s = 0; s != 6; ++s) view.stream[s] = memory_.data() + start_[s];
  view.count = count_;
  return view;
}

SphereView Trial::sphere_view() const noexcept {
  SphereView view;
  for (std::size_t s = 0; s != 4; ++s) view.stream[s] = memory_.data() + start_[s];
  view.count = count_;
  return view;
}

template <class Input>
void Trial::find_triangles(Random& random, const Input& input, const ShaftInput& near) {
  for (std::vector<std::uint64_t>& kept : kept_triangles_) kept.resize(words_for(count_));
  while (triangles_.size() != count_) {
    const Triangle triangle = random.one_in(2) ? nearby_triangle(random, near) : touching_triangle(random, near);
    if (!is_finite(triangle)) continue;  // of a huge shaft
    const std::size_t i = triangles_.size();
    triangles_.push_back(triangle);
    for (const TriangleTest test : {TriangleTest::vertices, TriangleTest::exact}) {
      if (oracle::is_outside(input, triangle, test)) continue;
      kept_triangles_[static_cast<std::size_t>(test)][i / 64] |= bit(i);
    }
  }
}

void Trial::ask_triangles(const CompiledShaft& shaft, const char* how) {
  if (triangles_.empty()) return;
  const TriangleStream stream{std::span<const Triangle>(triangles_)};
  const TriangleTree tree(stream.view());
  for (const TriangleTest test : {TriangleTest::vertices, TriangleTest::exact}) {
    const std::vector<std::uint64_t>& right = kept_triangles_[static_cast<std::size_t>(test)];
    const auto compare_triangles = [&](const std::vector<std::uint64_t>& got, const char* of) {
      for (std::size_t i = 0; i != count_; ++i) {
        if (((got[i / 64] ^ right[i / 64]) & bit(i)) == 0) continue;
        fail(i, fmt::format("cull of triangles of a {}, {}, {}, {}: bit {} instead of {} for {}", of, how,
                            name(active_isa()), test == TriangleTest::exact ? "exact" : "by vertices",
                            (got[i / 64] & bit(i)) != 0 ? 1 : 0, (right[i / 64] & bit(i)) != 0 ? 1 : 0,
                            source_text(triangles_[i])));
      }
    };
    std::vector<std::uint64_t> kept(right.size());
    cull(shaft, stream.view(), kept, test);
    compare_triangles(kept, "stream");
    cull(shaft, tree, kept, test);
    compare_triangles(kept, "tree");
  }
}

template <class TimeOf>
void Trial::find_first_contact(const TimeOf& time_of) {
  if (spheres_) {
    find_first_contact(sphere_view(), time_of);
  } else {
    find_first_contact(boxes(), time_of);
  }
}

template <class View, class TimeOf>
void Trial::find_first_contact(const View& bounds, const TimeOf& time_of) {
  FirstContactOf<std::uint64_t> first;
  decltype(time_of(bounds[0])) least;
  for (std::size_t i = 0; i != count_; ++i) {
    if ((kept_[i / 64] & bit(i)) == 0) continue;
    const auto time = time_of(bounds[i]);
    if (!time) {
      fail(i, "oracles disagree: a bound that is kept is never reached");
      continue;
    }
    if (least && *least <= *time) continue;
    least = time;
    first = {i, oracle::rounded_down(*time)};
  }
  first_ = first;
}

template <class View>
void Trial::ask_first_contact(const CompiledShaft& shaft, const View& bounds, const char* how) {
  if (!first_ || count_ == 0) return;
  const auto compare_contact = [&](const FirstContactOf<std::uint64_t>& got, const char* of) {
    if (got == *first_) return;
    fail(got ? got.index : first_->index,
         fmt::format("first_contact of a {}, {}, {}: bound {} at {} instead of {} at {}", of, how, name(active_isa()),
                     got.index, got.time, first_->index, first_->time));
  };
  using Bound = std::conditional_t<std::is_same_v<View, BoxView>, Box, Sphere>;
  compare_contact(first_contact(shaft, bounds, Form::slab), "view, slab");
  compare_contact(first_contact(shaft, bounds, Form::planes), "view, planes");
  compare_contact(first_contact(shaft, BoundsTree<Bound, std::uint64_t>(bounds)), "tree");
}

template <class View>
void Trial::count_undecided(const View& view) {
  std::vector<std::uint64_t> asked(kept_.size());
  std::vector<std::uint64_t> kept(kept_.size());
  std::vector<std::uint64_t> inside(kept_.size());
  CompiledShaft with_planes = shaft_;
  complete(with_planes);
  for (const Form form : {Form::slab, Form::planes}) {
    undecided(with_planes, view, form, asked, kept, inside);
    (form == Form::slab ? counts_.undecided_slab : counts_.undecided_planes) = population(asked);
  }
}

template <class What>
void Trial::compare(const std::vector<std::uint64_t>& got, const std::vector<std::uint64_t>& right, const What& what) {
  for (std::size_t w = 0; w != got.size(); ++w) {
    for (std::uint64_t differ = (got[w] ^ right[w]) & ~wrong_[w]; differ != 0; differ &= differ - 1) {
      const std::size_t i = w * 64 + static_cast<std::size_t>(std::countr_zero(differ));
      if (i < count_) {
        fail(i, fmt::format("{}: bit {} instead of {}", what(), (got[w] & bit(i)) != 0 ? 1 : 0,
                            (right[w] & bit(i)) != 0 ? 1 : 0));
      } else {
        fail(count_ - 1, fmt::format("{}: bit {} past the last bound is set", what(), i));
      }
    }
  }
}

void Trial::ask_blocking(const CompiledShaft& shaft, const char* how) {
  const auto question = [&](const char* call) {
    return [=] { return fmt::format("{}, {}, {}", call, how, name(active_isa())); };
  };
  std::vector<std::uint64_t> listed(count_);
  listed.resize(list_blocking(shaft, boxes(), listed));
  std::vector<std::uint64_t> blocking(blocking_.size());
  for (const std::uint64_t i : listed) blocking[i / 64] |= bit(i);
  compare(blocking, blocking_, question("list_blocking"));
  std::vector<std::uint64_t> alone(blocking_.size());
  for (std::size_t i = 0; i != count_; ++i) {
    if (blocked(shaft, boxes()[i])) alone[i / 64] |= bit(i);
  }
  compare(alone, blocking_, question("blocked, one box"));
  const bool is_blocked = std::any_of(blocking_.begin(), blocking_.end(), [](std::uint64_t word) { return word != 0; });
  if (blocked(shaft, boxes()) != is_blocked) fail(0, question("blocked, a view")());
  if (blocked(shaft, BoxTree(boxes())) != is_blocked) fail(0, question("blocked, a tree")());
}

template <class View>
void Trial::ask(const CompiledShaft& shaft, const View& view, const char* how) {
  std::vector<std::uint64_t> kept(kept_.size());
  std::vector<std::uint64_t> inside(kept_.size());
  for (const Form form : {Form::slab, Form::planes}) {
    const auto question = [&](const char* call) {
      return [=] {
        return fmt::format("{}, {}, {}, {}", call, how, name(active_isa()), form == Form::slab ? "slab" : "planes");
      };
    };
    cull(shaft, view, kept, form);
    compare(kept, kept_, question("cull"));
    classify(shaft, view, kept, inside, form);
    compare(kept, kept_, question("classify, kept"));
    compare(inside, inside_, question("classify, inside"));
  }
  const auto doublings = static_cast<unsigned>(mixed(number_) >> 32U) % 12;
  // Few undecided bounds in a word take another path than many.
  const bool in_a_row = (mixed(number_) >> 48U & 1U) == 0;
  const GridAnswers on_grid = grid_answers(shaft, view, doublings, in_a_row ? 1 : bounds_on_grid / view.count);
  const auto question = [&](const char* bits) {
    return [=] {
      return fmt::format("classify_many, {}, {}, {}, grid of 2^{}", bits, how, name(active_isa()), doublings);
    };
  };
  compare(on_grid.kept, kept_, question("kept"));
  compare(on_grid.inside, inside_, question("inside"));
  contained(shaft, view, inside);
  compare(inside, inside_, [=] { return fmt::format("contained, {}, {}", how, name(active_isa())); });
}

template <class Bound, class View>
void Trial::ask_tree(const CompiledShaft& shaft, const View& view, const char* how) {
  // Each bound twice, so that there are nodes above the leaves.
  std::vector<Bound> leaves;
  for (std::size_t i = 0; i != 2 * count_; ++i) leaves.push_back(view[i / 2]);
  const BoundsTree<Bound> tree{std::span<const Bound>(leaves)};
  std::vector<std::uint64_t> kept(words_for(leaves.size()));
  std::vector<std::uint64_t> inside(kept.size());
  classify(shaft, tree, kept, inside);
  const auto question = [&](const char* bits) {
    return [=] { return fmt::format("classify of a tree, {}, {}, {}", bits, how, name(active_isa())); };
  };
  compare(every_bit(kept, 2, count_), kept_, question("kept"));
  compare(every_bit(inside, 2, count_), inside_, question("inside"));
}

void Trial::ask_all(const CompiledShaft& shaft, const char* how) {
  if (spheres_) {
    ask(shaft, sphere_view(), how);
    ask_tree<Sphere>(shaft, sphere_view(), how);
    ask_first_contact(shaft, sphere_view(), how);
    return;
  }
  ask(shaft, boxes(), how);
  ask_tree<Box>(shaft, boxes(), how);
  if (std::holds_alternative<ShaftInput>(input_)) ask_blocking(shaft, how);
  ask_triangles(shaft, how);
  ask_first_contact(shaft, boxes(), how);
}

void Trial::ask(std::span<Trial> trials) {
  std::vector<Box> a;
  std::vector<Box> b;
  for (const Trial& trial : trials) {
    const auto* const input = std::get_if<ShaftInput>(&trial.input_);
    a.push_back(input != nullptr ? input->a : Box{});
    b.push_back(input != nullptr ? input->b : Box{});
  }
  const BoxStream from(a);
  const BoxStream to(b);
  std::vector<CompiledShaft> batch(trials.size());
  compile_batch(from.view(), to.view(), batch);
  for (std::size_t i = 0; i != trials.size(); ++i) {
    Trial& trial = trials[i];
    trial.ask_all(trial.shaft_, "alone");
    if (!trial.batched_) continue;
    if (const auto* const between = std::get_if<ShaftInput>(&trial.input_)) {
      set_contact(batch[i], between->contact);
      trial.ask_all(batch[i], "of a batch");
    } else if (const auto* const moving = std::get_if<MovingInput>(&trial.input_)) {
      trial.ask_all(batch_of(*moving), "of a batch");
    }
  }
}

void Trial::fail(std::size_t bound, const std::string& what) {
  if ((wrong_[bound / 64] & bit(bound)) == 0) ++counts_.wrong;
  wrong_[bound / 64] |= bit(bound);
  const std::string input = std::visit([](const auto& of) { return source_text(of); }, input_);
  failures_.push_back(fmt::format("trial {} ({}), bound {} of {}: {}\n  {}\n  {}", number_, subject_name(subject_),
                                  bound, count_, what, input, bound_text(bound)));
}

std::string Trial::bound_text(std::size_t i) const {
  return spheres_ ? source_text(sphere_view()[i]) : source_text(boxes()[i]);
}

}  // namespace shaftcull::cli
