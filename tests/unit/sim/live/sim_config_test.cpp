// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/sim_config.hpp"

#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace adit {
namespace {

using testing::HasSubstr;

std::string error_of(const std::string& text) {
  try {
    parse_fault(text);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}

TEST(FaultParser, HasKindTargetAmountAndTime) {
  const FaultDescription dies = parse_fault("laser_dies:front@20");
  EXPECT_EQ(dies.kind, "laser_dies");
  EXPECT_EQ(dies.target, "front");
  EXPECT_EQ(dies.at_s, 20.0);
  const FaultDescription loss = parse_fault("packet_loss=0.1@5.5");
  EXPECT_EQ(loss.kind, "packet_loss");
  EXPECT_EQ(loss.amount, 0.1);
  EXPECT_EQ(loss.at_s, 5.5);
  EXPECT_EQ(parse_fault("time_jump=-3@0").amount, -3.0);
  EXPECT_EQ(parse_fault("kill:scan_matching@60").target, "scan_matching");
}

TEST(FaultParser, ReportsInvalidFaults) {
  EXPECT_THAT(error_of("laser_dies:front"), HasSubstr("no time"));
  EXPECT_THAT(error_of("laser_dies:front@soon"), HasSubstr("'soon' is not a number"));
  EXPECT_THAT(error_of("laser_dies:front@-1"), HasSubstr("before the start"));
  EXPECT_THAT(error_of("laser_dies:left@1"), HasSubstr("front or rear"));
  EXPECT_THAT(error_of("laser_dies@1"), HasSubstr("front or rear"));
  EXPECT_THAT(error_of("laser_dies:front=2@1"), HasSubstr("has no amount"));
  EXPECT_THAT(error_of("packet_loss@1"), HasSubstr("needs an amount"));
  EXPECT_THAT(error_of("packet_loss=1.5@1"), HasSubstr("0 to 1"));
  EXPECT_THAT(error_of("packet_loss=nan@1"), HasSubstr("not a number"));
  EXPECT_THAT(error_of("time_jump:front=1@1"), HasSubstr("no target"));
  EXPECT_THAT(error_of("kill@1"), HasSubstr("name of a stage"));
  EXPECT_THAT(error_of("explode@1"), HasSubstr("known: laser_dies, laser_recovers"));
  EXPECT_THAT(error_of(""), HasSubstr("no time"));
}

TEST(FaultParser, RejectsProcessFaultsInASingleProcess) {
  reject_process_faults({parse_fault("laser_dies:front@20"), parse_fault("packet_loss=0.1@5")});
  EXPECT_THROW(reject_process_faults({parse_fault("kill:mapping@1")}), std::invalid_argument);
  EXPECT_THROW(reject_process_faults({parse_fault("suspend:mapping@1")}), std::invalid_argument);
}

}  // namespace
}  // namespace adit
