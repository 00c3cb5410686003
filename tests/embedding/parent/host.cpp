// SPDX-License-Identifier: MIT
// Loads two plugins that each have the library in themselves, so that all symbols of the one are there for the other.
// Neither may come to use the other's copy.
#include <dlfcn.h>

#include <cstdio>
#include <cstdlib>

namespace {

void* function_of(const char* plugin, const char* name) {
  void* handle = dlopen(plugin, RTLD_NOW | RTLD_GLOBAL);
  void* function = handle != nullptr ? dlsym(handle, name) : nullptr;
  if (function == nullptr) {
    std::printf("%s\n", dlerror());
    std::exit(1);
  }
  return function;
}

const void* code_in(const char* plugin) {
  return reinterpret_cast<const void* (*)()>(function_of(plugin, "code_of_complete"))();
}

}  // namespace

int main(int /*count*/, char** argument) {
  const char* first = argument[1];
  const char* second = argument[2];
  reinterpret_cast<void (*)()>(function_of(first, "use_scalar"))();
  if (reinterpret_cast<bool (*)()>(function_of(second, "uses_scalar"))()) {
    std::printf("what the first plugin chooses is the second one's choice\n");
    return 1;
  }
  if (code_in(first) == code_in(second)) {
    std::printf("the plugins call one copy of the library\n");
    return 1;
  }
  return 0;
}
