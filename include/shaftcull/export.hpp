// SPDX-License-Identifier: MIT
/// What a shared library exports: the interface, and nothing else.
///
/// On systems with ELF and Mach-O files, the library is compiled with hidden visibility. Public headers open
/// `namespace SHAFTCULL_INTERFACE shaftcull {`, which makes visible whatever is declared in those braces. Sources that
/// define function templates of the interface do the same, because for these compilers go by the definition. On
/// Windows, a DLL exports what has SHAFTCULL_EXPORT before it: functions, and classes with functions of their own that
/// are not inline.
///
/// A static library exports nothing: in two plugins that both link it, each has its own.
#pragma once

// SHAFTCULL_SHARED comes with the CMake target and with pkg-config's flags where the library is a shared one;
// shaftcull_EXPORTS with the sources of a shared library that CMake builds.
#if !defined(SHAFTCULL_SHARED)
/// Stands in `namespace SHAFTCULL_INTERFACE shaftcull`: makes visible what is in its braces.
#define SHAFTCULL_INTERFACE
/// Stands before each function, and each class with functions that are not inline: a DLL exports them.
#define SHAFTCULL_EXPORT
#elif defined(_WIN32)
#define SHAFTCULL_INTERFACE
#ifdef shaftcull_EXPORTS
#define SHAFTCULL_EXPORT __declspec(dllexport)
#else
#define SHAFTCULL_EXPORT __declspec(dllimport)
#endif
#else
#define SHAFTCULL_INTERFACE [[gnu::visibility("default")]]
#define SHAFTCULL_EXPORT
#endif
