#include "trial.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>

#include <fmt/format.h>

#include "oracle/blocking.hpp"
#include "oracle/cases/families.hpp"
#include "oracle/cases/triangles.hpp"
#include "oracle/entry_time.hpp"
#include "oracle/grid_answers.hpp"
#include "oracle/hull.hpp"
#include "oracle/open_contact.hpp"
#include "oracle/quick_hull.hpp"
#include "oracle/random.hpp"
#include "oracle/triangle.hpp"
#include "shaftcull/blocked.hpp"
#include "shaftcull/cull.hpp"
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
constexpr unsigned triangle_trials = 16;

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
      family_(static_cast<std::size_t>(number % std::size(families))),
      count_(bounds),
      spheres_(number / std::size(families) % 2 != 0),
      kept_(words_for(bounds)),
      inside_(words_for(bounds)),
      blocking_(words_for(bounds)),
      wrong_(words_for(bounds)) {
  Random random(mixed(seed) ^ number);
  const Family& family = families[family_];
  input_ = family.shaft(random, static_cast<unsigned>(number / std::size(families) / 2));
  if ((mixed(number) >> 40U) % open_trials == 0) input_.contact = Contact::open;
  shaft_ = compile(formed(random, input_));
  batched_ = input_.added.empty() && random.one_in(2);

  // Streams of any alignment, with NaN around them: a kernel that reads past its view shows it.
  const std::size_t streams = spheres_ ? 4 : 6;
  memory_.assign(streams * (count_ + 16), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t s = 0; s != streams; ++s) start_[s] = s * (count_ + 16) + random.below(16);

  const oracle::QuickHull quick(input_);
  std::optional<oracle::Hull> exact;
  std::optional<oracle::OpenHull> open;
  if (input_.contact == Contact::open) open.emplace(input_);
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
      if (!exact) exact.emplace(input_.a, input_.b, input_.added);
      right = exact->answer(bound);
      ++counts_.by_rationals;
      if (!proved && right != Answer::outside && exact->touches(bound)) ++counts_.touching;
      if (proved && *proved != right)
        fail(i, fmt::format("oracles disagree: rationals {}, intervals {}", text(right), text(*proved)));
    }
    if (right != Answer::outside) kept_[i / 64] |= bit(i);
    if (right == Answer::inside) inside_[i / 64] |= bit(i);
  };
  for (std::size_t i = 0; i != count_; ++i) {
    if (spheres_) {
      const Sphere sphere = family.sphere(random, input_, quick);
      for (std::size_t k = 0; k != 3; ++k) memory_[start_[k] + i] = sphere.centre[k];
      memory_[start_[3] + i] = sphere.radius;
      answer_by_oracle(i, sphere);
    } else {
      const Box box = random.one_in(8) ? blocking_box(random, input_) : family.box(random, input_);
      for (std::size_t k = 0; k != 3; ++k) {
        memory_[start_[k] + i] = box.lo[k];
        memory_[start_[k + 3] + i] = box.hi[k];
      }
      answer_by_oracle(i, box);
      // What blocks meets the shaft between the boxes; whether a plane that was added is in the way does not matter.
      const bool is_outside = input_.added.empty() && (kept_[i / 64] & bit(i)) == 0;
      if (!is_outside && oracle::blocks(input_.a, input_.b, box)) blocking_[i / 64] |= bit(i);
    }
  }
  if (!spheres_ && random.one_in(contact_trials)) find_first_contact();
  if (!spheres_ && random.one_in(triangle_trials)) find_triangles(random);
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

void Trial::find_triangles(Random& random) {
  for (std::vector<std::uint64_t>& kept : kept_triangles_) kept.resize(words_for(count_));
  for (std::size_t i = 0; i != count_; ++i) {
    triangles_.push_back(random.one_in(2) ? nearby_triangle(random, input_) : touching_triangle(random, input_));
    for (const TriangleTest test : {TriangleTest::vertices, TriangleTest::exact}) {
      if (oracle::is_outside(input_, triangles_[i], test)) continue;
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

void Trial::find_first_contact() {
  FirstContactOf<std::uint64_t> first;
  std::optional<mpq_class> least;
  for (std::size_t i = 0; i != count_; ++i) {
    if ((kept_[i / 64] & bit(i)) == 0) continue;
    const std::optional<mpq_class> time = oracle::entry_time(input_.a, input_.b, boxes()[i]);
    if (!time) {
      fail(i, "oracles disagree: a box that is kept is never reached");
      continue;
    }
    if (least && *least <= *time) continue;
    least = time;
    first = {i, oracle::rounded_down(*time)};
  }
  first_ = first;
}

void Trial::ask_first_contact(const CompiledShaft& shaft, const char* how) {
  if (!first_ || count_ == 0) return;
  const auto compare_contact = [&](const FirstContactOf<std::uint64_t>& got, const char* of) {
    if (got == *first_) return;
    fail(got ? got.index : first_->index,
         fmt::format("first_contact of a {}, {}, {}: bound {} at {} instead of {} at {}", of, how, name(active_isa()),
                     got.index, got.time, first_->index, first_->time));
  };
  compare_contact(first_contact(shaft, boxes(), Form::slab), "view, slab");
  compare_contact(first_contact(shaft, boxes(), Form::planes), "view, planes");
  compare_contact(first_contact(shaft, BoundsTree<Box, std::uint64_t>(boxes())), "tree");
}

template <class View>
void Trial::count_undecided(const View& view) {
  std::vector<std::uint64_t> asked(kept_.size());
  std::vector<std::uint64_t> kept(kept_.size());
  std::vector<std::uint64_t> inside(kept_.size());
  for (const Form form : {Form::slab, Form::planes}) {
    undecided(shaft_, view, form, asked, kept, inside);
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

void Trial::ask(std::span<Trial> trials) {
  std::vector<Box> a;
  std::vector<Box> b;
  for (const Trial& trial : trials) {
    a.push_back(trial.input_.a);
    b.push_back(trial.input_.b);
  }
  const BoxStream from(a);
  const BoxStream to(b);
  std::vector<CompiledShaft> batch(trials.size());
  compile_batch(from.view(), to.view(), batch);
  for (std::size_t i = 0; i != trials.size(); ++i) set_contact(batch[i], trials[i].input_.contact);
  for (std::size_t i = 0; i != trials.size(); ++i) {
    Trial& trial = trials[i];
    const auto ask_of = [&](const CompiledShaft& shaft, const char* how) {
      if (trial.spheres_) {
        trial.ask(shaft, trial.sphere_view(), how);
      } else {
        trial.ask(shaft, trial.boxes(), how);
        trial.ask_blocking(shaft, how);
        trial.ask_triangles(shaft, how);
        trial.ask_first_contact(shaft, how);
      }
    };
    ask_of(trial.shaft_, "compile");
    if (trial.batched_) ask_of(batch[i], "compile_batch");
  }
}

void Trial::fail(std::size_t bound, const std::string& what) {
  if ((wrong_[bound / 64] & bit(bound)) == 0) ++counts_.wrong;
  wrong_[bound / 64] |= bit(bound);
  failures_.push_back(fmt::format("trial {} ({}), bound {} of {}: {}\n  {}\n  {}", number_, families[family_].name,
                                  bound, count_, what, source_text(input_), bound_text(bound)));
}

std::string Trial::bound_text(std::size_t i) const {
  return spheres_ ? source_text(sphere_view()[i]) : source_text(boxes()[i]);
}

}  // namespace shaftcull::cli
