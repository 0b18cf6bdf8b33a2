// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// live_spy [LOG]: `adit spy` as a program without the other commands.
#include <exception>
#include <iostream>

#include "tools/adit/lcm_spy.hpp"

int main(int argc, char** argv) try {
  adit::run_lcm_spy(argc > 1 ? std::optional<std::filesystem::path>(argv[1]) : std::nullopt);
} catch (const std::exception& error) {
  std::cerr << "live_spy: " << error.what() << "\n";
  return 2;
}
