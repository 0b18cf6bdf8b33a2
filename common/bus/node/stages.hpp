// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "common/bus/order_seal.hpp"
#include "common/sensing/laser_mount.hpp"
#include "common/types/vehicle.hpp"

namespace adit {

/// All stages of the pipeline: the folders of procs/.
inline const std::vector<std::string>& stage_names() {
  static const std::vector<std::string> names{
      "scan_matching", "mapping", "scan_assembly", "terrain", "volume_map", "planning",
      "driving",       "guard",   "exploration",   "mission", "supervisor"};
  return names;
}

/// The section of the simulator, which runs like a stage but is not one.
inline constexpr const char* kSimSection = "sim";
/// The section of the viewer, a process that is not a stage.
inline constexpr const char* kViewerSection = "viewer";

/// The drivers of lasers and of what tilts them; each runs once for each laser of its kind, with a
/// section of its own, <driver>_front or <driver>_rear. That of a spinning lidar runs for the front
/// one only.
inline const std::vector<std::string>& laser_driver_names() {
  static const std::vector<std::string> names{"sick_lms2xx", "scip", "tilt", "velodyne"};
  return names;
}

/// The drivers of which a robot has one, with the section of their name.
inline const std::vector<std::string>& single_driver_names() {
  static const std::vector<std::string> names{"base_serial", "imu_vectornav"};
  return names;
}

/// The programs in drivers/, without adit-.
inline std::vector<std::string> driver_names() {
  std::vector<std::string> names = laser_driver_names();
  for (const std::string& driver : single_driver_names()) names.push_back(driver);
  return names;
}

/// The sections of all drivers.
inline std::vector<std::string> driver_sections() {
  std::vector<std::string> names = single_driver_names();
  for (const std::string& driver : laser_driver_names()) {
    for (const char* laser : {"front", "rear"}) names.push_back(driver + "_" + laser);
  }
  return names;
}

/// All sections of the configuration file: those of the stages, the shared ones, the simulator's,
/// the viewer's and those of the drivers.
inline std::vector<std::string> config_sections() {
  std::vector<std::string> names = stage_names();
  names.emplace_back(Lasers::kSection);
  names.emplace_back(Vehicle::kSection);
  names.emplace_back(SealParams::kSection);
  names.emplace_back(kSimSection);
  names.emplace_back(kViewerSection);
  for (const std::string& section : driver_sections()) names.push_back(section);
  return names;
}

}  // namespace adit
