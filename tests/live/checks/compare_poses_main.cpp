// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// compare_poses EXPECTED RECORDED: whether the second log has the poses of the first on POSE, each
// time once, to a millimetre and a milliradian. Says what differs and ends with 1.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <iostream>
#include <map>
#include <stdexcept>
#include <string>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/odometry.hpp"

namespace adit {
namespace {

constexpr double kNearM = 1e-3;
constexpr double kNearRad = 1e-3;
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
    report_fault("at " + std::to_string(utime) + ": " + std::to_string(recorded) +
                 " poses were recorded, not " + std::to_string(expected));
  }

  void compare(std::int64_t utime, const Pose2& expected, const Pose2& recorded) {
    const Pose2 error = between(expected, recorded);
    const double distance_m = error.translation().norm();
    farthest_m_ = std::max(farthest_m_, distance_m);
    if (distance_m <= kNearM && std::abs(error.theta) <= kNearRad) return;
    report_fault("at " + std::to_string(utime) + ": the pose is off by " +
                 std::to_string(distance_m) + " m and " + std::to_string(error.theta) + " rad");
  }

  [[nodiscard]] int faults() const { return faults_; }
  [[nodiscard]] double farthest_m() const { return farthest_m_; }

 private:
  void report_fault(const std::string& what) {
    if (++faults_ <= kShownMax) std::cerr << what << "\n";
  }

  int faults_ = 0;
  double farthest_m_ = 0.0;
};

/// 0 if all agree.
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
  std::cout << recorded.size() << " poses recorded, " << expected.size() << " expected; "
            << comparison.faults() << " faults, farthest " << comparison.farthest_m() << " m\n";
  return comparison.faults() == 0 && !expected.empty() ? 0 : 1;
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
