// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Mapping of repeated traversals of one tunnel.
#include "procs/mapping/mapping.hpp"

#include <cmath>
#include <iterator>
#include <utility>

#include <gtest/gtest.h>

#include "tests/unit/procs/mapping/mapped_world.hpp"

namespace adit {
namespace {

constexpr double kStepM = 0.2;
// Back and forth with the same heading, in the first tunnel of the mine.
constexpr double kTunnelM = 30.0;
// Errors of odometry, within the model of DisplacementError: 0.3 of its standard deviations over 5
// m.
constexpr double kTurnOff = 2.5e-5;  // per step [rad]
constexpr double kLengthOff = 1.0005;
// Of a map at its far end; the noise of matches is 3 mm and 1 mrad.
constexpr double kErrorM = 0.05;
constexpr std::int64_t kStepUs = 1'000'000;
constexpr std::int64_t kStart = 1'600'000'000'000'000;

/// The true position at this path length: back and forth, without end.
Pose2 pose_at(double distance_m) {
  const double round = std::fmod(distance_m, 2.0 * kTunnelM);
  return {std::min(round, 2.0 * kTunnelM - round), 0.0, 0.0};
}

class Shuttle {
 public:
  explicit Shuttle(int maps_per_place_max, double gate = LazyAssociationParams{}.gate,
                   bool by_wheels = false)
      : gate_(gate), by_wheels_(by_wheels) {
    restart(maps_per_place_max);
  }

  void go(double distance_m) {
    for (const double end = distance_m_ + distance_m; distance_m_ < end; distance_m_ += kStepM)
      step();
  }

  void rest(int scans) {
    for (int i = 0; i < scans; ++i) step();
  }

  /// Turns odom between two scans, as a wrong match does.
  void turn_odom(double angle_rad) { T_odom_body_ = T_odom_body_ * Pose2{0.0, 0.0, angle_rad}; }

  /// Restarts from the stored map. Odom continues.
  void restart(int maps_per_place_max) {
    MappingParams params;
    params.maps_per_place_max = maps_per_place_max;
    params.association.gate = gate_;
    StoredMap stored{
        mapping ? mapping->local_maps().load_all() : std::vector<LocalMap>{}, decided_, {}};
    if (mapping) stored.unfinished = mapping->unfinished();
    mapping.emplace(params);
    mapping->restore(std::move(stored));
  }

  /// Error of the estimated pose of the body in map.
  [[nodiscard]] double error_m() const {
    const Pose2 T_map_body = mapping->correction()->T_map_odom * T_odom_body_;
    return between(between(pose_at(0.0), T_world_body_), T_map_body).translation().norm();
  }
  [[nodiscard]] std::size_t maps() const { return mapping->local_maps().size(); }

  std::optional<Mapping> mapping;

 private:
  void step() {
    const Pose2 T_world_body = pose_at(distance_m_);
    const Pose2 moved = between(T_world_body_, T_world_body);
    if (utime_ > kStart)
      T_odom_body_ = T_odom_body_ * Pose2{kLengthOff * moved.x, moved.y, kTurnOff};
    T_world_body_ = T_world_body;
    ScanMatch match;
    match.utime = utime_;
    match.odom_epoch_utime = kStart;
    match.channel = test::kFront;
    match.status = utime_ == kStart ? ScanMatch::Status::kFirstScan : ScanMatch::Status::kMatched;
    match.reference_utime = utime_ == kStart ? 0 : utime_ - kStepUs;
    match.T_odom_body = T_odom_body_;
    if (by_wheels_)
      match.degenerate = {{Eigen::Vector3d::UnitX(), DegenerateDirection::Fill::kOdometry}};
    const LaserScan scan = laser_.measure(T_world_body_, utime_);
    if (const auto update = mapping->add(test::kFront, scan, match); update && update->stored) {
      decided_.insert(decided_.end(), update->associations.begin(), update->associations.end());
    }
    utime_ += kStepUs;
  }

