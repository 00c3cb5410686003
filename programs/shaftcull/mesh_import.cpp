// SPDX-License-Identifier: MIT
#include "mesh_import.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <istream>
#include <iterator>
#include <sstream>
#include <string_view>
#include <system_error>
#include <utility>

#include <assimp/DefaultIOSystem.h>
#include <assimp/MemoryIOWrapper.h>
#include <assimp/commonMetaData.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <assimp/Importer.hpp>

#include "mesh_format.hpp"
#include "mesh_origin.hpp"
#include "shaftcull/error.hpp"

namespace shaftcull::cli {
namespace {

constexpr unsigned steps = aiProcess_Triangulate;

void require_readable(const std::string& path, const std::string& name) {
  std::error_code error;
  const auto status = std::filesystem::status(path, error);
  if (!std::filesystem::exists(status)) {
    throw InvalidArgument(fmt::format("{}: there is no such file; give a mesh file (OBJ, PLY, glTF, …)", name));
  }
  if (std::filesystem::is_directory(status)) {
    throw InvalidArgument(fmt::format("{}: is a directory; give a mesh file (OBJ, PLY, glTF, …)", name));
  }
  if (std::filesystem::is_regular_file(status) && std::filesystem::file_size(path, error) == 0 && !error) {
    throw InvalidArgument(fmt::format("{}: the file is empty; give a mesh file (OBJ, PLY, glTF, …)", name));
  }
}

/// Whether bytes can be read only once, and no name says what they are.
bool is_read_once(const std::string& path) {
  std::error_code error;
  return path == "/dev/stdin" || !std::filesystem::is_regular_file(path, error);
}

std::string bytes_of(const std::string& path, const std::string& name) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (bytes.empty()) throw InvalidArgument(fmt::format("{}: is empty; give a mesh (OBJ, PLY, glTF, …)", name));
  return bytes;
}

[[noreturn]] void refuse_endless_header(const std::string& name) {
  throw InvalidArgument(fmt::format("{}: the file is broken: its PLY header has no end_header line", name));
}

/// assimp's PLY reader looks for the line end_header for ever.
void require_complete_ply_header(std::istream& file, const std::string& name) {
  const auto without_end = [](std::string_view line) { return line.substr(0, line.find_last_not_of(" \t\r") + 1); };
  std::string line;
  std::getline(file, line);
  if (without_end(line) != "ply") return;
  while (std::getline(file, line)) {
    if (without_end(line) == "end_header") return;
  }
  refuse_endless_header(name);
}

/// Why assimp reads no scene from the file. It takes files of unknown formats for such as it knows.
std::string refusal_of(const std::string& path, const Assimp::Importer& importer) {
  const std::string extension = std::filesystem::path(path).extension().string();
  if (extension.empty() || importer.IsExtensionSupported(extension.c_str())) {
    return fmt::format("{}: the file is broken, or does not have the format of its name; assimp reports: {}", path,
                       importer.GetErrorString());
  }
  aiString known;
  importer.GetExtensionList(known);  // "*.3d;*.3ds"
  std::string formats = known.C_Str();
  std::erase(formats, '*');
  std::replace(formats.begin(), formats.end(), ';', ' ');
  return fmt::format(
      "{}: files of this kind cannot be read; convert the file, for example with Blender or MeshLab, to one of {}",
      path, formats);
}

/// The file system, in which one file has other contents.
class OneFileReplaced : public Assimp::DefaultIOSystem {
 public:
  OneFileReplaced(std::string path, std::string bytes) : path_(std::move(path)), bytes_(std::move(bytes)) {}

  Assimp::IOStream* Open(const char* path, const char* mode) override {
    if (path != path_) return DefaultIOSystem::Open(path, mode);
    return new Assimp::MemoryIOStream(reinterpret_cast<const std::uint8_t*>(bytes_.data()), bytes_.size());
  }

 private:
  std::string path_;
  std::string bytes_;
};

/// The ending of the name of a file, in small letters: "obj".
std::string ending_of_name(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& letter : ending) letter = static_cast<char>(std::tolower(static_cast<unsigned char>(letter)));
  return ending.empty() ? ending : ending.substr(1);
}

/// What was subtracted from the coordinates of a file: 0 where floats have all digits of it.
struct Moved {
  WorldPoint by{};
  VertexExtent to{};  ///< where the vertices are then

  [[nodiscard]] bool is_moved() const { return by != WorldPoint{}; }
};

/// Makes coordinates relative to the given origin, or to one that is chosen.
Moved move(std::string& bytes, std::string_view ending, const std::string& name,
           const std::optional<WorldPoint>& origin) {
  const std::optional<VertexPlaces> places = vertex_places(bytes, ending);
  if (!places) return {};
  const std::optional<VertexExtent> extent = extent_of(bytes, *places);
  if (!extent && !places->is_text) return {};
  Moved moved;
  if (origin) moved.by = *origin;
  if (!origin && extent) moved.by = origin_of(*extent).value_or(WorldPoint{});
  if (!moved.is_moved()) return {};
  bytes = relative_to(moved.by, bytes, *places, name);  // throws for text without an extent
  if (extent->lo[0] > extent->hi[0]) return {};         // no vertex at all
  for (std::size_t k = 0; k != 3; ++k) {
    moved.to.lo[k] = extent->lo[k] - moved.by[k];
    moved.to.hi[k] = extent->hi[k] - moved.by[k];
  }
  return moved;
}

