// SPDX-License-Identifier: MIT
#include "mesh_import.hpp"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
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

/// assimp's PLY reader looks for this line for ever.
void require_complete_ply_header(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string line;
  std::getline(file, line);
  if (line != "ply" && line != "ply\r") return;
  while (std::getline(file, line)) {
    if (line.starts_with("end_header")) return;
  }
  refuse_endless_header(path);
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
  return fmt::format("{}: files of this kind cannot be read; convert the file to one of {}", path, formats);
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

/// Makes coordinates relative to the given origin, or to one that is chosen. Returns what was subtracted: 0 where
/// floats have all digits of the file.
WorldPoint move(std::string& bytes, std::string_view ending, const std::string& name,
                const std::optional<WorldPoint>& origin) {
  const std::optional<VertexPlaces> places = vertex_places(bytes, ending);
  if (!places) return {};
  const WorldPoint subtracted = origin ? *origin : origin_of(bytes, *places).value_or(WorldPoint{});
  if (subtracted != WorldPoint{}) bytes = relative_to(subtracted, bytes, *places, name);
  return subtracted;
}

/// Returns what was subtracted.
WorldPoint read_file(Assimp::Importer& importer, const std::string& path, const std::optional<WorldPoint>& origin) {
  require_complete_ply_header(path);
  WorldPoint subtracted{};
  const std::string ending = ending_of_name(path);
  if (origin != WorldPoint{} && (ending == "obj" || ending == "stl" || ending == "ply")) {
    std::string bytes = bytes_of(path, path);
    subtracted = move(bytes, ending, path, origin);
    if (subtracted != WorldPoint{}) importer.SetIOHandler(new OneFileReplaced(path, std::move(bytes)));  // it owns that
  }
  if (importer.ReadFile(path, steps) == nullptr) throw InvalidArgument(refusal_of(path, importer));
  return subtracted;
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
  if (ending == "ply" && bytes.find("end_header") == std::string::npos) refuse_endless_header(name);
  const WorldPoint subtracted = origin == WorldPoint{} ? WorldPoint{} : move(bytes, ending, name, origin);
  if (importer.ReadFileFromMemory(bytes.data(), bytes.size(), steps, ending.c_str()) == nullptr) {
    throw InvalidArgument(fmt::format("{}: begins like a file of format {}, but is broken; assimp reports: {}", name,
                                      ending, importer.GetErrorString()));
  }
  return subtracted;
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
