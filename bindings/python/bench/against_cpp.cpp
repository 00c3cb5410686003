// SPDX-License-Identifier: MIT
// The C++ side of against_cpp.py: reads boxes, a and b from a file, and then, for each line on its input, makes the
// call that it names and prints its seconds.

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <string>
#include <vector>

#include "shaftcull/shaftcull.hpp"

namespace {

std::vector<shaftcull::Box> read(std::ifstream& file, std::size_t count) {
  std::vector<shaftcull::Box> boxes(count);
  file.read(reinterpret_cast<char*>(boxes.data()), static_cast<std::streamsize>(count * sizeof(shaftcull::Box)));
  return boxes;
}

/// As a call from Python, results are new each time.
void call(const std::string& name, std::span<const shaftcull::CompiledShaft> shafts, const shaftcull::BoxTree& tree,
          const shaftcull::BoxStream& stream) {
  const shaftcull::BoxView view = stream.view();
  std::vector<std::uint64_t> numbers;
  shaftcull::IndexLists lists;
  if (name == "tree list") {
    shaftcull::list_many(shafts, tree, lists);
  } else if (name == "tree count") {
    numbers.resize(shafts.size());
    shaftcull::count_many(shafts, tree, numbers);
  } else if (name == "tree first_contact") {
    std::vector<shaftcull::FirstContact> contacts(shafts.size());
    shaftcull::first_contact_many(shafts, tree, contacts);
  } else if (name == "flat count") {
    numbers.resize(shafts.size());
    shaftcull::count_many(shafts, view, numbers);
  } else if (name == "flat list") {
    shaftcull::list_many(shafts, view, lists);
  } else if (name == "flat bits") {
    numbers.resize(shafts.size() * shaftcull::bit_words(view.count));
    shaftcull::cull_many(shafts, view, numbers);
  } else {
    std::cerr << "there is no call \"" << name << "\"\n";
    std::exit(2);
  }
}

}  // namespace

int main(int count, char** arguments) {
  if (count != 4) {
    std::cerr << "usage: shaftcull-python-bench FILE BOXES SHAFTS\n";
    return 2;
  }
  std::ifstream file(arguments[1], std::ios::binary);
  const std::vector<shaftcull::Box> boxes = read(file, std::stoul(arguments[2]));
  const shaftcull::BoxStream a(read(file, std::stoul(arguments[3])));
  const shaftcull::BoxStream b(read(file, std::stoul(arguments[3])));
  if (!file) {
    std::cerr << arguments[1] << " is too short\n";
    return 2;
  }
  const shaftcull::BoxTree tree(boxes);
  const shaftcull::BoxStream stream(boxes);
  std::vector<shaftcull::CompiledShaft> shafts(a.size());
  shaftcull::compile_batch(a, b, shafts);
  for (std::string name; std::getline(std::cin, name);) {
    const auto start = std::chrono::steady_clock::now();
    call(name, shafts, tree, stream);
    std::printf("%.9f\n", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
    std::fflush(stdout);
  }
  return 0;
}
