// SPDX-License-Identifier: MIT
#include <windows.h>

#include <filesystem>
#include <memory>
#include <stdexcept>

#include "environment.hpp"
#include "program.hpp"

namespace shaftcull::test {
namespace {

struct Close {
  void operator()(void* handle) const noexcept { CloseHandle(handle); }
};
using Handle = std::unique_ptr<void, Close>;

/// Text in UTF-8, in 16 bits a character.
std::wstring wide(const std::string& text) {
  return std::filesystem::path(std::u8string(text.begin(), text.end())).native();
}

/// A word of a command line as programs take it apart: quotes and what stands before them are escaped.
std::wstring quoted(const std::wstring& word) {
  std::wstring text = L"\"";
  std::size_t backslashes = 0;
  for (const wchar_t c : word) {
    if (c == L'"') text.append(backslashes + 1, L'\\');
    backslashes = c == L'\\' ? backslashes + 1 : 0;
    text += c;
  }
  return text.append(backslashes, L'\\') + L'"';
}

/// A file that a program which is started inherits.
Handle inherited(const std::string& path, DWORD access, DWORD disposition) {
  SECURITY_ATTRIBUTES inherit{sizeof(SECURITY_ATTRIBUTES), nullptr, TRUE};
  Handle file(
      CreateFileW(wide(path).c_str(), access, FILE_SHARE_READ | FILE_SHARE_WRITE, &inherit, disposition, 0, nullptr));
  if (file.get() == INVALID_HANDLE_VALUE) throw std::runtime_error("cannot open " + path);
  return file;
}

/// While in scope, an assignment "NAME=value" holds, if there is one.
class Assignment {
 public:
  explicit Assignment(const std::string& text) : name_(text.substr(0, text.find('='))) {
    if (!name_.empty()) set_environment(name_.c_str(), text.substr(name_.size() + 1).c_str());
  }
  Assignment(const Assignment&) = delete;
  Assignment& operator=(const Assignment&) = delete;
  ~Assignment() {
    if (!name_.empty()) set_environment(name_.c_str(), nullptr);
  }

 private:
  std::string name_;
};

}  // namespace

Outcome run_program(const std::vector<std::string>& arguments, const std::string& environment,
                    const std::string& redirection) {
  if (!redirection.empty()) throw std::runtime_error("only a POSIX shell does " + redirection);
  const ScratchFolder scratch;
  const std::string out = scratch.path("out");
  const std::string error = scratch.path("error");
  const std::wstring program = wide(program_path());
  std::wstring command = quoted(program);
  for (const std::string& argument : arguments) command += L' ' + quoted(wide(argument));
  const Assignment assignment(environment);
  Outcome outcome{};
  {
    const Handle input = inherited("NUL", GENERIC_READ, OPEN_EXISTING);
    const Handle output = inherited(out, GENERIC_WRITE, CREATE_ALWAYS);
    const Handle errors = inherited(error, GENERIC_WRITE, CREATE_ALWAYS);
    STARTUPINFOW start{};
    start.cb = sizeof(start);
    start.dwFlags = STARTF_USESTDHANDLES;
    start.hStdInput = input.get();
    start.hStdOutput = output.get();
    start.hStdError = errors.get();
    PROCESS_INFORMATION process{};
    if (CreateProcessW(program.c_str(), command.data(), nullptr, nullptr, TRUE, 0, nullptr, nullptr, &start,
                       &process) == 0) {
      throw std::runtime_error("cannot run " + program_path());
    }
    const Handle thread(process.hThread);
    const Handle child(process.hProcess);
    WaitForSingleObject(child.get(), INFINITE);
    DWORD code = 0;
    GetExitCodeProcess(child.get(), &code);
    outcome.exit_code = static_cast<int>(code);
  }
  outcome.out = bytes_of_file(out);
  outcome.error = bytes_of_file(error);
  return outcome;
}

}  // namespace shaftcull::test
