// SPDX-License-Identifier: MIT
#include "mesh_format.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <utility>

namespace shaftcull::cli {
namespace {

/// The first word of a line.
std::string_view word_of(std::string_view line) {
  line.remove_prefix(std::min(line.find_first_not_of(" \t\r"), line.size()));
  return line.substr(0, line.find_first_of(" \t\r"));
}

/// Whether the first line that is neither empty nor a comment is one of an OBJ file.
bool is_obj(std::string_view bytes) {
  constexpr std::array<std::string_view, 10> words{"v", "vn", "vt", "o", "g", "mtllib", "usemtl", "s", "f", "vp"};
  while (!bytes.empty()) {
    const std::size_t end = std::min(bytes.find('\n'), bytes.size());
    const std::string_view word = word_of(bytes.substr(0, end));
    if (!word.empty() && word.front() != '#') return std::find(words.begin(), words.end(), word) != words.end();
    bytes.remove_prefix(std::min(end + 1, bytes.size()));
  }
  return false;
}

}  // namespace

bool is_binary_stl(std::string_view bytes) {
  std::uint32_t triangles = 0;
  if (bytes.size() < 84) return false;
  std::memcpy(&triangles, bytes.data() + 80, sizeof triangles);
  return bytes.size() == 84 + std::size_t{50} * triangles;
}

std::string ending_of(std::string_view bytes) {
  constexpr std::array<std::pair<std::string_view, const char*>, 8> beginnings{{{"glTF", "glb"},
                                                                                {"ply", "ply"},
                                                                                {"solid", "stl"},
                                                                                {"OFF", "off"},
                                                                                {"ISO-10303-21", "ifc"},
                                                                                {"Kaydara FBX", "fbx"},
                                                                                {"; FBX", "fbx"},
                                                                                {"{", "gltf"}}};
  if (is_binary_stl(bytes)) return "stl";
  const std::string_view text = bytes.substr(std::min(bytes.find_first_not_of(" \t\r\n"), bytes.size()));
  for (const auto& [beginning, ending] : beginnings) {
    if (text.starts_with(beginning)) return ending;
  }
  if (text.starts_with('<') && text.substr(0, 4096).find("<COLLADA") != std::string_view::npos) return "dae";
  return is_obj(bytes) ? "obj" : "";
}

}  // namespace shaftcull::cli
