// SPDX-License-Identifier: MIT
/// What trials ask of all bounds: which are outside, and which are inside.
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include <fmt/format.h>

#include "oracle/grid_answers.hpp"
#include "shaftcull/cull.hpp"
#include "shaftcull/isa.hpp"
#include "shaftcull/tree.hpp"
#include "trial/seed.hpp"
#include "trial/trial.hpp"
#include "undecided.hpp"

namespace shaftcull::cli {
void Trial::ask_classes(const CompiledShaft& shaft, const char* how) {
  with_view([&](const auto& view) {
    ask_view(shaft, view, how);
    ask_tree(shaft, view, how);
  });
}

template <class View>
void Trial::ask_view(const CompiledShaft& shaft, const View& view, const char* how) {
  std::vector<std::uint64_t> kept(kept_.size());
  std::vector<std::uint64_t> inside(kept_.size());
  for (const Form form : {Form::slab, Form::planes}) {
    CompiledShaft in_form = shaft;
    set_form(in_form, form);
    const auto question = [&](const char* call) {
      return [=] {
        return fmt::format("{}, {}, {}, {}", call, how, name(active_isa()), form == Form::slab ? "slab" : "planes");
      };
    };
    cull(in_form, view, kept);
    compare(kept, kept_, question("cull"));
    classify(in_form, view, kept, inside);
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
  classify(shaft, view, {}, inside);
  compare(inside, inside_, [=] { return fmt::format("classify, inside alone, {}, {}", how, name(active_isa())); });
}

template <class View>
void Trial::ask_tree(const CompiledShaft& shaft, const View& view, const char* how) {
  using Bound = std::conditional_t<std::is_same_v<View, BoxView>, Box, Sphere>;
  // Each bound twice, so that there are nodes above the leaves.
  std::vector<Bound> leaves;
  for (std::size_t i = 0; i != 2 * count_; ++i) leaves.push_back(view[i / 2]);
  const BoundsTree<Bound> tree{std::span<const Bound>(leaves)};
  std::vector<std::uint64_t> kept(bit_words(leaves.size()));
  std::vector<std::uint64_t> inside(kept.size());
  classify(shaft, tree, kept, inside);
  const auto question = [&](const char* bits) {
    return [=] { return fmt::format("classify of a tree, {}, {}, {}", bits, how, name(active_isa())); };
  };
  compare(every_bit(kept, 2, count_), kept_, question("kept"));
  compare(every_bit(inside, 2, count_), inside_, question("inside"));
}

void Trial::count_undecided() {
  std::vector<std::uint64_t> asked(kept_.size());
  std::vector<std::uint64_t> kept(kept_.size());
  std::vector<std::uint64_t> inside(kept_.size());
  CompiledShaft in_form = shaft_;
  complete(in_form);
  for (const Form form : {Form::slab, Form::planes}) {
    set_form(in_form, form);
    with_view([&](const auto& view) { undecided(in_form, view, asked, kept, inside); });
    (form == Form::slab ? counts_.undecided_slab : counts_.undecided_planes) = BitView(asked).count();
  }
}

}  // namespace shaftcull::cli
