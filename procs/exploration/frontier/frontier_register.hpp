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
  double cluster_distance_m = 0.6;  ///< frontier cells no farther apart are one stub
  double match_m = 2.0;             ///< from where a stub was to where it is found again
  double advance_m = 12.0;  ///< by which a stub moves on down its corridor at most, at a time
  int closings = 3;         ///< by being seen, after which what opens again is a seam of the map
  int stalls = 4;  ///< local maps that come no nearer to a target, after which it is given up

  template <class V>
  void visit(V& v) {
    v("cluster_distance_m", cluster_distance_m, within(0.2, 10.0));
    v("match_m", match_m, within(0.2, 20.0));
    v("advance_m", advance_m, within(0.0, 100.0));
    v("closings", closings, at_least(1));
    v("stalls", stalls, at_least(1));
  }
};

/// What only the register needs to know of a stub.
struct FrontierTrack {
  static constexpr double kNever = 1e9;

  Eigen::Vector2d p_local{0.0, 0.0};  ///< in the frame of the local map that it is tied to
  Eigen::Vector2d direction_local{1.0, 0.0};
  bool final = false;  ///< blocked or unseeable, whatever can be reached
  int stalls = 0;
  double path_length_min_m = kNever;       ///< to it, in this pursuit
  Eigen::Vector2d p_map_at_min{0.0, 0.0};  ///< where it was then, p_map
  int closings = 0;
  bool retried = false;  ///< given up or presumed once already, and opened again

  friend bool operator==(const FrontierTrack&, const FrontierTrack&) = default;
};

/// All that is known of a stub.
struct StoredFrontier {
  Frontier frontier;
  FrontierTrack track;

  friend bool operator==(const StoredFrontier&, const StoredFrontier&) = default;
};

/// Every stub that was ever seen, what became of it, and the evidence. A stub is tied to the local
/// map that saw it, moves with it, and moves on down the corridor as the robot does; where the
/// corridor divides, one branch inherits it and the others are new. Where the map moves, seams in
/// it may open again. One that nobody has seen since, in maps that lie against each other as they
/// did, changes nothing; else that is the stub that was there, and not for ever.
class FrontierRegister {
 public:
  explicit FrontierRegister(const FrontierRegisterParams& params) : params_(params) {}

  /// What is open now. `barriers`: by their places in map, what is behind them is blocked; the
  /// evidence is the text of the nearest.
  struct BarrierEvidence {
    Eigen::Vector2d p_map{0.0, 0.0};
    FrontierState state = FrontierState::kBlocked;
    std::string evidence;
  };
  void update(const std::vector<DetectedFrontier>& ends, const KnownSpace& space,
              const std::vector<BarrierEvidence>& barriers, std::int64_t utime);

  /// A local map was made while the stub was the target, and so long is the way to it now. What
  /// comes no nearer and stays where it is, is given up: water, open air, or no way after all.
  void begin_pursuit(int frontier);
  void record_pursuit(int frontier, double path_length_m, int local_map, std::int64_t utime);

  /// False where there is no such stub, or where it is explored.
  bool block(int frontier, bool unconfirmed, std::string evidence, std::int64_t utime);
  bool reopen(int frontier, std::string evidence, std::int64_t utime);
  /// Opens what was given up for the first time, and once what is presumed to be blocked, since it
  /// lies behind a barrier: that opens when the barriers are gone. Whether there was any.
  bool retry_abandoned(std::int64_t utime);
  /// Whether an open stub can be reached and left within the budget.
  void set_within_budget(int frontier, bool within, const std::string& evidence,
                         std::int64_t utime);

  /// By id.
  [[nodiscard]] const std::vector<Frontier>& frontiers() const { return frontiers_; }
  [[nodiscard]] const Frontier* find(int frontier) const;

  /// By id; and with it a register goes on as this one would, but that a seam may open a stub.
  [[nodiscard]] std::vector<StoredFrontier> stored_frontiers() const;
  void restore(const std::vector<StoredFrontier>& frontiers);

 private:
  struct Pair {
    double distance_m;
    std::size_t frontier;
    std::size_t end;
  };

  void move_with_the_graph(const KnownSpace& space);
  /// Which stubs may be found, and where.
  enum class Search {
    kHere,      ///< those that are not explored, near where they were
    kOnward,    ///< the same, down their corridors
    kReopened,  ///< explored ones, near where they were
  };
  [[nodiscard]] bool may_match(std::size_t frontier, const DetectedFrontier& end,
                               Search search) const;
  void match(const std::vector<DetectedFrontier>& ends, const KnownSpace& space, Search search,
             std::vector<bool>& found, std::vector<bool>& matched);
  void close(std::size_t frontier, const KnownSpace& space, std::int64_t utime);
  [[nodiscard]] bool is_seam(std::size_t frontier, const DetectedFrontier& end,
                             const KnownSpace& space) const;
  void confirm_closed(const std::vector<DetectedFrontier>& ends, const KnownSpace& space);
  void place(std::size_t frontier, const DetectedFrontier& end, const KnownSpace& space);
  void judge(std::size_t frontier, Access access, const std::vector<BarrierEvidence>& barriers,
             std::int64_t utime);

  FrontierRegisterParams params_;
  std::vector<Frontier> frontiers_;
  std::vector<FrontierTrack> tracks_;  ///< by id

  /// By whom a stub was seen to be closed.
  struct Closing {
    std::optional<int> local_map;
    Eigen::Vector2d p_local{0.0, 0.0};  ///< the stub in it
    int up_to = 0;                      ///< local map, with all up to which nothing was open there
  };
  std::vector<Closing> closings_;  ///< by id; nobody after a restart
};

}  // namespace adit
