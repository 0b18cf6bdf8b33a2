// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tools/adit/adit_app.hpp"

namespace adit {

/// Exit code and output of a run of the command line.
struct CommandResult {
  int exit_code;
  std::string out;
  std::string err;
};

inline CommandResult adit(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "adit");
  std::vector<const char*> argv;
  for (const std::string& argument : arguments) argv.push_back(argument.c_str());
  testing::internal::CaptureStdout();
  testing::internal::CaptureStderr();
  const int exit_code = run_adit(static_cast<int>(argv.size()), argv.data());
  return {exit_code, testing::internal::GetCapturedStdout(),
          testing::internal::GetCapturedStderr()};
}

}  // namespace adit
