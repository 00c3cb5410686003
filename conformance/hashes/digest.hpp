// SPDX-License-Identifier: MIT
/// Answers as one number.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "hashes/hashes.hpp"
#include "oracle/grid_answers.hpp"
#include "shaftcull/bounds.hpp"
#include "shaftcull/compiled.hpp"
#include "shaftcull/cull.hpp"

namespace shaftcull::hashes {

/// FNV-1a, word by word.
class Digest {
 public:
  void add(std::uint64_t word) noexcept { value_ = (value_ ^ word) * 0x100000001b3U; }
  template <class Word>
  void add_all(std::span<const Word> words) noexcept {
    for (const Word word : words) add(word);
  }
  void add_all(const std::vector<std::uint64_t>& words) noexcept { add_all(std::span(words)); }
  /// A zero with either sign is one zero: which of them arises is not promised.
  void add_float(float number) noexcept { add(std::uint64_t{number == 0 ? 0U : std::bit_cast<std::uint32_t>(number)}); }
  void add_box(const Box& box) noexcept {
    for (const Vec3& corner : {box.lo, box.hi}) {
      for (const float x : corner) add_float(x);
    }
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325U;
};

/// Adds which bounds a shaft keeps and which are inside, asked in one of the ways.
template <class View>
void add_answers(const CompiledShaft& shaft, const View& view, Way way, Digest& digest) {
  if (way == Way::many) {
    const GridAnswers among_many = grid_answers(shaft, view, 3);
    digest.add_all(among_many.kept);  // twice, as cull() and classify() below tell it
    digest.add_all(among_many.kept);
    digest.add_all(among_many.inside);
    return;
  }
  CompiledShaft in_form = shaft;
  if (way != Way::slab) set_form(in_form, Form::planes);
  std::vector<std::uint64_t> kept(bit_words(view.count));
  std::vector<std::uint64_t> inside(kept.size());
  cull(in_form, view, kept);
  digest.add_all(kept);
  classify(in_form, view, kept, inside);
  digest.add_all(kept);
  digest.add_all(inside);
}

}  // namespace shaftcull::hashes
