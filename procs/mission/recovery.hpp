// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>

#include "procs/mission/narrow_passages.hpp"

namespace adit {

/// Selects the action when planning finds no path to the target or a drive fails. The rules are one
/// table in recovery.cpp. Attempts are counted per target.
class Recovery {
 public:
  static constexpr std::size_t kRules = 8;        ///< rows of the table
  using FrontierId = NarrowPassages::FrontierId;  ///< empty: home, or no target of exploration

  /// What a rejection rests on.
  enum class Evidence {
    kObserved,     ///< observed ground leaves no path
    kUnobserved,   ///< unobserved ground leaves no path, or planning cannot decide
    kNarrow,       ///< observed ground leaves no path, by less than the map resolves
    kDriveFailed,  ///< a path existed and the drive failed: no evidence about the ground
  };

  enum class Action {
    kScanBeside,      ///< scan from slightly behind: ground beside the vehicle and round a corner
    kApproach,        ///< drive as far as a path exists and scan from there
    kScanOtherLaser,  ///< scan with the other laser from the same pose
    kBackOff,         ///< scan again from `back_offs()` times some metres behind
    kRejoin,          ///< drive along the traversed path
    kRescan,          ///< request the target again and scan from the same pose
    kAbandon,         ///< report the target as blocked, or as unconfirmed if `is_uncertain()`
  };

  struct Rejection {
    Evidence evidence = Evidence::kObserved;
    double reached_m = 0.0;                ///< greatest possible progress towards the target
    std::string reason;                    ///< a sentence
    std::optional<Pose2> T_odom_end = {};  ///< where it ends, with the x axis along the route
  };

  /// What the traversed path and the vehicle allow.
  struct Options {
    bool can_back_off = false;       ///< it is long enough
    bool can_rejoin = false;         ///< it leads towards the target
    bool is_short_cut_home = false;  ///< the route home leaves it before the obstacle
    bool has_other_laser = true;     ///< which sees from another place
  };

  /// Returns true and resets all counters if the target changes.
  bool set_target(FrontierId frontier, bool returning_home);
  /// Resets all counters: the obstacles are behind the robot, or a verdict was given. Doubts of
  /// narrow passages remain.
  void reset();

  /// Counts a rejection of the target and returns the action to take.
  Action choose(const Rejection& rejection, const Options& options);

  /// The drive of the last action failed before its viewpoint: the action may be chosen once more.
  void note_missed_viewpoint();

  NarrowPassages& narrow_passages() { return narrow_passages_; }

  [[nodiscard]] int rejections() const { return attempts_.rejections; }
  [[nodiscard]] int back_offs() const { return attempts_.back_offs; }
  /// Whether fewer than two scans observed that no path exists, or a narrow passage is doubtful.
  [[nodiscard]] bool is_uncertain() const;
  /// Greatest possible progress towards the target over all rejections [m].
  [[nodiscard]] double reached_m() const { return attempts_.reached_m; }
  /// The reasons of all rejections.
  [[nodiscard]] const std::string& evidence() const { return attempts_.evidence; }

 private:
  struct Attempts {
    int rejections = 0;
    int observed = 0;  ///< rejections that rest on observed ground
    int back_offs = 0;
    std::array<int, kRules> uses{};  ///< of the rows of the table
    std::optional<std::size_t> last_row =
        {};  ///< of the last action, until its viewpoint is missed
    double reached_m = 0.0;
    std::string evidence;
  };

  FrontierId frontier_;
  bool returning_home_ = false;
  Attempts attempts_;
  NarrowPassages narrow_passages_;
};

}  // namespace adit
