// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/bench/readings.hpp"

#include "tools/carmen/carmen_reader.hpp"
#include "tools/sample_mine/sample_run.hpp"

namespace adit {

Readings sample_readings(const SyntheticLaserModel& laser) {
  Readings readings;
  SampleRun run(1, laser);
  while (const auto reading = run.next()) {
    readings.emplace_back(reading->odometry);
    readings.emplace_back(reading->scan);
  }
  return readings;
}

Readings recorded_readings(const std::filesystem::path& path) {
  Readings readings;
  CarmenReader reader(path);
  while (const auto record = reader.next()) {
    if (const auto* scan = std::get_if<CarmenScan>(&*record)) {
      readings.emplace_back(scan->scan);
    } else {
      readings.emplace_back(std::get<WheelOdometry>(*record));
    }
  }
  return readings;
}

}  // namespace adit
