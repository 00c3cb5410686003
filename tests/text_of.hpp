// SPDX-License-Identifier: MIT
/// Files that tests read.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

namespace shaftcull {

/// What a file holds; empty if it cannot be read. By C's functions, for not every standard library has streams of
/// files.
inline std::string text_of(const std::string& path) {
  std::string text;
  std::FILE* const file = std::fopen(path.c_str(), "rb");
  if (file == nullptr) return text;
  char part[4096];
  for (std::size_t size = 0; (size = std::fread(part, 1, sizeof part, file)) != 0;) text.append(part, size);
  std::fclose(file);
  return text;
}

}  // namespace shaftcull
