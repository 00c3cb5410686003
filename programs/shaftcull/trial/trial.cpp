// SPDX-License-Identifier: MIT
#include "trial/trial.hpp"

#include <limits>

#include <fmt/format.h>

#include "bits.hpp"
#include "shaftcull/streams.hpp"
#include "shaftcull/volumes.hpp"
#include "trial/seed.hpp"

namespace shaftcull::cli {
namespace {

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
    case MovingKind::swept_infinite:
      swept_infinite_batch(boxes.view(), displacements, out, input.added);
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

/// Of the trials, one in this many is about moving boxes and convex hulls: rationals work out all of their answers.
constexpr std::uint64_t other_trials = 6;

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
      kept_(bit_words(bounds)),
      inside_(bit_words(bounds)),
      blocking_(bit_words(bounds)),
      wrong_(bit_words(bounds)) {
  Random random(mixed(seed) ^ number);
  // Streams of any alignment, with NaN around them: a kernel that reads past its view shows it.
  const std::size_t streams = spheres_ ? 4 : 6;
  memory_.assign(streams * (count_ + 16), std::numeric_limits<float>::quiet_NaN());
  for (std::size_t s = 0; s != streams; ++s) start_[s] = s * (count_ + 16) + random.below(16);
  if (subject_ < std::size(families)) {
    make_between_boxes(random, families[subject_], Turn(number).round);
  } else if (subject_ < std::size(families) + std::size(moving_kinds)) {
    make_moving(random, moving_kinds[subject_ - std::size(families)]);
  } else if (subject_ + 1 != subjects) {
    make_hull(random);
  } else {
    make_hull_between_ends(random);
  }
  counts_.bounds = count_;
  counts_.outside = count_ - BitView(kept_).count();
  counts_.inside = BitView(inside_).count();
  counts_.blocking = BitView(blocking_).count();
  count_undecided();
}

const char* Trial::subject_name(std::size_t subject) noexcept {
  constexpr const char* kind_names[] = {"swept", "swept without end", "shadow", "shadow without end"};
  static_assert(std::size(kind_names) == std::size(moving_kinds));
  if (subject < std::size(families)) return families[subject].name;
  subject -= std::size(families);
  if (subject < std::size(kind_names)) return kind_names[subject];
  subject -= std::size(moving_kinds);
  return subject == 0 ? "convex hulls" : "polygon shafts";
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
  if (right != Answer::outside) kept_[i / 64] |= bit_of(i);
  if (right == Answer::inside) inside_[i / 64] |= bit_of(i);
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

void Trial::compare(const std::vector<std::uint64_t>& got, const std::vector<std::uint64_t>& right,
                    FunctionRef<std::string()> what) {
  for (std::size_t w = 0; w != got.size(); ++w) {
    const std::uint64_t differ = (got[w] ^ right[w]) & ~wrong_[w];
    for (const std::size_t bit : BitView({&differ, 1})) {
      const std::size_t i = w * 64 + bit;
      if (i < count_) {
        fail(i, fmt::format("{}: bit {} instead of {}", what(), BitView(got)[i] ? 1 : 0, BitView(right)[i] ? 1 : 0));
      } else {
        fail(count_ - 1, fmt::format("{}: bit {} past the last bound is set", what(), i));
      }
    }
  }
}

void Trial::ask_all(const CompiledShaft& shaft, const char* how) {
  ask_classes(shaft, how);
  ask_blocking(shaft, how);
  ask_triangles(shaft, how);
  ask_first_contact(shaft, how);
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
  if (!BitView(wrong_)[bound]) ++counts_.wrong;
  wrong_[bound / 64] |= bit_of(bound);
  const std::string input = std::visit([](const auto& of) { return source_text(of); }, input_);
  failures_.push_back(fmt::format("trial {} ({}), bound {} of {}: {}\n  {}\n  {}", number_, subject_name(subject_),
                                  bound, count_, what, input, bound_text(bound)));
}

std::string Trial::bound_text(std::size_t i) const {
  return spheres_ ? source_text(sphere_view()[i]) : source_text(boxes()[i]);
}

}  // namespace shaftcull::cli
