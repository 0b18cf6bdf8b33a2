// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>

#include "procs/supervisor/os/child_process.hpp"

namespace adit {

/// An adit-supervisor, of the folder where this program is, that runs in the working folder and
/// shows life by simulated time, as the guard wants it. Neither it nor anything that it started
/// outlives this object or this process, however that ends.
class SupervisorProgram {
 public:
  /// What it prints is added to the file `log`. Throws std::runtime_error where it cannot be
  /// started.
  SupervisorProgram(const std::filesystem::path& config, const std::filesystem::path& log);

  /// How it ended, if it did, without waiting.
  std::optional<std::string> ended();

  /// Lets it stop its processes, and waits for that.
  void stop();

 private:
  std::ofstream log_;
  ChildProcess child_;
  std::optional<std::string> end_;
};

}  // namespace adit
