// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>

#include "common/geometry/pose2.hpp"
#include "common/types/mission.hpp"
#include "common/types/vehicle_state.hpp"

namespace adit {

/// What a mission spends its time on.
enum class Activity : std::uint8_t {
  kScan,             ///< 3D scans over which a path was driven
  kScanWithoutPath,  ///< other 3D scans
  kExplore,          ///< waiting for a decision of exploration
  kPlan,             ///< waiting for a path
  kDriveNew,         ///< driving where the robot has not been
  kDriveKnown,       ///< driving where it has been before
  kStand,            ///< standing while it follows a path, not held: steering, changes of direction
  kHeld,             ///< held by the guard while it follows a path
  kWait,             ///< for stages, or paused
};

inline constexpr std::size_t kActivities = 9;

/// "scan", "scan_without_path", ..: keys in files.
const char* name_of(Activity activity);
/// "3D scans", "3D scans without a path", ..: for reports.
const char* description_of(Activity activity);

/// Divides the time of a mission among activities, from the start of PHASE to its end. Times are
/// those of the messages; messages that step back in time add nothing.
class TimeBudget {
 public:
  struct Share {
    std::size_t times = 0;
    double duration_s = 0.0;
    double distance_m = 0.0;  ///< by the wheels, in either direction
  };

  void add(const MissionPhase& phase);
  void add(const VehicleState& state);
  /// `z_m`: height in odom, to tell levels apart.
  void add(std::int64_t utime, const Pose2& T_odom_body, double z_m);

  [[nodiscard]] const Share& share(Activity activity) const {
    return shares_[static_cast<std::size_t>(activity)];
  }
  [[nodiscard]] double duration_s() const;

 private:
  void advance(std::int64_t utime);
  void end_scan(bool path_found);
  [[nodiscard]] Activity activity() const;

  std::array<Share, kActivities> shares_{};
  std::optional<MissionPhase> phase_;
  std::optional<VehicleState> state_;
  std::optional<Activity> last_;
  std::int64_t utime_ = 0;
  double distance_travelled_m_ = 0.0;
  std::optional<Share> scan_;  ///< the newest, until it is known whether a path was found
  bool is_on_known_ground_ = false;
  std::optional<Pose2> T_odom_body_;
  std::map<std::array<int, 3>, double> first_visits_m_;  ///< distance travelled then, by cell
};

}  // namespace adit
