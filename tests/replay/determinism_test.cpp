// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The same log, configuration and build give the same bytes.
#include <string>
#include <tuple>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "tests/replay/map_fixture.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {
namespace {

constexpr double kLength = 60.0;  // with local maps and the first loop closures

/// The messages on POSE.
Trajectory poses_in(const std::filesystem::path& path) {
  Trajectory trajectory;
  LogFile log(path);
  while (const auto event = log.next()) {
    if (event->channel != channels::kPose) continue;
    const auto pose = from_message(*decode<pose_t>(event->data));
    trajectory.push_back({pose->utime, pose->T_odom_body});
  }
  return trajectory;
}

class Determinism : public MapRunTest {
 protected:
  void expect_same_bytes(const std::string& folder, const std::string& other) const {
    for (const std::string name : {"/trajectory.tum", "/odometry.tum", "/run.lcmlog", "/map.pgm",
                                   "/map.png", "/graph.g2o", "/associations.tsv", "/map.journal"}) {
      EXPECT_FALSE(contents(folder + name).empty()) << name;
      EXPECT_TRUE(contents(folder + name) == contents(other + name)) << name;
    }
  }
};

class DeterminismOf : public Determinism,
                      public testing::WithParamInterface<std::tuple<std::string, bool>> {
 protected:
  const std::string log_ = std::get<0>(GetParam());
  const Odometry odometry_ = std::get<1>(GetParam()) ? Odometry::kUsed : Odometry::kIgnored;
};

TEST_P(DeterminismOf, GivesTheSameBytesTwice) {
  write_sample(log_, kLength);
  map(at(log_), "once", odometry_);
  map(at(log_), "twice", odometry_);
  expect_same_bytes("once", "twice");
}

TEST_P(DeterminismOf, TheLogOfARunGivesTheSameRun) {
  write_sample(log_, kLength);
  map(at(log_), "once", odometry_);
  map(at("once/run.lcmlog"), "replayed", odometry_);
  for (const std::string name :
       {"/trajectory.tum", "/odometry.tum", "/run.lcmlog", "/graph.g2o", "/map.journal"}) {
    EXPECT_TRUE(contents("once" + name) == contents("replayed" + name)) << name;
  }
  EXPECT_EQ(poses_in(at("once/run.lcmlog")), poses_in(at("replayed/run.lcmlog")));
}

INSTANTIATE_TEST_SUITE_P(Logs, DeterminismOf,
                         testing::Combine(testing::Values(std::string("sample.lcmlog"),
                                                          std::string("sample.log")),
                                          testing::Bool()),
                         [](const auto& instance) {
                           const bool carmen = std::get<0>(instance.param) == "sample.log";
                           return std::string(carmen ? "Carmen" : "Lcm") +
                                  (std::get<1>(instance.param) ? "WithOdometry"
                                                               : "WithoutOdometry");
                         });

TEST_F(Determinism, TheLogFormatDoesNotMatter) {
  write_sample("sample.lcmlog", kLength);
  write_sample("sample.log", kLength);
  // CARMEN text has the 1 cm resolution of the laser, but not all digits of odometry.
  map(at("sample.lcmlog"), "lcm", Odometry::kIgnored);
  map(at("sample.log"), "carmen", Odometry::kIgnored);
  EXPECT_TRUE(contents("lcm/trajectory.tum") == contents("carmen/trajectory.tum"));
  EXPECT_TRUE(contents("lcm/graph.g2o") == contents("carmen/graph.g2o"));
}

TEST_F(Determinism, ResumingIsReproducible) {
  write_sample("sample.lcmlog", kLength);
  map(at("sample.lcmlog"), "first");
  resume(at("sample.lcmlog"), "once", "first");
  resume(at("sample.lcmlog"), "twice", "first");
  expect_same_bytes("once", "twice");
}

TEST_F(Determinism, OdometryFileHasThePublishedPoses) {
  write_sample("sample.lcmlog", kLength);
  map(at("sample.lcmlog"), "map");
  const Trajectory written = read_tum(at("map/odometry.tum"));
  const Trajectory published = poses_in(at("map/run.lcmlog"));
  ASSERT_EQ(written.size(), published.size());
  for (std::size_t i = 0; i < written.size(); ++i) {
    EXPECT_EQ(written[i].utime, published[i].utime);
    const Pose2 error = between(written[i].pose, published[i].pose);
    EXPECT_LT(error.translation().norm(), 1e-5);  // rounding in the text
    EXPECT_NEAR(error.theta, 0.0, 1e-5);
  }
}

}  // namespace
}  // namespace adit
