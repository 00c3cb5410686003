// SPDX-License-Identifier: MIT
/// What a shared library exports: the interface, and nothing else.
///
/// The library is compiled with hidden visibility. Public headers open `namespace SHAFTCULL_INTERFACE shaftcull {`,
/// which makes visible whatever is declared in those braces. Sources that define function templates of the interface do
/// the same, because for these compilers go by the definition. A static library exports nothing: in two plugins that
/// both link it, each has its own.
#pragma once

// SHAFTCULL_SHARED comes with the CMake target and with pkg-config's flags where the library is a shared one.
#if defined(SHAFTCULL_SHARED) && defined(__GNUC__) && !defined(_WIN32)
#define SHAFTCULL_INTERFACE [[gnu::visibility("default")]]
#else
#define SHAFTCULL_INTERFACE
#endif
