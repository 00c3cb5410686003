// SPDX-License-Identifier: MIT
/// The macros by which a shared library exports its interface, and nothing else.
///
/// On systems with ELF and Mach-O files, the library is compiled with hidden visibility. Public headers use
/// SHAFTCULL_INTERFACE in their namespace, which makes all declarations in its braces visible. Sources that define
/// function templates of the interface do the same, because these compilers use the visibility of the definition. On
/// Windows, a DLL exports declarations that begin with SHAFTCULL_EXPORT: functions, and classes with functions of their
/// own that are not inline.
///
/// A static library exports nothing: if two plugins link it, each has its own copy.
#pragma once

// The CMake target and pkg-config's flags define SHAFTCULL_SHARED if the library is shared. CMake defines
// shaftcull_EXPORTS for the sources of a shared library.
#if !defined(SHAFTCULL_SHARED)
/// Makes the contents of the braces visible in `namespace SHAFTCULL_INTERFACE shaftcull { … }`.
#define SHAFTCULL_INTERFACE
/// Precedes each function, and each class with functions that are not inline, so that a DLL exports them.
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
