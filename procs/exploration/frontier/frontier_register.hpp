// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/types/exploration.hpp"
#include "procs/exploration/frontier/frontier_detection.hpp"
#include "procs/exploration/map/known_space.hpp"

namespace adit {

struct FrontierRegisterParams {
  double cluster_distance_m = 0.6;  ///< frontier cells no farther apart form one frontier
  double match_m = 2.0;             ///< distance over which a frontier is matched to a detection
  double advance_m = 12.0;          ///< largest advance along its corridor per update
  int closings = 3;  ///< times it is explored, after which a detection there is a seam of the map
  /// Plans without a path, after which returns of level lasers alone do not close a frontier that
  /// the robot has not passed.
  int rejections = 2;
  /// Width of an opening, in widths of the vehicle, through which it fits without doubt. Level
  /// lasers may take rising ground or a falling roof before it for walls, so it is not too narrow
  /// without other evidence.
  double wide_ratio = 1.5;
  int stalls = 5;  ///< local maps without progress towards the target, after which it is abandoned

  template <class V>
  void visit(V& v) {
    v("cluster_distance_m", cluster_distance_m, within(0.2, 10.0));
    v("match_m", match_m, within(0.2, 20.0));
    v("advance_m", advance_m, within(0.0, 100.0));
    v("closings", closings, at_least(1));
    v("rejections", rejections, at_least(1));
    v("wide_ratio", wide_ratio, within(1.0, 100.0));
    v("stalls", stalls, at_least(1));
  }
};

/// State of a frontier that only the register uses.
struct FrontierTrack {
  static constexpr double kNever = 1e9;

  Eigen::Vector2d p_local{0.0, 0.0};  ///< in the frame of the local map that it is anchored to
  Eigen::Vector2d direction_local{1.0, 0.0};
  bool final = false;                        ///< its state no longer depends on its access
  int stalls = 0;                            ///< local maps in a row without progress towards it
  double path_length_min_m = kNever;         ///< least path length to it in this pursuit
  Eigen::Vector2d p_map_at_min{0.0, 0.0};    ///< its p_map at that time
  int closings = 0;                          ///< how often it became explored
  bool retried = false;                      ///< abandoned or presumed blocked before, and reopened
  int rejections = 0;                        ///< plans to it that found no path
  Eigen::Vector2d p_map_rejected{0.0, 0.0};  ///< its p_map at the first of them

  friend bool operator==(const FrontierTrack&, const FrontierTrack&) = default;
};

/// A frontier with its track, as the journal stores it.
struct StoredFrontier {
  Frontier frontier;
  FrontierTrack track;

  friend bool operator==(const StoredFrontier&, const StoredFrontier&) = default;
};

/// Every frontier ever detected, with its state and the evidence for it. A frontier is anchored to
/// the local map that observed it, moves with it, and advances along the corridor with the robot;
/// at a junction one branch inherits it and the others are new. Where local maps move relative to
/// each other, seams may open in the map. A detection at an explored frontier is ignored as a seam
/// if no later local map observed the place, the local maps have not moved relative to each other,
/// and no wall there was dismissed; otherwise the frontier is reopened.
class FrontierRegister {
 public:
  FrontierRegister(const FrontierRegisterParams& params, double vehicle_width_m)
      : params_(params), wide_m_(params.wide_ratio * vehicle_width_m) {}

  /// A barrier and the state of frontiers behind it.
  struct BarrierEvidence {
    Eigen::Vector2d p_map{0.0, 0.0};
    FrontierState state = FrontierState::kBlocked;
    std::string evidence;
  };
  /// Matches the detections to the frontiers. Frontiers without a detection become explored, or
  /// unconfirmed if the planner found no path to them before;
  /// frontiers behind a barrier get the state and evidence of the nearest one. Without a posed
  /// local map nothing is known, and nothing changes.
  void update(const std::vector<DetectedFrontier>& detections, const KnownSpace& space,
              const std::vector<BarrierEvidence>& barriers, std::int64_t utime);

