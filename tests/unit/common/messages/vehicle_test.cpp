// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// Commands and states of the vehicle, and states of the simulator.
#include <gtest/gtest.h>

#include "common/messages/fields/quantities.hpp"
#include "common/messages/navigation.hpp"
#include "common/messages/sensing.hpp"
#include "common/messages/sim.hpp"
#include "tests/unit/common/messages/map_values.hpp"

namespace adit {
namespace {

using test::kNaN;
using test::kUtime;
using test::round_trip;

TEST(VehicleMessages, SurviveARoundTrip) {
  const DriveCommand drive{kUtime, -0.4, 0.2};
  EXPECT_EQ(*round_trip(drive), drive);
  const StopOrder stop{kUtime, true, "a wall is near"};
  EXPECT_EQ(*round_trip(stop), stop);
  const TiltCommand tilt{kUtime, -0.3, 0.2};
  EXPECT_EQ(*round_trip(tilt), tilt);
  const VehicleState state{kUtime, 0.4, -0.2, 0.83, false, true};
  EXPECT_EQ(*round_trip(state), state);
  const GasReading gas{kUtime, 0.011, 0.198, 0.00002};
  EXPECT_EQ(*round_trip(gas), gas);
  const SinkageReading sinkage{kUtime, {0.0, 0.01, 0.12, 0.03}};
  EXPECT_EQ(*round_trip(sinkage), sinkage);
}

TEST(SimulationMessages, SurviveARoundTrip) {
  const RunState state{kUtime, 120.5, "hit a post"};
  EXPECT_EQ(*round_trip(state), state);
  EXPECT_EQ(*round_trip(SimTime{kUtime}), SimTime{kUtime});
  const SimTimeDone done{kUtime, "mapping"};
  EXPECT_EQ(*round_trip(done), done);
}

TEST(VehicleMessages, AreRejectedWithImplausibleTimes) {
  EXPECT_EQ(round_trip(DriveCommand{-1}).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(StopOrder{-1, true, ""}).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(TiltCommand{-1, 0.0, 1.0}).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(VehicleState{-1}).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(GasReading{-1}).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(SinkageReading{-1}).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(RunState{-1, 0.0, ""}).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(SimTime{INT64_MAX}).rejection(), kImplausibleTime);
  EXPECT_EQ(round_trip(SimTimeDone{INT64_MIN, "mapping"}).rejection(), kImplausibleTime);
}

TEST(DriveCommandMessage, IsRejectedWithNumbersThatAreNotFinite) {
  EXPECT_EQ(round_trip(DriveCommand{kUtime, kNaN, 0.0}).rejection(), "implausible speed");
  EXPECT_EQ(round_trip(DriveCommand{kUtime, 0.0, kNaN}).rejection(), "implausible curvature");
}

TEST(TiltCommandMessage, IsRejectedWithAnInvalidTarget) {
  EXPECT_EQ(round_trip(TiltCommand{kUtime, kNaN, 0.1}).rejection(), "implausible angle");
  EXPECT_EQ(round_trip(TiltCommand{kUtime, 0.1, kNaN}).rejection(), "rate is not positive");
  EXPECT_EQ(round_trip(TiltCommand{kUtime, 0.1, 0.0}).rejection(), "rate is not positive");
}

TEST(VehicleStateMessage, IsRejectedWithInvalidNumbers) {
  EXPECT_FALSE(round_trip(VehicleState{kUtime, kNaN}));
  EXPECT_FALSE(round_trip(VehicleState{kUtime, 0.0, kNaN}));
  EXPECT_EQ(round_trip(VehicleState{kUtime, 0.0, 0.0, 1.1}).rejection(), kShareOutOfRange);
  EXPECT_EQ(round_trip(VehicleState{kUtime, 0.0, 0.0, kNaN}).rejection(), kShareOutOfRange);
}

TEST(GasMessage, IsRejectedWithInvalidShares) {
  EXPECT_EQ(round_trip(GasReading{kUtime, -0.1, 0.2, 0.0}).rejection(), kShareOutOfRange);
  EXPECT_EQ(round_trip(GasReading{kUtime, 0.1, 1.2, 0.0}).rejection(), kShareOutOfRange);
  EXPECT_EQ(round_trip(GasReading{kUtime, 0.1, 0.2, kNaN}).rejection(), kShareOutOfRange);
}

TEST(SinkageMessage, IsRejectedWithInvalidDepths) {
  EXPECT_EQ(round_trip(SinkageReading{kUtime, {0.0, 0.0, -0.1, 0.0}}).rejection(),
            "implausible depth");
  EXPECT_EQ(round_trip(SinkageReading{kUtime, {0.0, 0.0, 0.0, kNaN}}).rejection(),
            "implausible depth");
}

TEST(RunStateMessage, IsRejectedWithAnInvalidDistance) {
  EXPECT_EQ(round_trip(RunState{kUtime, -1.0, ""}).rejection(), kInvalidDistance);
  EXPECT_EQ(round_trip(RunState{kUtime, kNaN, ""}).rejection(), kInvalidDistance);
}

TEST(SimTimeDoneMessage, IsRejectedWithoutAStage) {
  EXPECT_EQ(round_trip(SimTimeDone{kUtime, ""}).rejection(), "no stage");
}

}  // namespace
}  // namespace adit