  double gate_;
  bool by_wheels_;  ///< scan matching does not measure the motion along the tunnel
  test::LevelLaser laser_{test::sample_mine(1), 1};
  std::vector<Association> decided_;
  double distance_m_ = 0.0;
  std::int64_t utime_ = kStart;
  Pose2 T_world_body_ = pose_at(0.0);
  Pose2 T_odom_body_;
};

TEST(MappingOfRevisitedPlaces, StoresNoMoreMapsOfAPlaceThanConfigured) {
  Shuttle shuttle(3);
  shuttle.go(4.0 * kTunnelM);
  const std::size_t maps = shuttle.maps();
  shuttle.go(8.0 * kTunnelM);
  EXPECT_LE(shuttle.maps(), maps + 2);  // the ends of the tunnel are passed half as often
  Shuttle keeps_all(0);
  keeps_all.go(12.0 * kTunnelM);
  EXPECT_GT(keeps_all.maps(), 3 * maps);
}

/// The cost of rejecting is so low that some correct loop closures are rejected.
TEST(MappingOfRevisitedPlaces, StoresNoMapForOneRejectedLoopClosureAmongMany) {
  Shuttle shuttle(3, 0.3);
  shuttle.go(4.0 * kTunnelM);
  const std::size_t maps = shuttle.maps();
  shuttle.go(16.0 * kTunnelM);
  EXPECT_LE(shuttle.maps(), maps + 4);
}

TEST(MappingOfRevisitedPlaces, StillLocalisesTheBody) {
  Shuttle shuttle(3);
  shuttle.go(4.0 * kTunnelM);
  for (int i = 0; i < 32; ++i) {  // 240 m, over which odometry turns by 1.7° and is off by 0.9 m
    shuttle.go(kTunnelM / 4.0);
    EXPECT_LT(shuttle.error_m(), kErrorM) << i;
  }
}

/// Relative to home, whether maps are stored or discarded.
TEST(MappingOfRevisitedPlaces, BodyIsUncertainFarFromHomeAndCertainThere) {
  for (const int maps_per_place_max : {0, 3}) {
    Shuttle shuttle(maps_per_place_max);
    double far_m = 0.0;
    for (int round = 0; round < 3; ++round) {
      const auto sd_m = [&] {
        return position_sd_m(shuttle.mapping->correction()->body_covariance);
      };
      shuttle.go(kTunnelM);
      far_m = std::max(far_m, sd_m());
      EXPECT_LT(shuttle.error_m(), 3.0 * sd_m()) << round;
      shuttle.go(kTunnelM);
      EXPECT_LT(shuttle.error_m(), 3.0 * sd_m()) << round;
      EXPECT_LT(sd_m(), 0.8 * far_m) << round;
    }
  }
}

/// The newest local map may end before home, and only the wheels lead from there to the body.
TEST(MappingOfRevisitedPlaces, LocalisesABodyThatRestsNearHome) {
  Shuttle shuttle(0, LazyAssociationParams{}.gate, true);
  shuttle.go(2.0 * kTunnelM - 3.0);  // in the middle of a local map
  const auto sd_m = [&] { return position_sd_m(shuttle.mapping->correction()->body_covariance); };
  const auto poses = shuttle.mapping->graph().poses;
  const double driven_m = sd_m();
  shuttle.rest(4);
  EXPECT_LT(sd_m(), 0.8 * driven_m);
  EXPECT_LT(shuttle.error_m(), 2.448 * sd_m());
  EXPECT_EQ(shuttle.mapping->graph().poses, poses);  // nothing is stored for it
  shuttle.go(0.4);
  EXPECT_GT(sd_m(), 0.9 * driven_m);  // only while it rests
}

TEST(MappingOfRevisitedPlaces, DoesNotLocaliseABodyThatRestsElsewhere) {
  Shuttle shuttle(0, LazyAssociationParams{}.gate, true);
  shuttle.go(2.0 * kTunnelM - 12.0);
  const MapCorrection before = *shuttle.mapping->correction();
  shuttle.rest(4);
  EXPECT_EQ(shuttle.mapping->correction()->T_map_odom, before.T_map_odom);
}

/// Both local maps are bent by what the wheels err within them.
TEST(MappingOfRevisitedPlaces, IsNoSurerOfALoopClosureThanOfTheLocalMapsThemselves) {
  Shuttle shuttle(0, LazyAssociationParams{}.gate, true);
  shuttle.go(2.0 * kTunnelM);
  const MapGraph graph = shuttle.mapping->graph();
  const DisplacementErrorParams error;
  const double bent_m2 = (error.wheels_m_per_sqrt_m * error.wheels_m_per_sqrt_m * 5.0 +
                          error.wheels_scale_sd * error.wheels_scale_sd * 25.0) /
                         3.0;
  int loop_closures = 0;
  for (const MapConstraint& constraint : graph.constraints) {
    if (constraint.kind != MapConstraint::Kind::kLoopClosure) continue;
    ++loop_closures;
    EXPECT_LT(constraint.measured.information(0, 0), 1.0 / (1.9 * bent_m2));
  }
  EXPECT_GT(loop_closures, 3);
}

TEST(MappingOfRevisitedPlaces, StoresMapsOfNewPlaces) {
  Shuttle shuttle(1);
  shuttle.go(kTunnelM);
  EXPECT_GE(shuttle.maps(), 3U);  // beyond the view of the first, which is 20 m
}

TEST(MappingOfRevisitedPlaces, ResumesAfterARestartFromTheLastPose) {
  Shuttle shuttle(3);
  shuttle.go(10.0 * kTunnelM + 8.0);
  const std::size_t maps = shuttle.maps();
  shuttle.restart(3);
  shuttle.go(1.0);
  EXPECT_LT(shuttle.error_m(), kErrorM);
  EXPECT_EQ(shuttle.maps(), maps + 2);  // the unfinished map, and a short one at the restart
}

TEST(MappingOfRevisitedPlaces, FindsNoContradictionInARightMap) {
  Shuttle shuttle(0);
  shuttle.go(4.0 * kTunnelM);
  EXPECT_TRUE(shuttle.mapping->contradictions().pairs.empty());
}

/// The displacement across the wrong match claims to be sure, and no loop closure contradicts it.
TEST(MappingOfRevisitedPlaces, ReportsAMapThatIsFoldedByAWrongTurn) {
  Shuttle shuttle(0);
  shuttle.go(16.0);
  const int turned = shuttle.mapping->unfinished().id;
  shuttle.turn_odom(deg_to_rad(90.0));
  shuttle.go(2.0 * kTunnelM);
  const MapContradictions found = shuttle.mapping->contradictions();
  EXPECT_EQ(found.revision, shuttle.mapping->graph().revision);
  ASSERT_FALSE(found.pairs.empty());
  for (const MapContradiction& pair : found.pairs) {
    EXPECT_LE(pair.older_map, turned);
    EXPECT_GE(pair.newer_map, turned);
  }
  const auto pairs = found.pairs;
  shuttle.restart(0);
  EXPECT_GE(shuttle.mapping->contradictions().pairs.size(), pairs.size());
}

}  // namespace
}  // namespace adit
