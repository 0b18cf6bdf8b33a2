// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/sample_mine/sample_log.hpp"

#include <fstream>
#include <stdexcept>

#include "tools/carmen/carmen_import.hpp"
#include "tools/carmen/carmen_line.hpp"

namespace adit {
namespace {

void write_lcm(SampleRun& run, const std::filesystem::path& path,
               const std::function<void(double)>& progress) {
  LogWriter log(path);
  while (const auto reading = run.next()) {
    write_reading(log, reading->odometry);
    write_reading(log, reading->scan);
    progress(run.fraction_done());
  }
  log.close();
}

void write_carmen(SampleRun& run, const std::filesystem::path& path,
                  const std::function<void(double)>& progress) {
  std::ofstream log(path);
  while (const auto reading = run.next()) {
    const Pose2& pose = reading->odometry.T_wheel_body;
    log << flaser_line({reading->scan, pose, reading->odometry}) << "\n";
    progress(run.fraction_done());
  }
  if (!log.flush()) throw std::runtime_error("cannot write " + path.string());
}

}  // namespace

void write_sample_log(SampleRun& run, const std::filesystem::path& path,
                      const std::function<void(double)>& progress) {
  if (path.extension() == ".lcmlog") {
    write_lcm(run, path, progress);
  } else if (path.extension() == ".log") {
    write_carmen(run, path, progress);
  } else {
    throw std::runtime_error("the output ends in .lcmlog or .log, which says what to write");
  }
}

}  // namespace adit
