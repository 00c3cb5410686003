// SPDX-License-Identifier: MIT
#include "file_path.hpp"

#include <windows.h>

#include <string_view>

namespace shaftcull::cli {
namespace {

// What begins so is taken as it is, however long: no "..", no "/", no devices.
constexpr std::wstring_view verbatim = L"\\\\?\\";
constexpr std::wstring_view verbatim_share = L"\\\\?\\UNC\\";

/// As Windows completes it: devices such as NUL begin with "\\.\" then.
std::wstring absolute(const std::wstring& path) {
  std::wstring whole(GetFullPathNameW(path.c_str(), 0, nullptr, nullptr), L'\0');
  whole.resize(GetFullPathNameW(path.c_str(), static_cast<DWORD>(whole.size()), whole.data(), nullptr));
  return whole.empty() ? path : whole;
}

}  // namespace

std::filesystem::path file_path(const std::string& name) {
  const std::wstring path = absolute(std::filesystem::u8path(name).native());
  if (path.starts_with(L"\\\\?\\") || path.starts_with(L"\\\\.\\")) return path;
  if (path.starts_with(L"\\\\")) return std::wstring(verbatim_share) + path.substr(2);
  return std::wstring(verbatim) + path;
}

std::string file_name(const std::filesystem::path& path) {
  std::wstring name = path.native();
  if (name.starts_with(verbatim_share)) {
    name = L"\\\\" + name.substr(verbatim_share.size());
  } else if (name.starts_with(verbatim)) {
    name.erase(0, verbatim.size());
  }
  return std::filesystem::path(name).string();
}

}  // namespace shaftcull::cli
