// SPDX-License-Identifier: MIT
#include "query/options.hpp"

#include <algorithm>
#include <string>

#include "compiled/answers.hpp"
#include "shaftcull/error.hpp"
#include "support/arguments.hpp"
#include "support/exact_floats.hpp"
#include "support/fail.hpp"
#include "support/text.hpp"

namespace shaftcull::kernel {
namespace {

[[noreturn]] void refuse_option(const char* option, const std::string& why) {
  kernel::fail(InvalidArgument(std::string("query.") + option + why));
}

}  // namespace

void require_answers_of(std::span<const ShaftData> shafts, Question question) {
  require_memory("shafts", shafts, "shafts");
  for (std::size_t s = 0; s != shafts.size(); ++s) {
    if (question == Question::blocking) {
      require_two_ends(shafts[s], s);
      continue;
    }
    require_formed(shafts[s], s);
  }
}

void Options::check(const Takes& takes, std::size_t shafts, std::size_t bounds, BoundKind kind, bool have_layers) {
  const std::span<const std::uint32_t> exclude_each = query_.exclude_each;
  const std::span<const std::uint64_t> mask = query_.exclude_mask;
  const std::span<const std::uint32_t> layer_mask = query_.layer_mask.span();
  each_ = shafts == 0 ? 0 : exclude_each.size() / shafts;
  require_triangle_test("query.triangle_test", query_.triangle_test);
  if (query_.triangle_test != TriangleTest::exact && kind != BoundKind::triangles) {
    refuse_option("triangle_test", std::string(" of ") + call_ + " asks for vertices; bounds are " + noun_of(kind) +
                                       ", and only triangles have them");
  }
  if (has_limit() && !takes.limit) {
    refuse_option("limit", std::string(" means nothing to ") + call_ + "(); count and list kept bounds with it");
  }
  if (query_.only && !takes.only) {
    refuse_option("only", std::string(" means nothing to ") + call_ + "(); make a view of the bounds that it names");
  }
  if (query_.skip_overlapping && !takes.skip_overlapping) {
    refuse_option("skip_overlapping", std::string(" means nothing to ") + call_ + "(); ask for first contact with it");
  }
  require_below("query.exclude", query_.exclude.span(), bounds);
  if (each_ * shafts != exclude_each.size()) {
    refuse_option("exclude_each", " has " + counted_indices(exclude_each.size()) + ", which is not a multiple of the " +
                                      counted(shafts, "shaft") + "; each needs as many");
  }
  require_below("query.exclude_each", exclude_each, bounds);
  require_memory("query.exclude_mask", mask, "words");
  if (!mask.empty() && mask.size() != bit_words(bounds)) {
    refuse_option("exclude_mask", " has " + counted(mask.size(), "word") + "; the bits of " + counted(bounds, "bound") +
                                      " take " + std::to_string(bit_words(bounds)));
  }
  if (query_.only) require_below("query.only", *query_.only, bounds);
  require_memory("query.layer_mask", layer_mask, "sets of layers");
  if (layer_mask.empty()) return;
  if (layer_mask.size() != 1 && layer_mask.size() != shafts) {
    refuse_option("layer_mask", " has " + counted(layer_mask.size(), "set") + " of layers for " +
                                    counted(shafts, "shaft") + "; give one for each, or one for all");
  }
  if (!have_layers && bounds != 0) {
    refuse_option(
        "layer_mask",
        " asks for layers, and the bounds have none; call set_layers() of the tree, or name them with the view");
  }
}

void Options::check_apart(const char* name, std::span<const std::byte> output, bool may_begin_at_only) const {
  kernel::require_apart(call_, name, output, "query.exclude", bytes_of(query_.exclude.span()));
  kernel::require_apart(call_, name, output, "query.exclude_each", bytes_of(query_.exclude_each));
  kernel::require_apart(call_, name, output, "query.exclude_mask", bytes_of(query_.exclude_mask));
  kernel::require_apart(call_, name, output, "query.layer_mask", bytes_of(query_.layer_mask.span()));
  if (!query_.only) return;
  const auto candidates = bytes_of(*query_.only);
  if (may_begin_at_only && output.data() == candidates.data()) return;
  kernel::require_apart(call_, name, output, "query.only", candidates);
}

}  // namespace shaftcull::kernel
