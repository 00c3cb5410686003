// SPDX-License-Identifier: MIT
#include "query/options.hpp"

#include <algorithm>
#include <string>

#include "compiled/answers.hpp"
#include "shaftcull/error.hpp"
#include "support/arguments.hpp"
#include "support/fail.hpp"
#include "support/text.hpp"

namespace shaftcull::kernel {
namespace {

[[noreturn]] void refuse_option(const char* option, const std::string& why) {
  kernel::fail(InvalidArgument(std::string("query.") + option + why));
}

}  // namespace

void require_answers_of(std::span<const ShaftData> shafts, Question question, BoundKind kind, TriangleTest test) {
  require_memory("shafts", shafts, "shafts");
  for (std::size_t s = 0; s != shafts.size(); ++s) {
    if (question == Question::blocking) {
      require_two_ends(shafts[s], s);
      continue;
    }
    require_answers(shafts[s], question != Question::inside, question != Question::kept, kind == BoundKind::spheres, s);
    if (kind == BoundKind::triangles && test == TriangleTest::exact) require_no_hull_for_exact_test(shafts[s], s);
  }
}

Options::Options(const Query& query, const char* call, const Takes& takes, std::size_t shafts, std::size_t bounds,
                 BoundKind kind, bool have_layers)
    : call_(call),
      exclude_(query.exclude.span()),
      exclude_each_(query.exclude_each),
      each_(shafts == 0 ? 0 : query.exclude_each.size() / shafts),
      mask_(query.exclude_mask),
      layer_mask_(query.layer_mask.span()),
      limit_(query.limit),
      only_(query.only),
      triangle_test_(query.triangle_test) {
  require_triangle_test("query.triangle_test", triangle_test_);
  if (triangle_test_ != TriangleTest::exact && kind != BoundKind::triangles) {
    refuse_option("triangle_test", std::string(" of ") + call + " asks for vertices; bounds are " + noun_of(kind) +
                                       ", and only triangles have them");
  }
  if (has_limit() && !takes.limit) {
    refuse_option("limit", std::string(" means nothing to ") + call + "(); count and list kept bounds with it");
  }
  if (only_ && !takes.only) {
    refuse_option("only", std::string(" means nothing to ") + call + "(); make a view of the bounds that it names");
  }
  require_below("query.exclude", exclude_, bounds);
  if (each_ * shafts != exclude_each_.size()) {
    refuse_option("exclude_each", " has " + counted_indices(exclude_each_.size()) +
                                      ", which is not a multiple of the " + counted(shafts, "shaft") +
                                      "; each needs as many");
  }
  require_below("query.exclude_each", exclude_each_, bounds);
  require_memory("query.exclude_mask", mask_, "words");
  if (!mask_.empty() && mask_.size() != words_for(bounds)) {
    refuse_option("exclude_mask", " has " + counted(mask_.size(), "word") + "; the bits of " +
                                      counted(bounds, "bound") + " take " + std::to_string(words_for(bounds)));
  }
  if (only_) require_below("query.only", *only_, bounds);
  require_memory("query.layer_mask", layer_mask_, "sets of layers");
  if (layer_mask_.empty()) return;
  if (layer_mask_.size() != 1 && layer_mask_.size() != shafts) {
    refuse_option("layer_mask", " has " + counted(layer_mask_.size(), "set") + " of layers for " +
                                    counted(shafts, "shaft") + "; give one for each, or one for all");
  }
  if (!have_layers && bounds != 0) {
    refuse_option(
        "layer_mask",
        " asks for layers, and the bounds have none; call set_layers() of the tree, or name them with the view");
  }
}

void Options::require_apart(const char* name, std::span<const std::byte> output, bool may_begin_at_only) const {
  kernel::require_apart(call_, name, output, "query.exclude", bytes_of(exclude_));
  kernel::require_apart(call_, name, output, "query.exclude_each", bytes_of(exclude_each_));
  kernel::require_apart(call_, name, output, "query.exclude_mask", bytes_of(mask_));
  kernel::require_apart(call_, name, output, "query.layer_mask", bytes_of(layer_mask_));
  if (!only_) return;
  const auto candidates = bytes_of(*only_);
  if (may_begin_at_only && output.data() == candidates.data()) return;
  kernel::require_apart(call_, name, output, "query.only", candidates);
}

}  // namespace shaftcull::kernel
