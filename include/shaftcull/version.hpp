// SPDX-License-Identifier: MIT
/// The version of this library, for code that must compile with several. Within a major version, calls are only added.
#pragma once

// The build reads the version from these three lines: keep their form.

/// A part of the version.
#define SHAFTCULL_VERSION_MAJOR 1
#define SHAFTCULL_VERSION_MINOR 0
#define SHAFTCULL_VERSION_PATCH 0

/// "1.0.0"
#define SHAFTCULL_VERSION_STRING            \
  SHAFTCULL_QUOTED(SHAFTCULL_VERSION_MAJOR) \
  "." SHAFTCULL_QUOTED(SHAFTCULL_VERSION_MINOR) "." SHAFTCULL_QUOTED(SHAFTCULL_VERSION_PATCH)
/// For SHAFTCULL_VERSION_STRING.
#define SHAFTCULL_QUOTED(number) SHAFTCULL_QUOTED_AS_IT_IS(number)
#define SHAFTCULL_QUOTED_AS_IT_IS(number) #number

/// The version as one number: `#if SHAFTCULL_VERSION >= 1002000` tests for 1.2.0 or newer.
#define SHAFTCULL_VERSION (SHAFTCULL_VERSION_MAJOR * 1000000 + SHAFTCULL_VERSION_MINOR * 1000 + SHAFTCULL_VERSION_PATCH)
