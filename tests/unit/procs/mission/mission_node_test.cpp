// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/mission/mission_node.hpp"

#include <cstdint>
#include <optional>
#include <string>

#include <gtest/gtest.h>

#include "common/bus/channels.hpp"
#include "common/bus/memory_bus.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/diagnostics.hpp"
#include "common/messages/mapping/odometry.hpp"
#include "common/messages/mission.hpp"

namespace adit {
namespace {

constexpr std::int64_t kStart = 1'600'000'000'000'000;
constexpr std::int64_t kSecond = 1'000'000;

class MissionNodeOnABus : public testing::Test {
 protected:
  MissionNodeOnABus() {
    subscribe<phase_t>(bus_, channels::kPhase, Delivery::latest(),
                       [this](const MissionPhase& phase) { phase_ = phase; });
  }

  void add_pose(double x_m) {
    const StampedPose pose{utime_, {x_m, 0.0, 0.0}, {}};
    bus_.inject(utime_, channels::kPose, encode(to_message(pose)));
  }

  /// Drives at 0.5 m/s, with a pose ten times per second. Calls `between` after each.
  template <class Between>
  void drive(double length_m, Between between) {
    for (double x_m = 0.0; x_m <= length_m; x_m += 0.05) {
      add_pose(x_m);
      between();
      utime_ += kSecond / 10;
    }
    bus_.advance_to(utime_ + 2 * kSecond);
  }

  MemoryBus bus_;
  MissionNode node_{bus_, MissionNodeParams{}};
  std::optional<MissionPhase> phase_;
  std::int64_t utime_ = kStart;
};

TEST_F(MissionNodeOnABus, MeasuresTheDistanceDespiteAbsurdPoses) {
  drive(2.0, [this] {
    for (const double x_m : {1e6, -9e4, 3e3, 30.0}) add_pose(x_m);
  });
  ASSERT_TRUE(phase_);
  EXPECT_NEAR(phase_->distance_travelled_m, 2.0, 0.2);  // the path has a pose every 0.1 m or so
}

TEST_F(MissionNodeOnABus, TurnsAroundWhenTheDiskTakesNoMap) {
  using Level = Health::Level;
  const auto report = [this](Level level, const std::string& reason) {
    const Heartbeat heartbeat{utime_, "mapping", {level, reason}, 0, 0, 0};
    bus_.inject(utime_, channels::kHeartbeat, encode(to_message(heartbeat)));
  };
  drive(1.0, [&] {
    report(Level::kDegraded, "map.journal: 20 bytes are damaged");
    report(Level::kFault, "the path ends");
  });
  ASSERT_TRUE(phase_);
  EXPECT_EQ(phase_->return_home_reason, "");
  const std::string failure = "map.journal: cannot write: Input/output error";
  drive(1.0, [&] { report(Level::kFault, failure); });
  EXPECT_EQ(phase_->return_home_reason, "what mapping publishes is not stored safely: " + failure);
}

}  // namespace
}  // namespace adit
