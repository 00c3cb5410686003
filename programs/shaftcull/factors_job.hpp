// SPDX-License-Identifier: MIT
/// What a run of `shaftcull factors` is given, reads and writes, on one process or on many.
#pragma once

#include <cstddef>
#include <string>

#include "factors_result.hpp"
#include "instruction_set.hpp"
#include "scene_options.hpp"
#include "shaftcull/view_factors.hpp"

namespace shaftcull::cli {

struct FactorsOptions {
  SceneOptions scene;
  ViewFactorOptions ask;
  std::size_t megabytes = 256;
  std::string out;
  std::string svg;
  std::string ply;
  bool objects = false;
  std::string up = "z";
  std::string format = "text";
  int threads = 0;
  InstructionSet isa;
};

/// Throws InvalidArgument for files that cannot all be written.
void require_factor_files(const FactorsOptions& options);

/// The scene, without factors.
[[nodiscard]] FactorsResult factors_scene(const FactorsOptions& options);

/// What the library is asked, without a progress callback.
[[nodiscard]] ViewFactorOptions factors_question(const FactorsOptions& options, const FactorsResult& result);

/// Writes the files, and prints the report.
void write_factors(const FactorsResult& result, const FactorsOptions& options);

}  // namespace shaftcull::cli
