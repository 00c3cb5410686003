/// Leaves written a word at a time, and the nodes right above them while the word is at hand.
#pragma once

#include <algorithm>
#include <cstddef>

#include "run/cut.hpp"
#include "tree/parts.hpp"
#include "tree/source.hpp"
#include "tree/word_writer.hpp"

namespace shaftcull::kernel {

/// Writes leaves [run.first, run.end()), leaf p being bound order[p] of the source, and fits level 1 above them. run is
/// whole words but for the tree's last one.
///
/// Written one leaf at a time, every leaf would write as many cache lines as there are streams, and keep the next one
/// waiting for them.
template <class Bound, class Index, class Source>
void write_leaves(TreeLevels<Bound>& parts, const Index* order, const Run& run, const Source& source) {
  constexpr std::size_t rows = rows_of<Bound>;
  const auto row = parts.leaf_rows();
  const WordWriter writer(parts.leaves.bytes());
  alignas(64) float word[rows][fanout];
  const float* words[rows];
  for (std::size_t s = 0; s != rows; ++s) words[s] = word[s];
  for (std::size_t first = run.first; first < run.end(); first += fanout) {
    const std::size_t count = std::min(fanout, run.end() - first);
    const Index* const which = order + first;
    float* to[rows];
    for (std::size_t s = 0; s != rows; ++s) to[s] = word[s];
    std::size_t i = 0;
    for (; i + 4 <= count; i += 4) {
      if (first + i + fetched_bounds + 4 <= parts.size) {
        for (std::size_t j = 0; j != 4; ++j) source.fetch(which[i + fetched_bounds + j]);
      }
      source.read_four(which + i, to);
      for (float*& at : to) at += 4;
    }
    for (; i != count; ++i) {
      float bound[rows];
      source.read(which[i], bound);
      for (std::size_t s = 0; s != rows; ++s) word[s][i] = bound[s];
    }
    for (std::size_t s = 0; s != rows; ++s)
      std::copy(row[s] + first + count, row[s] + first + fanout, word[s] + count);  // padding
    for (std::size_t s = 0; s != rows; ++s) writer.write(row[s] + first, word[s], fanout);
    if (parts.levels > 1) fit_leaf_word(parts, first / fanout, words);
  }
}

}  // namespace shaftcull::kernel
