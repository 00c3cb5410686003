// SPDX-License-Identifier: MIT
#include "radiation/factor_matrix.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <utility>

#include "parallel/parallel.hpp"
#include "support/fail.hpp"
#include "support/float_environment.hpp"
#include "support/text.hpp"

namespace shaftcull {
namespace kernel {
namespace {

/// Calls body(i) for rows, in parallel.
template <class Body>
void for_each_row(std::size_t count, const Body& body) {
  constexpr std::size_t chunk = 64;
  const auto some = [&](std::size_t part, std::size_t) {
    in_float_environment([&] {
      for (std::size_t i = part * chunk; i != std::min((part + 1) * chunk, count); ++i) body(i);
    });
  };
  parallel_for((count + chunk - 1) / chunk, 1, some);
}

/// A factor in a row.
struct Cell {
  std::uint32_t column;
  float error;  ///< negative if the factor is left out
  double factor;
};

/// Rows of cells that are filled in any order.
class Rows {
 public:
  Rows(ExchangeLists exchanges, std::span<const double> areas, double least) : end_(areas.size() + 1) {
    for (const std::vector<Exchange>& some : exchanges) {
      for (const Exchange& exchange : some) {
        ++end_[exchange.pair.a + 1];
        ++end_[exchange.pair.b + 1];
      }
    }
    for (std::size_t i = 1; i != end_.size(); ++i) end_[i] += end_[i - 1];
    cells_.resize(end_.back());
    // A row's place moves on to its end as it is filled.
    std::vector<std::size_t> next(end_.begin(), end_.end() - 1);
    for (std::vector<Exchange>& some : exchanges) {
      for (const auto& [pair, area, error] : some) {
        const bool is_left_out = area / std::min(areas[pair.a], areas[pair.b]) < least;
        for (const auto& [row, column] : {std::pair{pair.a, pair.b}, std::pair{pair.b, pair.a}}) {
          const double own = areas[row];
          const auto error_of_factor = static_cast<float>(error / own);
          cells_[next[row]++] = {column, is_left_out ? -error_of_factor : error_of_factor, std::min(1.0, area / own)};
        }
      }
      some = {};
    }
  }

  [[nodiscard]] std::span<Cell> row(std::size_t i) noexcept { return {cells_.data() + end_[i], end_[i + 1] - end_[i]}; }

