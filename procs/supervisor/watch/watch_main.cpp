// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// adit-watch STOP_SIGNAL STOP_TIME_S PROGRAM [ARGUMENT..]: started by adit-supervisor, not
// manually.
#include <exception>
#include <iostream>

#include "common/config/number_text.hpp"
#include "common/text/message_text.hpp"
#include "procs/supervisor/watch/watch.hpp"

namespace {

constexpr int kExitUnusable = 2;
constexpr int kFirstOfProgram = 3;

int watch(int argc, char** argv) {
  const auto stop_signal = argc > kFirstOfProgram ? adit::parse_number<int>(argv[1]) : std::nullopt;
  const auto stop_time_s = stop_signal ? adit::parse_number<double>(argv[2]) : std::nullopt;
  if (!stop_time_s) {
    std::cerr << "adit-watch: is started by adit-supervisor, one per program\n";
    return kExitUnusable;
  }
  adit::Watch({*stop_signal, *stop_time_s, argv + kFirstOfProgram}).run();
  return 0;
}

}  // namespace

int main(int argc, char** argv) try {
  return watch(argc, argv);
} catch (const std::exception& error) {
  adit::print_error("adit-watch", error.what());
  return kExitUnusable;
}
