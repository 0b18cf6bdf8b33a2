// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// compare_poses EXPECTED RECORDED: checks that both logs have the same poses on POSE at the same
// times, within 1 mm and 1 mrad. Prints the differences; exit code 1.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/odometry.hpp"

namespace adit {
namespace {

constexpr double kToleranceM = 1e-3;
constexpr double kToleranceRad = 1e-3;
constexpr int kShownMax = 10;

using Poses = std::multimap<std::int64_t, Pose2>;

Poses poses_in(const std::string& path) {
  Poses poses;
  LogFile log(path);
  while (const auto event = log.next()) {
    if (event->channel != channels::kPose) continue;
    const auto message = decode<pose_t>(event->data);
    if (!message) throw std::runtime_error(path + ": " + std::string(message.rejection()));
    const auto pose = from_message(*message);
    if (!pose) throw std::runtime_error(path + ": " + std::string(pose.rejection()));
    poses.emplace(pose->utime, pose->T_odom_body);
  }
  return poses;
}

class Comparison {
 public:
  void count(std::int64_t utime, std::size_t expected, std::size_t recorded) {
    if (expected == recorded) return;
    print_difference(
        fmt::format("at {}: {} poses recorded, {} expected", utime, recorded, expected));
  }

  void compare(std::int64_t utime, const Pose2& expected, const Pose2& recorded) {
    const Pose2 error = between(expected, recorded);
    const double distance_m = error.translation().norm();
    distance_max_m_ = std::max(distance_max_m_, distance_m);
    if (distance_m <= kToleranceM && std::abs(error.theta) <= kToleranceRad) return;
    print_difference(
        fmt::format("at {}: pose error {} m and {} rad", utime, distance_m, error.theta));
  }

  [[nodiscard]] int differences() const { return differences_; }
  [[nodiscard]] double distance_max_m() const { return distance_max_m_; }

 private:
  void print_difference(const std::string& difference) {
    if (++differences_ <= kShownMax) std::cerr << difference << "\n";
  }

  int differences_ = 0;
  double distance_max_m_ = 0.0;
};

/// Returns the exit code.
int compare(const Poses& expected, const Poses& recorded) {
  Comparison comparison;
  for (const auto& [utime, pose] : expected) {
    comparison.count(utime, expected.count(utime), recorded.count(utime));
    const auto found = recorded.find(utime);
    if (found != recorded.end()) comparison.compare(utime, pose, found->second);
  }
  for (const auto& [utime, pose] : recorded) {
    if (!expected.contains(utime)) comparison.count(utime, 0, recorded.count(utime));
  }
  std::cout << fmt::format("{} poses recorded, {} expected; {} differences, maximum {} m\n",
                           recorded.size(), expected.size(), comparison.differences(),
                           comparison.distance_max_m());
  return comparison.differences() == 0 && !expected.empty() ? 0 : 1;
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  if (argc != 3) {
    std::cerr << "compare_poses EXPECTED RECORDED\n";
    return 2;
  }
  return adit::compare(adit::poses_in(argv[1]), adit::poses_in(argv[2]));
} catch (const std::exception& error) {
  std::cerr << "compare_poses: " << error.what() << "\n";
  return 2;
}
