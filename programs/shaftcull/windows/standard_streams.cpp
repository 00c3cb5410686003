// SPDX-License-Identifier: MIT
#include "standard_streams.hpp"

#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <shellapi.h>

#include <cstdio>
#include <filesystem>

namespace shaftcull::cli {
namespace {

/// Has a console obey escape sequences. False of what is none.
bool obeys_escapes(DWORD stream) {
  DWORD mode = 0;
  void* const console = GetStdHandle(stream);
  return GetConsoleMode(console, &mode) != 0 && SetConsoleMode(console, mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING) != 0;
}

}  // namespace

void prepare_standard_streams() {
  // Without one, its number is negative, and writing fails.
  for (std::FILE* const stream : {stdin, stdout, stderr}) {
    if (_fileno(stream) >= 0) _setmode(_fileno(stream), _O_BINARY);
  }
  SetConsoleOutputCP(CP_UTF8);
}

bool errors_go_to_terminal() { return obeys_escapes(STD_ERROR_HANDLE); }

std::vector<std::string> command_line(int argc, char** argv) {
  int count = 0;
  wchar_t** const words = CommandLineToArgvW(GetCommandLineW(), &count);
  if (words == nullptr) return {argv, argv + argc};
  std::vector<std::string> line;
  for (int i = 0; i != count; ++i) line.push_back(std::filesystem::path(words[i]).string());
  LocalFree(words);
  return line;
}

}  // namespace shaftcull::cli