/// Throws if assimp has found a vertex elsewhere than where all of them were moved.
void require_moved(const aiScene& scene, const Moved& moved, const std::string& name) {
  double longest = 0;
  for (std::size_t k = 0; k != 3; ++k) longest = std::max(longest, moved.to.hi[k] - moved.to.lo[k]);
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    for (unsigned v = 0; v < scene.mMeshes[m]->mNumVertices; ++v) {
      const aiVector3D& vertex = scene.mMeshes[m]->mVertices[v];
      for (unsigned k = 0; k != 3; ++k) {
        const double x = vertex[k];
        const double room = 1e-3 * longest + 1e-6 * std::abs(x);
        if (!(x < moved.to.lo[k] - room || x > moved.to.hi[k] + room)) continue;
        throw InvalidArgument(fmt::format(
            "{}: assimp finds vertices where there are none, so not all are relative to the origin {}; --origin 0,0,0 "
            "reads the file as it is",
            name, fmt::join(moved.by, ",")));
      }
    }
  }
}

/// Returns what was subtracted.
WorldPoint read_file(Assimp::Importer& importer, const std::string& path, const std::optional<WorldPoint>& origin) {
  std::ifstream header(path, std::ios::binary);
  require_complete_ply_header(header, path);
  Moved moved;
  const std::string ending = ending_of_name(path);
  if (origin != WorldPoint{} && (ending == "obj" || ending == "stl" || ending == "ply")) {
    std::string bytes = bytes_of(path, path);
    moved = move(bytes, ending, path, origin);
    if (moved.is_moved()) importer.SetIOHandler(new OneFileReplaced(path, std::move(bytes)));  // it owns that
  }
  if (importer.ReadFile(path, steps) == nullptr) throw InvalidArgument(refusal_of(path, importer));
  if (moved.is_moved()) require_moved(*importer.GetScene(), moved, path);
  return moved.by;
}

WorldPoint read_stream(Assimp::Importer& importer, const std::string& path, const std::string& name,
                       const std::optional<WorldPoint>& origin) {
  std::string bytes = bytes_of(path, name);
  const std::string ending = ending_of(bytes);
  if (ending.empty()) {
    throw InvalidArgument(
        fmt::format("{}: does not begin like OBJ, PLY, STL, OFF, glTF, FBX, COLLADA or IFC; write it to a file with "
                    "the extension of its format, and give that file",
                    name));
  }
  std::istringstream header(bytes);
  require_complete_ply_header(header, name);
  const Moved moved = origin == WorldPoint{} ? Moved{} : move(bytes, ending, name, origin);
  if (importer.ReadFileFromMemory(bytes.data(), bytes.size(), steps, ending.c_str()) == nullptr) {
    throw InvalidArgument(fmt::format("{}: begins like a file of format {}, but is broken; assimp reports: {}", name,
                                      ending, importer.GetErrorString()));
  }
  if (moved.is_moved()) require_moved(*importer.GetScene(), moved, name);
  return moved.by;
}

/// In IFC files z points up. assimp's reader turns it to y by a matrix of rounded numbers, which tilts all walls by
/// 4·10⁻⁸. The opposite turn comes back to axes exactly.
void keep_axes_of_ifc(const aiScene& scene) {
  aiString format;
  if (scene.mMetaData == nullptr || !scene.mMetaData->Get(AI_METADATA_SOURCE_FORMAT, format)) return;
  if (std::string_view(format.C_Str()).find("IFC") == std::string_view::npos) return;
  aiMatrix4x4 back;
  aiMatrix4x4::RotationX(-AI_MATH_HALF_PI_F, back);
  back.Transpose();
  scene.mRootNode->mTransformation = back * scene.mRootNode->mTransformation;
}

}  // namespace

MeshImport::MeshImport(const std::string& path, const std::optional<WorldPoint>& origin)
    : name_(path == "-" ? "standard input" : path), importer_(std::make_unique<Assimp::Importer>()) {
  const std::string from = path == "-" ? "/dev/stdin" : path;
  require_readable(from, name_);
  if (is_read_once(from)) {
    subtracted_ = read_stream(*importer_, from, name_, origin);
  } else {
    subtracted_ = read_file(*importer_, from, origin);
  }
  scene_ = importer_->GetScene();
  if (scene_->mRootNode == nullptr) throw InvalidArgument(fmt::format("{}: the file contains no scene", name_));
  keep_axes_of_ifc(*scene_);
}
MeshImport::~MeshImport() = default;

}  // namespace shaftcull::cli
