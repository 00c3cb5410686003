// SPDX-License-Identifier: MIT
/// View factors in files.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "factors_result.hpp"
#include "npz.hpp"
#include "output_file.hpp"
#include "shaftcull/error.hpp"
#include "text_lines.hpp"

namespace shaftcull::cli {
namespace {

constexpr std::size_t numbers_at_once = std::size_t{1} << 20;

/// Rows of numbers as another type, some at a time.
template <class To, class From>
void append_as(NpyArray& array, std::span<const From> values) {
  std::vector<To> some;
  for (std::size_t i = 0; i < values.size(); i += numbers_at_once) {
    const std::span<const From> part = values.subspan(i, std::min(numbers_at_once, values.size() - i));
    some.assign(part.begin(), part.end());
    array.append(std::span<const To>(some));
  }
}

void write_npz(const FactorsResult& result, const std::string& path) {
  const ViewFactors& factors = result.factors;
  NpzFile file(path);
  // What scipy.sparse.save_npz() writes.
  constexpr std::array<char, 3> format{'c', 's', 'r'};
  const std::array<std::int64_t, 2> shape{static_cast<std::int64_t>(factors.size()),
                                          static_cast<std::int64_t>(factors.size())};
  file.add({"format", "|S3"}).append(std::span<const char>(format));
  file.add({"shape", "<i8"}).append(std::span<const std::int64_t>(shape));
  append_as<std::int64_t>(file.add({"indptr", "<i8"}), std::span<const std::size_t>(factors.first));
  append_as<std::int32_t>(file.add({"indices", "<i4"}), std::span<const std::uint32_t>(factors.column));
  file.add({"data", "<f8"}).append(std::span<const double>(factors.factor));
  // What else is known of patches.
  file.add({"area", "<f8"}).append(std::span<const double>(factors.area));
  file.add({"row_sum", "<f8"}).append(std::span<const double>(factors.sum));
  const std::vector<double> skies = result.skies();
  file.add({"sky", "<f8"}).append(std::span<const double>(skies));
  file.add({"error", "<f8"}).append(std::span<const double>(factors.error));
  file.add({"left_out", "<f8"}).append(std::span<const double>(factors.left_out));
  add_patches(file, result);
  file.finish();
}

void write_csv(const FactorsResult& result, const std::string& path) {
  const ViewFactors& factors = result.factors;
  OutputFile file(path);
  TextLines lines(file);
  lines.add("from,to,factor\n");
  for (std::size_t i = 0; i != factors.size(); ++i) {
    for (std::size_t k = factors.first[i]; k != factors.first[i + 1]; ++k) {
      lines.add("{},{},{:.9g}\n", i, factors.column[k], factors.factor[k]);
    }
  }
  lines.write();
  file.finish();
}

}  // namespace

void require_factors_name(const std::string& path) {
  if (path.ends_with(".npz") || path.ends_with(".csv") || is_stream(path)) return;
  throw InvalidArgument(fmt::format("--out {}: unknown kind of file; give a name that ends in .npz or .csv", path));
}

void write_factors(const FactorsResult& result, const std::string& path) {
  path.ends_with(".npz") ? write_npz(result, path) : write_csv(result, path);
}

}  // namespace shaftcull::cli
