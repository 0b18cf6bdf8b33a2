// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tools/map/map_run.hpp"
#include "tools/sim/sample_run.hpp"

namespace adit {

/// Runs the complete pipeline on logs of the sample mine, each test in its own folder.
class MapRunTest : public testing::Test {
 protected:
  enum class Odometry { kUsed, kIgnored };

  /// Writes the first part of a drive through the mine; returns the true trajectory.
  Trajectory write_sample(const std::string& name, double length_m) const {
    SampleRun run({.length_max_m = length_m});
    write_sample_log(run, scratch_ / name);
    return run.truth();
  }

  MapRunResult map(const std::filesystem::path& input, const std::string& folder,
                   Odometry odometry = Odometry::kUsed,
                   const std::filesystem::path& config = {}) const {
    return run_map({input, scratch_ / folder, config, odometry == Odometry::kUsed, {}, true},
                   [](const std::string&, double) {});
  }

  /// Continues the map in the folder `earlier`.
  MapRunResult resume(const std::filesystem::path& input, const std::string& folder,
                      const std::string& earlier) const {
    return run_map({input, scratch_ / folder, {}, true, scratch_ / earlier, true},
                   [](const std::string&, double) {});
  }

  [[nodiscard]] std::filesystem::path at(const std::string& name) const { return scratch_ / name; }
  [[nodiscard]] std::string contents(const std::string& name) const {
    return test::contents(scratch_ / name);
  }

 private:
  test::ScratchFolder scratch_;
};

}  // namespace adit
