// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/recordings.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {

/// A recording with relations, and what others score on it: mean ± standard deviation of the
/// translational error [m].
struct Benchmark {
  const char* name;
  const char* log;
  const char* relations;
  int beams;
  const char* published;         ///< scan matching with odometry, Kümmerle et al. 2009
  const char* scan_to_scan_icp;  ///< point-to-line ICP from scan to scan, without odometry
};

inline constexpr std::array kBenchmarks = {
    Benchmark{"CSAIL", "csail_raw.log.gz", "csail.relations", 361, "0.106 ± 0.325", "0.414 ± 1.32"},
    Benchmark{"Intel", "intel_raw.log.gz", "intel.relations", 180, "0.220 ± 0.296", "0.798 ± 1.07"},
    Benchmark{"FR079", "fr079_chain.log.gz", "fr079.relations", 360, "0.258 ± 0.427",
              "0.672 ± 1.32"},
};

/// Recordings whose pose fields hold a path that was corrected by loop closing. Their odometry is
/// the same path, so that only the laser alone says anything.
struct Corrected {
  const char* name;
  const char* log;
  int beams;
};

inline constexpr std::array kCorrected = {Corrected{"Acapulco", "acapulco_scans.log.gz", 181},
                                          Corrected{"Seattle", "seattle_scans.log.gz", 361}};

/// Nothing where the recording is not there.
inline std::optional<std::filesystem::path> find_laser_recording(const char* name) {
  return test::find_recording(std::string("laser2d/") + name);
}

/// The poses that a log itself holds; scans whose time was refused are not among them.
Trajectory poses_of(const std::filesystem::path& log);

template <class... Values>
std::string format(const char* pattern, Values... values) {
  std::array<char, 400> text{};
  std::snprintf(text.data(), text.size(), pattern, values...);
  return text.data();
}

}  // namespace adit
