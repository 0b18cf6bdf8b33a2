// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/trajectory.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <istream>
#include <ostream>
#include <sstream>
#include <string>

#include <fmt/format.h>

#include "common/files/file_utils.hpp"
#include "tools/eval/number_table.hpp"

namespace adit {
namespace {

constexpr std::int64_t kToleranceUs = 1000;
constexpr std::int64_t kMicroseconds = 1'000'000;

double yaw(double qx, double qy, double qz, double qw) {
  return std::atan2(2.0 * (qw * qz + qx * qy), 1.0 - 2.0 * (qy * qy + qz * qz));
}

}  // namespace

Pose2 blend(const Pose2& a, const Pose2& b, double share) {
  return {a.x + share * (b.x - a.x), a.y + share * (b.y - a.y),
          wrap_angle(a.theta + share * angle_diff(b.theta, a.theta))};
}

namespace {

template <class Poses>
std::optional<TimedPose> pose_at(const Poses& trajectory, std::int64_t utime) {
  if (trajectory.empty() || utime < trajectory.front().utime - kToleranceUs ||
      utime > trajectory.back().utime + kToleranceUs) {
    return std::nullopt;
  }
  const auto found = std::ranges::lower_bound(trajectory, utime, {}, &TimedPose::utime);
  if (found == trajectory.begin()) return TimedPose{utime, (*found).pose, (*found).z_m};
  const TimedPose before = *(found - 1);
  if (found == trajectory.end()) return TimedPose{utime, before.pose, before.z_m};
  const TimedPose after = *found;
  const double share =
      static_cast<double>(utime - before.utime) / static_cast<double>(after.utime - before.utime);
  return TimedPose{utime, blend(before.pose, after.pose, share),
                   std::lerp(before.z_m, after.z_m, share)};
}

template <class Poses>
double travelled_m(const Poses& trajectory, double step_m) {
  double length = 0.0;
  std::optional<TimedPose> last;
  for (const TimedPose& pose : trajectory) {
    if (!last) last = pose;
    const double distance = (pose.pose.translation() - last->pose.translation()).norm();
    if (distance < step_m) continue;
    length += distance;
    last = pose;
  }
  return length;
}

std::optional<Pose2> in_plan(const std::optional<TimedPose>& at) {
  return at ? std::optional(at->pose) : std::nullopt;
}

std::string tum_line(const TimedPose& at, bool with_height) {
  const auto& [utime, pose, z_m] = at;
  const std::string z = with_height ? fmt::format("{:.9f}", z_m) : "0";
  return fmt::format("{}.{:06} {:.9f} {:.9f} {} 0 0 {:.12f} {:.12f}\n", utime / kMicroseconds,
                     utime % kMicroseconds, pose.x, pose.y, z, std::sin(pose.theta / 2.0),
                     std::cos(pose.theta / 2.0));
}

}  // namespace

std::optional<Pose2> interpolate(const Trajectory& trajectory, std::int64_t utime) {
  return in_plan(pose_at(trajectory, utime));
}

std::optional<Pose2> interpolate(const Spool<TimedPose>& trajectory, std::int64_t utime) {
  return in_plan(pose_at(trajectory, utime));
}

std::optional<TimedPose> interpolate_in_space(const Trajectory& trajectory, std::int64_t utime) {
  return pose_at(trajectory, utime);
}

bool has_heights(const Trajectory& trajectory) {
  return std::any_of(trajectory.begin(), trajectory.end(),
                     [](const TimedPose& at) { return at.z_m != 0.0; });
}

double path_length_m(const Trajectory& trajectory) {
  double length = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    length += (trajectory[i].pose.translation() - trajectory[i - 1].pose.translation()).norm();
  }
  return length;
}

double distance_travelled_m(const Trajectory& trajectory, double step_m) {
  return travelled_m(trajectory, step_m);
}

double distance_travelled_m(const Spool<TimedPose>& trajectory, double step_m) {
  return travelled_m(trajectory, step_m);
}

void write_tum(std::ostream& out, const Trajectory& trajectory) {
  const bool heights = has_heights(trajectory);
  for (const TimedPose& pose : trajectory) out << tum_line(pose, heights);
}

void write_tum(const std::filesystem::path& path, const Trajectory& trajectory) {
  TumWriter writer(path, has_heights(trajectory));
  for (const TimedPose& pose : trajectory) writer.add(pose);
  writer.close();
}

TumWriter::TumWriter(const std::filesystem::path& path, bool with_heights)
    : file_(path), output_(file_.part(), path), with_heights_(with_heights) {}

void TumWriter::add(const TimedPose& pose) {
  constexpr std::size_t kWrittenAtOnce = 65536;
  text_ += tum_line(pose, with_heights_);
  if (text_.size() >= kWrittenAtOnce) flush();
}

void TumWriter::flush() {
  output_.write(text_);
  text_.clear();
}

void TumWriter::close() {
  flush();
  output_.close();
  file_.publish();
}

Trajectory read_tum(std::istream& in, std::string_view name) {
  Trajectory trajectory;
  NumberTable table(in, name, 8);
  while (const auto row = table.next()) {
    const auto& v = *row;
    const double norm = std::hypot(std::hypot(v[4], v[5]), std::hypot(v[6], v[7]));
    if (std::abs(norm - 1.0) > 0.01) table.fail("the quaternion has no unit length");
    const std::int64_t utime = table.microseconds(v[0]);
    if (!trajectory.empty() && utime <= trajectory.back().utime) {
      table.fail("the time does not increase");
    }
    trajectory.push_back({utime, {v[1], v[2], yaw(v[4], v[5], v[6], v[7])}, v[3]});
  }
  return trajectory;
}

Trajectory read_tum(const std::filesystem::path& path) {
  std::istringstream in = open_table(path);
  return read_tum(in, path.string());
}

}  // namespace adit
