// SPDX-License-Identifier: MIT
#include "name_search.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <vector>

#include <fmt/format.h>

namespace shaftcull::cli {
namespace {

constexpr std::size_t most_names_shown = 9;  // no fewer than there are subcommands

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

/// Levenshtein's distance, blind to case.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t replaced = diagonal + (lower(a[i]) == lower(b[j]) ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
    }
  }
  return row[b.size()];
}

}  // namespace

std::string closest_names(std::string_view wanted, std::span<const std::string> names) {
  std::vector<std::size_t> order(names.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (names.size() > most_names_shown) {
    std::vector<std::size_t> distance(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) distance[i] = edit_distance(wanted, names[i]);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return distance[a] < distance[b]; });
    order.resize(most_names_shown);
  }
  std::string list;
  for (const std::size_t i : order) list += fmt::format("{}'{}'", list.empty() ? "" : ", ", names[i]);
  if (names.size() > order.size()) list += fmt::format(" and {} more", names.size() - order.size());
  return list;
}

}  // namespace shaftcull::cli
