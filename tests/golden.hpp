// SPDX-License-Identifier: MIT
/// Reads the reference answers in tests/golden/, which the paper's original C code gave (see the README there).
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "shaftcull/bounds.hpp"
#include "support/fail.hpp"
#include "text_of.hpp"

namespace shaftcull::golden {

/// A row of shafts.csv. The row with index i describes shaft i.
struct ShaftRow {
  std::size_t shaft;
  Box a;
  Box b;
  std::size_t plane_count;  ///< joining planes
};

/// A row of planes.csv: a joining plane of a shaft, with unit normal; the order within a shaft means nothing.
struct PlaneRow {
  std::size_t shaft;
  Plane plane;
};

/// A row of boxes.csv: what the shaft answers for a box. At most one of the answers is true.
struct BoxRow {
  std::size_t shaft;
  Box box;
  bool outside;
  bool inside;
};

/// A row of spheres.csv. `outside` is conservative: true is always right, false may be outside after all.
struct SphereRow {
  std::size_t shaft;
  Sphere sphere;
  bool outside;
  bool inside;
};

/// The rows of a CSV file of numbers without its heading; throws std::runtime_error, naming file and line, if the
/// file is missing, or a row is not `columns` numbers.
inline std::vector<std::vector<double>> read_numbers(const std::string& file_name, std::size_t columns) {
  const std::string path = std::string(SHAFTCULL_GOLDEN_DIR) + "/" + file_name;
  const std::string text = text_of(path);
  if (text.empty()) kernel::fail(std::runtime_error("cannot read the reference data " + path));
  std::vector<std::vector<double>> rows;
  std::size_t begin = std::min(text.find('\n'), text.size() - 1) + 1;  // behind the heading
  for (std::size_t end = 0; begin < text.size(); begin = end + 1) {
    end = std::min(text.find('\n', begin), text.size());
    std::vector<double>& row = rows.emplace_back();
    const char* at = text.c_str() + begin;
    // Numbers begin so: strtod() takes white space, too, and with it the next line.
    while (row.size() != columns && *at != '\0' && std::strchr("-0123456789", *at) != nullptr) {
      char* behind = nullptr;
      row.push_back(std::strtod(at, &behind));
      at = behind;
      if (row.size() == columns || *at != ',') break;
      ++at;
    }
    if (row.size() != columns || (*at != '\0' && *at != '\r' && *at != '\n')) {
      kernel::fail(std::runtime_error(path + ":" + std::to_string(rows.size() + 1) + ": not " +
                                      std::to_string(columns) + " numbers"));
    }
  }
  if (rows.empty()) kernel::fail(std::runtime_error(path + " has no rows"));
  return rows;
}

/// The three numbers from row[first] on. They were printed with 9 digits, which names one float exactly.
inline Vec3 vec3_at(const std::vector<double>& row, std::size_t first) {
  return {static_cast<float>(row[first]), static_cast<float>(row[first + 1]), static_cast<float>(row[first + 2])};
}

inline Box box_at(const std::vector<double>& row, std::size_t first) {
  return {vec3_at(row, first), vec3_at(row, first + 3)};
}

inline std::vector<ShaftRow> load_shafts() {
  std::vector<ShaftRow> shafts;
  for (const std::vector<double>& row : read_numbers("shafts.csv", 14)) {
    shafts.push_back(
        {static_cast<std::size_t>(row[0]), box_at(row, 1), box_at(row, 7), static_cast<std::size_t>(row[13])});
    if (shafts.back().shaft + 1 != shafts.size()) {
      kernel::fail(std::runtime_error("shafts.csv: rows are not numbered in order"));
    }
  }
  return shafts;
}

inline std::vector<PlaneRow> load_planes() {
  std::vector<PlaneRow> planes;
  for (const std::vector<double>& row : read_numbers("planes.csv", 5)) {
    planes.push_back({static_cast<std::size_t>(row[0]), {vec3_at(row, 1), static_cast<float>(row[4])}});
  }
  return planes;
}

inline std::vector<BoxRow> load_boxes() {
  std::vector<BoxRow> boxes;
  for (const std::vector<double>& row : read_numbers("boxes.csv", 9)) {
    boxes.push_back({static_cast<std::size_t>(row[0]), box_at(row, 1), row[7] != 0.0, row[8] != 0.0});
  }
  return boxes;
}

inline std::vector<SphereRow> load_spheres() {
  std::vector<SphereRow> spheres;
  for (const std::vector<double>& row : read_numbers("spheres.csv", 7)) {
    spheres.push_back({static_cast<std::size_t>(row[0]),
                       {vec3_at(row, 1), static_cast<float>(row[4])},
                       row[5] != 0.0,
                       row[6] != 0.0});
  }
  return spheres;
}

}  // namespace shaftcull::golden
