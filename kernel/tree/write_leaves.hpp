/// Leaves written a word at a time, and the nodes right above them while the word is at hand.
#pragma once

#include <algorithm>
#include <cstddef>

#include "run/cut.hpp"
#include "tree/parts.hpp"
#include "tree/word_writer.hpp"

namespace shaftcull::kernel {

/// Writes leaves [run.first, run.end()) and fits level 1 above them; read(p, bound) gets leaf p. run is whole words but
/// for the tree's last one.
///
/// Written one leaf at a time, every leaf would write as many cache lines as there are streams, and keep the next one
/// waiting for them.
template <class Bound, class Read>
void write_leaves(TreeLevels<Bound>& parts, const Run& run, const Read& read) {
  const auto row = parts.leaf_rows();
  const WordWriter writer(parts.leaves.bytes());
  alignas(64) float word[rows_of<Bound>][fanout];
  const float* words[rows_of<Bound>];
  for (std::size_t s = 0; s != row.size(); ++s) words[s] = word[s];
  for (std::size_t first = run.first; first < run.end(); first += fanout) {
    const std::size_t count = std::min(fanout, run.end() - first);
    for (std::size_t i = 0; i != count; ++i) {
      float bound[rows_of<Bound>];
      read(first + i, bound);
      for (std::size_t s = 0; s != row.size(); ++s) word[s][i] = bound[s];
    }
    for (std::size_t s = 0; s != row.size(); ++s)
      std::copy(row[s] + first + count, row[s] + first + fanout, word[s] + count);  // padding
    for (std::size_t s = 0; s != row.size(); ++s) writer.write(row[s] + first, word[s], fanout);
    if (parts.levels > 1) fit_leaf_word(parts, first / fanout, words);
  }
}

}  // namespace shaftcull::kernel