  /// The frontier becomes the target.
  void begin_pursuit(int frontier);
  /// A local map was completed while the frontier was the target, at a path length of
  /// `path_length_m` from it. A frontier that comes no nearer and does not move is abandoned:
  /// water, open air, or no path after all.
  void record_pursuit(int frontier, double path_length_m, int local_map, std::int64_t utime);

  /// The planner found no path to the frontier.
  void record_rejection(int frontier);

  /// Marks a frontier as blocked, or as unconfirmed. Returns false if there is no such frontier, or
  /// if it is explored.
  bool block(int frontier, bool unconfirmed, std::string evidence, std::int64_t utime);
  /// Reopens a frontier whose state is final. Returns false if there is none.
  bool reopen(int frontier, std::string evidence, std::int64_t utime);
  /// Reopens, once each, frontiers that were abandoned and frontiers that are presumed blocked
  /// because they lie behind a barrier; the latter open when the barriers are removed. Returns
  /// whether there was any.
  bool retry_abandoned(std::int64_t utime);
  /// No frontier is explored permanently any more: what closed it may have been no wall.
  void forget_closings();
  /// Sets whether an open frontier can be visited within the budget.
  void set_within_budget(int frontier, bool within, const std::string& evidence,
                         std::int64_t utime);

  /// By id.
  [[nodiscard]] const std::vector<Frontier>& frontiers() const { return frontiers_; }
  [[nodiscard]] const Frontier* find(int frontier) const;

  /// By id. A restored register behaves as this one, except that seams are not recognized until its
  /// frontiers are confirmed again.
  [[nodiscard]] std::vector<StoredFrontier> stored_frontiers() const;
  void restore(const std::vector<StoredFrontier>& frontiers);

 private:
  struct Pair {
    double distance_m;
    std::size_t frontier;
    std::size_t detection;
  };
  /// The known space, of which at least one local map has a pose.
  struct PosedSpace {
    const KnownSpace& space;
    PosedTile newest;
  };

  void move_with_the_graph(const KnownSpace& space);
  /// Which frontiers are matched in a pass, and where.
  enum class Search {
    kHere,      ///< not explored, near their position
    kAhead,     ///< not explored, ahead in their corridor
    kReopened,  ///< explored, near their position
  };
  [[nodiscard]] bool may_match(std::size_t frontier, const DetectedFrontier& detection,
                               Search search) const;
  void match(const std::vector<DetectedFrontier>& detections, const PosedSpace& posed,
             Search search, std::vector<bool>& found, std::vector<bool>& matched);
  void add(const DetectedFrontier& detection, const PosedSpace& posed, std::int64_t utime);
  void close(std::size_t frontier, const PosedSpace& posed, std::int64_t utime);
  [[nodiscard]] bool is_seam(std::size_t frontier, const DetectedFrontier& detection,
                             const KnownSpace& space) const;
  void confirm_closed(const std::vector<DetectedFrontier>& detections, const PosedTile& newest);
  void move_to(std::size_t frontier, const DetectedFrontier& detection, const PosedSpace& posed);
  void set_state_by_access(std::size_t frontier, Access access,
                           const std::vector<BarrierEvidence>& barriers, std::int64_t utime);

  FrontierRegisterParams params_;
  double wide_m_;  ///< an opening that is no narrower lets the vehicle pass
  std::vector<Frontier> frontiers_;
  std::vector<FrontierTrack> tracks_;  ///< by id

  /// The local map that observed a frontier as closed.
  struct Closing {
    std::optional<int> local_map;
    Eigen::Vector2d p_local{0.0, 0.0};  ///< the frontier in it
    int up_to = 0;  ///< newest local map at the last update without a detection there
  };
  std::vector<Closing> closings_;  ///< by id; empty after a restart
};

}  // namespace adit
