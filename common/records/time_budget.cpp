// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/records/time_budget.hpp"

#include <cmath>
#include <limits>
#include <utility>

#include "common/sensing/seconds.hpp"

namespace adit {
namespace {

constexpr double kStandingMS = 0.01;     // below the creeping speed
constexpr double kCellM = 0.5;           // of visited places, with their neighbours
constexpr double kLevelM = 1.5;          // their height
constexpr double kVisitedBeforeM = 3.0;  // of travel ago: not the same visit
constexpr double kJumpM = 8.0;           // between two poses: a new odom frame, not a motion

constexpr std::array<std::pair<const char*, const char*>, kActivities> kNames{{
    {"scan", "3D scans"},
    {"scan_without_path", "3D scans without a path"},
    {"explore", "waiting for exploration"},
    {"plan", "waiting for a path"},
    {"drive_new", "driving on new ground"},
    {"drive_known", "driving on known ground"},
    {"stand", "standing on a path"},
    {"held", "held by the guard"},
    {"wait", "waiting"},
}};

std::array<int, 3> cell_of(const Eigen::Vector2d& p_odom, double z_m) {
  const auto index = [](double x_m, double cell_m) {
    return static_cast<int>(std::floor(x_m / cell_m));
  };
  return {index(p_odom.x(), kCellM), index(p_odom.y(), kCellM), index(z_m, kLevelM)};
}

}  // namespace

const char* name_of(Activity activity) { return kNames[static_cast<std::size_t>(activity)].first; }

const char* description_of(Activity activity) {
  return kNames[static_cast<std::size_t>(activity)].second;
}

/// A scan was of use if the robot drives over it before it does anything else.
void TimeBudget::add(const MissionPhase& phase) {
  advance(phase.utime);
  const bool changes = !phase_ || phase.sequence != phase_->sequence;
  if (changes && scan_ && phase_->phase == Phase::kPlan) end_scan(phase.phase == Phase::kExecute);
  if (changes && scan_ && phase.phase != Phase::kPlan) end_scan(false);
  if (changes && phase.phase == Phase::kScan) scan_.emplace(Share{1, 0.0, 0.0});
  phase_ = phase;
  if (changes && phase.phase != Phase::kScan) last_.reset();
}

void TimeBudget::add(const VehicleState& state) {
  advance(state.utime);
  state_ = state;
}

void TimeBudget::add(std::int64_t utime, const Pose2& T_odom_body, double z_m) {
  advance(utime);
  const Eigen::Vector2d p_odom = T_odom_body.translation();
  if (T_odom_body_ && (p_odom - T_odom_body_->translation()).norm() > kJumpM)
    first_visits_m_.clear();
  T_odom_body_ = T_odom_body;
  const std::array<int, 3> at = cell_of(p_odom, z_m);
  first_visits_m_.try_emplace(at, distance_travelled_m_);
  double first_m = std::numeric_limits<double>::infinity();
  for (int dx = -1; dx <= 1; ++dx) {
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dz = -1; dz <= 1; ++dz) {
        const auto visit = first_visits_m_.find({at[0] + dx, at[1] + dy, at[2] + dz});
        if (visit != first_visits_m_.end()) first_m = std::min(first_m, visit->second);
      }
    }
  }
  is_on_known_ground_ = first_m < distance_travelled_m_ - kVisitedBeforeM;
}

/// The time since the last message belongs to what the robot did then.
void TimeBudget::advance(std::int64_t utime) {
  if (utime <= utime_) return;
  const double elapsed_s = seconds(utime - utime_);
  const bool is_first = std::exchange(utime_, utime) == 0;
  if (is_first || !phase_ || phase_->phase == Phase::kEnded) return;
  const double moved_m = state_ ? std::abs(state_->speed_m_s) * elapsed_s : 0.0;
  distance_travelled_m_ += moved_m;
  const Activity now = activity();
  Share& share = scan_ && now == Activity::kScan ? *scan_ : shares_[static_cast<std::size_t>(now)];
  if (now != Activity::kScan && last_ != now) ++share.times;
  last_ = now;
  share.duration_s += elapsed_s;
  share.distance_m += moved_m;
}

void TimeBudget::end_scan(bool path_found) {
  Share& share =
      shares_[static_cast<std::size_t>(path_found ? Activity::kScan : Activity::kScanWithoutPath)];
  share.times += scan_->times;
  share.duration_s += scan_->duration_s;
  share.distance_m += scan_->distance_m;
  scan_.reset();
}

Activity TimeBudget::activity() const {
  switch (phase_->phase) {
    case Phase::kScan:
      return Activity::kScan;
    case Phase::kExplore:
      return Activity::kExplore;
    case Phase::kPlan:
      return Activity::kPlan;
    case Phase::kExecute:
      break;
    case Phase::kWaiting:
    case Phase::kPaused:
    case Phase::kEnded:
      return Activity::kWait;
  }
  if (state_ && state_->stopped) return Activity::kHeld;
  if (!state_ || std::abs(state_->speed_m_s) < kStandingMS) return Activity::kStand;
  return is_on_known_ground_ ? Activity::kDriveKnown : Activity::kDriveNew;
}

double TimeBudget::duration_s() const {
  double sum_s = scan_ ? scan_->duration_s : 0.0;
  for (const Share& share : shares_) sum_s += share.duration_s;
  return sum_s;
}

}  // namespace adit
