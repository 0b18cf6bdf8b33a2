// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// What a vehicle is told and says, and what a simulator says of it.
#include <gtest/gtest.h>

#include "common/messages/checks.hpp"
#include "common/messages/drive_command.hpp"
#include "common/messages/gas_reading.hpp"
#include "common/messages/run_state.hpp"
#include "common/messages/sim_time.hpp"
#include "common/messages/sinkage_reading.hpp"
#include "common/messages/stop_order.hpp"
#include "common/messages/tilt_command.hpp"
#include "common/messages/vehicle_state.hpp"
#include "tests/unit/common/messages/map_values.hpp"

namespace adit {
namespace {

using test::kNaN;
using test::kUtime;
using test::over_the_wire;

TEST(VehicleMessages, GoThereAndBack) {
  const DriveCommand drive{kUtime, -0.4, 0.2};
  EXPECT_EQ(*over_the_wire(drive), drive);
  const StopOrder stop{kUtime, true, "a wall is near"};
  EXPECT_EQ(*over_the_wire(stop), stop);
  const TiltCommand tilt{kUtime, -0.3, 0.2};
  EXPECT_EQ(*over_the_wire(tilt), tilt);
  const VehicleState state{kUtime, 0.4, -0.2, 0.83, false, true};
  EXPECT_EQ(*over_the_wire(state), state);
  const GasReading gas{kUtime, 0.011, 0.198, 0.00002};
  EXPECT_EQ(*over_the_wire(gas), gas);
  const SinkageReading sinkage{kUtime, {0.0, 0.01, 0.12, 0.03}};
  EXPECT_EQ(*over_the_wire(sinkage), sinkage);
}

TEST(SimulationMessages, GoThereAndBack) {
  const RunState state{kUtime, 120.5, "hit a post"};
  EXPECT_EQ(*over_the_wire(state), state);
  EXPECT_EQ(*over_the_wire(SimTime{kUtime}), SimTime{kUtime});
  const SimTimeDone done{kUtime, "mapping"};
  EXPECT_EQ(*over_the_wire(done), done);
}

TEST(VehicleMessages, AreRefusedWithATimeThatCannotBe) {
  EXPECT_EQ(over_the_wire(DriveCommand{-1}).refusal(), kImplausibleTime);
  EXPECT_EQ(over_the_wire(StopOrder{-1, true, ""}).refusal(), kImplausibleTime);
  EXPECT_EQ(over_the_wire(TiltCommand{-1, 0.0, 1.0}).refusal(), kImplausibleTime);
  EXPECT_EQ(over_the_wire(VehicleState{-1}).refusal(), kImplausibleTime);
  EXPECT_EQ(over_the_wire(GasReading{-1}).refusal(), kImplausibleTime);
  EXPECT_EQ(over_the_wire(SinkageReading{-1}).refusal(), kImplausibleTime);
  EXPECT_EQ(over_the_wire(RunState{-1, 0.0, ""}).refusal(), kImplausibleTime);
  EXPECT_EQ(over_the_wire(SimTime{INT64_MAX}).refusal(), kImplausibleTime);
  EXPECT_EQ(over_the_wire(SimTimeDone{INT64_MIN, "mapping"}).refusal(), kImplausibleTime);
}

TEST(DriveCommandMessage, IsRefusedWithNumbersThatAreNotFinite) {
  EXPECT_EQ(over_the_wire(DriveCommand{kUtime, kNaN, 0.0}).refusal(), "speed is not finite");
  EXPECT_EQ(over_the_wire(DriveCommand{kUtime, 0.0, kNaN}).refusal(), "curvature is not finite");
}

TEST(TiltCommandMessage, IsRefusedWhereItLeadsNowhere) {
  EXPECT_EQ(over_the_wire(TiltCommand{kUtime, kNaN, 0.1}).refusal(), "angle is not finite");
  EXPECT_EQ(over_the_wire(TiltCommand{kUtime, 0.1, kNaN}).refusal(), "rate is not finite");
  EXPECT_EQ(over_the_wire(TiltCommand{kUtime, 0.1, 0.0}).refusal(), "rate is not positive");
}

TEST(VehicleStateMessage, IsRefusedWithNumbersThatCannotBe) {
  EXPECT_FALSE(over_the_wire(VehicleState{kUtime, kNaN}));
  EXPECT_FALSE(over_the_wire(VehicleState{kUtime, 0.0, kNaN}));
  EXPECT_EQ(over_the_wire(VehicleState{kUtime, 0.0, 0.0, 1.1}).refusal(), kNoShare);
  EXPECT_EQ(over_the_wire(VehicleState{kUtime, 0.0, 0.0, kNaN}).refusal(), kNoShare);
}

TEST(GasMessage, IsRefusedWithMoreOrLessThanAllOfTheAir) {
  EXPECT_EQ(over_the_wire(GasReading{kUtime, -0.1, 0.2, 0.0}).refusal(), kNoShare);
  EXPECT_EQ(over_the_wire(GasReading{kUtime, 0.1, 1.2, 0.0}).refusal(), kNoShare);
  EXPECT_EQ(over_the_wire(GasReading{kUtime, 0.1, 0.2, kNaN}).refusal(), kNoShare);
}

TEST(SinkageMessage, IsRefusedWithWheelsAboveTheGround) {
  EXPECT_EQ(over_the_wire(SinkageReading{kUtime, {0.0, 0.0, -0.1, 0.0}}).refusal(),
            "depth is negative");
  EXPECT_EQ(over_the_wire(SinkageReading{kUtime, {0.0, 0.0, 0.0, kNaN}}).refusal(),
            "depth is not finite");
}

TEST(RunStateMessage, IsRefusedWithAWayThatIsNone) {
  EXPECT_EQ(over_the_wire(RunState{kUtime, -1.0, ""}).refusal(), "way is negative");
  EXPECT_EQ(over_the_wire(RunState{kUtime, kNaN, ""}).refusal(), "way is not finite");
}

TEST(SimTimeDoneMessage, IsRefusedWithoutAStage) {
  EXPECT_EQ(over_the_wire(SimTimeDone{kUtime, ""}).refusal(), "no stage");
}

}  // namespace
}  // namespace adit
