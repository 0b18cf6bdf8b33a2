// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>

#include "common/bus/node/stop_signal.hpp"
#include "tools/adit/progress_bar.hpp"

namespace adit {

/// The progress of a run of several steps that publishes its folder of results as a whole, at the
/// end. Must be created before any thread (StopSignal).
class RunProgress {
 public:
  /// `folder`: of the results.
  explicit RunProgress(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Shows the completed share of a step. Throws std::runtime_error if SIGINT or SIGTERM has
  /// arrived; its text says that nothing was written.
  void update(const std::string& step, double done);

 private:
  std::filesystem::path folder_;
  StopSignal stop_;
  std::optional<ProgressBar> bar_;
  std::string step_;
};

}  // namespace adit
