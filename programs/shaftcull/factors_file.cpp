// SPDX-License-Identifier: MIT
/// View factors in files.
#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "factors_result.hpp"
#include "npz.hpp"
#include "patch_picture.hpp"
#include "printable.hpp"
#include "shaftcull/error.hpp"
#include "share_colours.hpp"
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
  file.add({"patch_corners", "<f4", {3}}).append(std::span<const Vec3>(result.patches.corners));
  append_as<std::int64_t>(file.add({"first_corner", "<i8"}), std::span<const std::size_t>(result.patches.first));
  std::vector<std::uint32_t> objects;
  std::vector<std::uint32_t> triangles;
  for (std::size_t i = 0; i != result.patches.size(); ++i) {
    objects.push_back(result.object_of(i));
    triangles.push_back(result.triangle_of(i));
  }
  file.add({"patch_objects", "<u4"}).append(std::span<const std::uint32_t>(objects));
  file.add({"patch_triangles", "<u4"}).append(std::span<const std::uint32_t>(triangles));
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
  throw InvalidArgument(fmt::format("--out {}: what kind of file? Give a name that ends in .npz or .csv", path));
}

void write_factors(const FactorsResult& result, const std::string& path) {
  path.ends_with(".npz") ? write_npz(result, path) : write_csv(result, path);
}

void write_sky_svg(const FactorsResult& result, const std::string& path, std::size_t up) {
  PictureFaces faces;
  faces.objects = result.scene.mesh.boxes;
  faces.first = result.patches.first;
  for (const Vec3& corner : result.patches.corners) faces.corners.push_back(in_doubles(corner));
  const std::vector<double> skies = result.skies();
  const ShareMap map{skies, ramp_of_seen, "sky", "of the radiation meets no patch"};
  OutputFile file(path);
  file.write(picture_of(faces, {&map, 1}, up, "Sky view factors"));
  file.finish();
}

void write_sky_ply(const FactorsResult& result, const std::string& path) {
  OutputFile file(path);
  TextLines lines(file);
  lines.add("ply\nformat ascii 1.0\n");
  for (std::size_t i = 0; i != result.scene.mesh.names.size(); ++i) {
    lines.add("comment object {} {}\n", i, printable(result.scene.mesh.names[i]));
  }
  // Many programs show colours of vertices only.
  lines.add(
      "element vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar red\nproperty uchar green\nproperty uchar blue\n"
      "element face {}\nproperty list uchar int vertex_indices\nproperty uint object\nproperty float sky\nend_header\n",
      result.patches.corners.size(), result.patches.size());
  for (std::size_t i = 0; i != result.patches.size(); ++i) {
    const auto [red, green, blue] = colour_at(ramp_of_seen, result.sky(i));
    for (const Vec3& corner : result.patches.of(i)) {
      lines.add("{} {} {} {} {} {}\n", corner[0], corner[1], corner[2], red, green, blue);
    }
  }
  for (std::size_t i = 0; i != result.patches.size(); ++i) {
    const std::size_t count = result.patches.of(i).size();
    lines.add("{}", count);
    for (std::size_t c = 0; c != count; ++c) lines.add(" {}", result.patches.first[i] + c);
    lines.add(" {} {:.6g}\n", result.object_of(i), result.sky(i));
  }
  lines.write();
  file.finish();
}

}  // namespace shaftcull::cli
