// SPDX-License-Identifier: MIT
#include <iostream>
#include <shaftcull/shaftcull.hpp>
int main() {
  const shaftcull::CompiledShaft shaft = shaftcull::compile({{0, 0, 0}, {1, 1, 1}}, {{8, 8, 0}, {9, 9, 1}});
  const std::array<shaftcull::Box, 2> boxes{{{{4, 4, 0}, {5, 5, 1}}, {{8, 0, 0}, {9, 1, 1}}}};
  const shaftcull::BoxStream stream{std::span(boxes)};
  std::uint64_t kept = 0;
  shaftcull::cull(shaft, stream.view(), {&kept, 1});
  std::cout << "kept " << kept << '\n';
}
