// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <thread>

#include <unistd.h>

namespace adit::test {

/// A unique argument of `sleep` [s] by which the processes of a test are identified.
inline std::string unique_sleep() {
  static int count = 0;
  return "1000." + std::to_string(getpid()) + "00" + std::to_string(++count);
}

/// Number of processes, without zombies, whose command line contains the text.
inline int count_processes_with(const std::string& text) {
  int found = 0;
  std::error_code gone;
  for (const auto& folder : std::filesystem::directory_iterator("/proc", gone)) {
    if (folder.path() == std::filesystem::path("/proc") / std::to_string(getpid())) continue;
    std::ifstream file(folder.path() / "cmdline");
    std::string line;
    std::getline(file, line);  // empty if the process has ended
    if (line.find(text) != std::string::npos) ++found;
  }
  return found;
}

/// Whether the condition becomes true within ten seconds.
inline bool becomes_true(const std::function<bool()>& condition) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return true;
}

}  // namespace adit::test