 private:
  std::vector<std::size_t> end_;  ///< row i is cells end_[i] to end_[i + 1]
  std::vector<Cell> cells_;
};

std::span<const double> factors_of(const ViewFactors& factors, std::size_t i) {
  return std::span(factors.factor).subspan(factors.first[i], factors.first[i + 1] - factors.first[i]);
}

std::span<const std::uint32_t> columns_of(const ViewFactors& factors, std::size_t i) {
  return std::span(factors.column).subspan(factors.first[i], factors.first[i + 1] - factors.first[i]);
}

/// Whether arrays have the sizes that view_factors() gives them, numbers are finite and not below 0, and columns ascend
/// in each row.
bool is_matrix(const ViewFactors& factors) {
  if (factors.first.empty()) return false;  // it was moved from
  const std::size_t count = factors.size();
  if (factors.first.front() != 0 || !std::is_sorted(factors.first.begin(), factors.first.end()) ||
      factors.column.size() != factors.first.back() || factors.factor.size() != factors.first.back() ||
      factors.area.size() != count || factors.sum.size() != count || factors.error.size() != count ||
      factors.left_out.size() != count) {
    return false;
  }
  const auto are_numbers = [](const std::vector<double>& values) {
    return std::all_of(values.begin(), values.end(), [](double value) { return value >= 0 && std::isfinite(value); });
  };
  for (const std::vector<double>* of :
       {&factors.factor, &factors.area, &factors.sum, &factors.error, &factors.left_out}) {
    if (!are_numbers(*of)) return false;
  }
  for (std::size_t i = 0; i != count; ++i) {
    const std::span<const std::uint32_t> columns = columns_of(factors, i);
    if (!columns.empty() && columns.back() >= count) return false;
    if (std::adjacent_find(columns.begin(), columns.end(), std::greater_equal<>()) != columns.end()) return false;
  }
  return true;
}

void require_parts_of_one(std::span<const ViewFactors> parts) {
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto refuse = [&](const std::string& what) {
      fail(InvalidArgument("parts[" + std::to_string(p) + "] " + what));
    };
    if (!is_matrix(parts[p]))
      refuse("is not a matrix of view_factors(): arrays do not fit each other, or a number is not finite or below 0");
    if (parts[p].size() != parts[0].size()) {
      refuse("has " + std::to_string(parts[p].size()) + " rows, and parts[0] has " + std::to_string(parts[0].size()) +
             "; all parts are of one set of patches");
    }
    if (parts[p].area != parts[0].area) {
      refuse("has patches with other areas than parts[0]; all parts are of one set of patches");
    }
  }
}

ViewFactors joined(std::span<const ViewFactors> parts) {
  ViewFactors all;
  const std::size_t count = parts[0].size();
  all.area = parts[0].area;
  for (std::vector<double>* of_rows : {&all.sum, &all.error, &all.left_out}) of_rows->assign(count, 0);
  all.first.reserve(count + 1);
  for (std::size_t i = 0; i != count; ++i) {
    std::size_t factors = 0;
    for (const ViewFactors& part : parts) factors += columns_of(part, i).size();
    all.first.push_back(all.first.back() + factors);
  }
  all.column.resize(all.first.back());
  all.factor.resize(all.first.back());
  for (const ViewFactors& part : parts) all.counts += part.counts;
  for_each_row(count, [&](std::size_t i) {
    std::vector<std::pair<std::uint32_t, double>> row;
    row.reserve(columns_of(all, i).size());
    double variance = 0;
    for (const ViewFactors& part : parts) {
      const std::span<const std::uint32_t> columns = columns_of(part, i);
      const std::span<const double> factors = factors_of(part, i);
      for (std::size_t k = 0; k != columns.size(); ++k) row.emplace_back(columns[k], factors[k]);
      all.left_out[i] += part.left_out[i];
      variance += part.error[i] * part.error[i];
    }
    std::sort(row.begin(), row.end());
    std::size_t next = all.first[i];
    for (const auto& [column, factor] : row) {
      all.sum[i] += factor;
      all.column[next] = column;
      all.factor[next++] = factor;
    }
    all.sum[i] += all.left_out[i];
    all.error[i] = std::sqrt(variance);
  });
  for (std::size_t i = 0; i != count; ++i) {
    const std::span<const std::uint32_t> columns = columns_of(all, i);
    const auto twice = std::adjacent_find(columns.begin(), columns.end());
    if (twice == columns.end()) continue;
    fail(InvalidArgument("two parts have the factor from patch " + std::to_string(i) + " to patch " +
                         std::to_string(*twice) + "; each pair is in one part"));
  }
  return all;
}

}  // namespace

void fill_rows(ViewFactors& factors, ExchangeLists exchanges, double least) {
  const std::size_t count = factors.area.size();
  for (std::vector<double>* of_rows : {&factors.sum, &factors.error, &factors.left_out}) of_rows->assign(count, 0);
  Rows rows(std::move(exchanges), factors.area, least);
  std::vector<std::size_t> kept(count);
  for_each_row(count, [&](std::size_t i) {
    const std::span<Cell> row = rows.row(i);
    std::sort(row.begin(), row.end(), [](const Cell& p, const Cell& q) { return p.column < q.column; });
    double variance = 0;
    std::size_t next = 0;
    for (const Cell& cell : row) {
      factors.sum[i] += cell.factor;
      variance += double{cell.error} * cell.error;
      if (cell.factor == 0) continue;  // rays found nothing, as far as they can tell
      if (std::signbit(cell.error)) {
        factors.left_out[i] += cell.factor;
      } else {
        row[next++] = cell;
      }
    }
    factors.error[i] = std::sqrt(variance);
    kept[i] = next;
  });
  factors.first.reserve(count + 1);
  for (const std::size_t n : kept) factors.first.push_back(factors.first.back() + n);
  factors.column.reserve(factors.first.back());
  factors.factor.reserve(factors.first.back());
  for (std::size_t i = 0; i != count; ++i) {
    for (const Cell& cell : rows.row(i).first(kept[i])) {
      factors.column.push_back(cell.column);
      factors.factor.push_back(cell.factor);
    }
  }
}

void close_rows(ViewFactors& factors) {
  constexpr double far = 0.1;
  constexpr double near = 1e-12;
  constexpr int most_steps = 1000;
  const std::size_t count = factors.size();
  std::vector<double> scale(count, 1.0);
  std::vector<double> next(count);
  std::vector<double> sum(count);
  for (int step = 0; step != most_steps; ++step) {
    for_each_row(count, [&](std::size_t i) {
      const std::span<const double> row = factors_of(factors, i);
      const std::span<const std::uint32_t> columns = columns_of(factors, i);
      double of_row = 0;
      for (std::size_t k = 0; k != row.size(); ++k) of_row += row[k] * scale[columns[k]];
      sum[i] = scale[i] * (of_row + factors.left_out[i] * scale[i]);
      next[i] = sum[i] > 0 ? scale[i] / std::sqrt(sum[i]) : scale[i];
    });
    double worst = 0;
    for (std::size_t i = 0; i != count; ++i) {
      const double off = sum[i] > 0 ? std::fabs(sum[i] - 1) : 0;
      if (step == 0 && off > far) {
        fail(InvalidArgument("rows cannot be closed: the factors of patch " + std::to_string(i) + " sum to " +
                             std::to_string(sum[i]) + ", and in an enclosure they sum to about 1"));
      }
      worst = std::max(worst, off);
    }
    if (worst <= near) break;
    scale.swap(next);
  }
  for_each_row(count, [&](std::size_t i) {
    const std::span<const std::uint32_t> columns = columns_of(factors, i);
    double of_row = 0;
    for (std::size_t k = 0; k != columns.size(); ++k) {
      double& factor = factors.factor[factors.first[i] + k];
      factor *= scale[i] * scale[columns[k]];
      of_row += factor;
    }
    factors.left_out[i] *= scale[i] * scale[i];
    factors.sum[i] = of_row + factors.left_out[i];
  });
}

}  // namespace kernel

double ViewFactors::operator()(std::size_t i, std::size_t j) const noexcept {
  const std::span<const std::uint32_t> columns = kernel::columns_of(*this, i);
  const auto found = std::lower_bound(columns.begin(), columns.end(), j);
  if (found == columns.end() || *found != j) return 0;
  return factor[first[i] + static_cast<std::size_t>(found - columns.begin())];
}

ViewFactors join_view_factors(std::span<const ViewFactors> parts, bool close_rows) {
  ViewFactors all;
  kernel::in_float_environment([&] {
    kernel::require_parts_of_one(parts);
    if (parts.size() == 1) all = parts[0];
    if (parts.size() > 1) all = kernel::joined(parts);
    if (close_rows) kernel::close_rows(all);
  });
  return all;
}

}  // namespace shaftcull
