// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <ostream>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tools/check_robot/abilities.hpp"
#include "tools/check_robot/field_of_view.hpp"
#include "tools/check_robot/robot_check.hpp"
#include "tools/check_robot/robot_picture.hpp"

namespace adit {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;

const std::filesystem::path kConfigs = std::filesystem::path(ADIT_SOURCE_DIR) / "deploy/config";

std::string config_text(const std::string& name) {
  std::ifstream file(kConfigs / name);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

std::vector<std::string> bad_lines(const RobotConfig& robot) {
  std::vector<std::string> lines;
  for (const CheckResult& result : check_robot(robot)) {
    if (result.verdict == CheckResult::Verdict::kBad) lines.push_back(result.text);
  }
  return lines;
}

RobotConfig robot_of(const std::string& text) {
  return load_robot_config(ConfigFile::parse(text, "robot.yaml"));
}

/// A change of a good description: what somebody might have written, and what the sentence that
/// finds it must mention: where it is, and what to think of.
struct Mistake {
  std::string name;
  std::string config;
  std::vector<std::pair<std::string, std::string>> changes;  ///< from, to
  std::string where;
  std::string remedy;
};

std::ostream& operator<<(std::ostream& out, const Mistake& mistake) { return out << mistake.name; }

std::string with(std::string text, const Mistake& mistake) {
  for (const auto& [from, to] : mistake.changes) {
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  }
  return text;
}

class SeededMistake : public testing::TestWithParam<Mistake> {};

TEST_P(SeededMistake, IsFoundWithASentenceThatLeadsToIt) {
  const Mistake& mistake = GetParam();
  const RobotConfig robot = robot_of(with(config_text(mistake.config), mistake));
  EXPECT_THAT(bad_lines(robot),
              Contains(AllOf(HasSubstr(mistake.where), HasSubstr(mistake.remedy))));
}

const std::string kSkid = "skid_steered.yaml";
const std::string kGroundhog = "groundhog.yaml";
const std::string kLidar = "spinning_lidar.yaml";

INSTANTIATE_TEST_SUITE_P(
    CheckRobot, SeededMistake,
    testing::Values(
        Mistake{"SignOfAMountingAngle",
                kSkid,
                {{"x_m: 0.35, y_m: 0, theta_rad: 0", "x_m: 0.35, y_m: 0.25, theta_rad: -1.2"}},
                "lasers.front.T_body_laser",
                "sign of theta_rad"},
        Mistake{"LaserInsideTheBody",
                kGroundhog,
                {{"x_m: 1.05", "x_m: 0.55"}},
                "lasers.front.T_body_laser",
                "inside the body"},
        Mistake{"FrontAndRearExchanged",
                kGroundhog,
                {{"x_m: 1.05", "x_m: A"}, {"x_m: -1.05", "x_m: 1.05"}, {"x_m: A", "x_m: -1.05"}},
                "lasers.front.x_m",
                "exchanged"},
        Mistake{"TrackDoubled",
                kGroundhog,
                {{"track_m: 0.95", "track_m: 1.9"}},
                "track_m + wheel_width_m = 1.9",
                "stand out of the body"},
        Mistake{"DegreesForRadians",
                kGroundhog,
                {{"theta_rad: 3.141592653589793", "theta_rad: 180"}},
                "lasers.rear.T_body_laser.theta_rad",
                "degrees"},
        Mistake{"RearLaserLooksAhead",
                kGroundhog,
                {{"theta_rad: 3.141592653589793", "theta_rad: 0"}},
                "lasers.rear.T_body_laser.theta_rad",
                "3.14159"},
        Mistake{"LidarPitchedBeyondItsRings",
                kLidar,
                {{"pitch_rad: 0.21", "pitch_rad: 0.4"}},
                "beams of the level view",
                "pitch it less"},
        Mistake{"LidarMountedLevel",
                kLidar,
                {{"pitch_rad: 0.21", "pitch_rad: 0"}},
                "the lowest ring meets level ground",
                "pitch the lidar down"},
        Mistake{"LidarOnARobotThatStopsTooLate",
                kLidar,
                {{"driving:", "guard: {obstacle: {braking_m_s2: 0.04}}\ndriving:"}},
                "the robot stops within",
                "drive slower"},
        Mistake{"LidarWithSweeps",
                kLidar,
                {{"lasers_tilt: false", "lasers_tilt: true"}},
                "scan_matching.lasers_tilt",
                "nothing tilts"},
        Mistake{"RearLaserLeftOut", kSkid, {{"count: 1", "count: 2"}}, "lasers.rear", "count: 1"},
        Mistake{"DiameterForRadius",
                kGroundhog,
                {{"wheel_radius_m: 0.3", "wheel_radius_m: 0.6"}},
                "wheelbase_m + 2 wheel_radius_m",
                "half a diameter"},
        Mistake{"LaserHeightInMillimetres",
                kSkid,
                {{"height_m: 0.45", "height_m: 450"}},
                "lasers.front.height_m",
                "in metres"},
        Mistake{"OriginAtTheRearAxle",
                kSkid,
                {{"x_m: 0.35", "x_m: 1.2"}},
                "lasers.front.T_body_laser",
                "not its rear axle"},
        Mistake{"NoReturnCountsAsAWall",
                kSkid,
                {{"range_max_m: 30 ", "range_max_m: 70 "}},
                "lasers.front.range_max_m",
                "walls"},
        Mistake{"BellyLowerThanTheStep",
                kSkid,
                {{"belly_clearance_m: 0.13", "belly_clearance_m: 0.06"}},
                "step_max_m",
                "belly would rest"},
        Mistake{"MissionTurnsAroundTooLate",
                kSkid,
                {{"sinkage_max_m: 0.04", "sinkage_max_m: 0.1"}},
                "mission.limits.sinkage_max_m",
                "before the guard"},
        Mistake{"BlindZoneOfAnotherMachine",
                kSkid,
                {{"blind_ahead_m: 0.4", "blind_ahead_m: 1.2"}},
                "blind_ahead_m",
                "decrease blind_ahead_m"},
        Mistake{"FootprintThatIsNotSymmetric",
                kSkid,
                {{"  height_m: 0.52",
                  "  footprint: [{x_m: 0.45, y_m: 0.33}, {x_m: 0.45, y_m: -0.33}, "
                  "{x_m: -0.45, y_m: 0.2}, {x_m: -0.45, y_m: -0.2}]\n  height_m: 0.52"}},
                "vehicle.footprint",
                "symmetric"},
        Mistake{
            "FootprintWithoutTheWheels",
            kSkid,
            {{"  height_m: 0.52",
              "  footprint: [{x_m: 0.45, y_m: 0.1}, {x_m: 0.45, y_m: -0.1}, {x_m: 0.1, y_m: 0.33}, "
              "{x_m: -0.1, y_m: 0.33}, {x_m: -0.45, y_m: 0.1}, {x_m: -0.45, y_m: -0.1}, "
              "{x_m: -0.1, y_m: -0.33}, {x_m: 0.1, y_m: -0.33}]\n  height_m: 0.52"}},
            "outer corner of a wheel",
            "protrudes"},
        Mistake{"TurningRadiusOfAnotherMachine",
                kGroundhog,
                {{"turning_radius_m: 1.6", "turning_radius_m: 0.3"}},
                "turning_radius_m = 0.3",
                "linkage"}),
    [](const auto& mistake) { return mistake.param.name; });

TEST(CheckRobot, FindsNothingInTheConfigurationsThatAreDelivered) {
  for (const char* name :
       {"groundhog.yaml", "robot.yaml", "skid_steered.yaml", "spinning_lidar.yaml"}) {
    EXPECT_THAT(bad_lines(robot_of(config_text(name))), IsEmpty()) << name;
  }
}

TEST(CheckRobot, FindsThatTheLasersAreNotDescribed) {
  EXPECT_THAT(bad_lines(robot_of("vehicle: {mass_kg: 500}\n")),
              Contains(HasSubstr("poses of the lasers")));
}

TEST(Abilities, AreThoseOfGroundhogByHand) {
  const Abilities can = abilities_of(robot_of(config_text(kGroundhog)));
  EXPECT_NEAR(can.width_min_m, 1.25, 1e-9);   // 1.2 + 2 * 0.025
  EXPECT_NEAR(can.height_min_m, 1.15, 1e-9);  // 1.0 + 0.15
  EXPECT_NEAR(can.step_max_m, 0.17, 1e-9);    // 0.2 - 0.03
  // Two turns at 75 Hz; 0.5 * (0.1 + 2/75) + 0.5² / (2 * 0.6) + 0.15
  EXPECT_NEAR(can.scan_period_s, 2.0 / 75.0, 1e-9);
  EXPECT_NEAR(can.stopping_m, 0.4217, 1e-4);
}

TEST(FieldOfView, LeavesAGroundhogBlindBesideItself) {
  const RobotConfig robot = robot_of(config_text(kGroundhog));
  const auto arcs = blind_arcs(robot.lasers, robot.vehicle, 0.3);
  ASSERT_EQ(arcs.size(), 2U);
  // Between the lasers at x = ±1.05 m; the outline 0.3 m outside has its flank at y = 0.9 m.
  EXPECT_NEAR(arcs[1].from_rad, std::atan2(0.9, 1.05), 0.01);  // half a degree
  EXPECT_NEAR(arcs[1].to_rad, std::atan2(0.9, -1.05), 0.01);
}

TEST(FieldOfView, LeavesOneLaserOf270DegreesBlindBehind) {
  const RobotConfig robot = robot_of(config_text(kSkid));
  const auto arcs = blind_arcs(robot.lasers, robot.vehicle, 0.3);
  ASSERT_EQ(arcs.size(), 1U);
  EXPECT_NEAR(arcs[0].middle_rad(), std::numbers::pi, 0.01);
  // The beam at 135° from x = 0.35 m meets the flank, y = 0.63 m, at x = -0.28 m.
  EXPECT_NEAR(arcs[0].from_rad, std::atan2(0.63, -0.28), 0.01);
}

TEST(RobotPicture, IsDrawn) {
  const test::ScratchFolder scratch;
  write_robot_png(scratch / "robot.png", "skid_steered.yaml", robot_of(config_text(kSkid)));
  EXPECT_GT(std::filesystem::file_size(scratch / "robot.png"), 5000U);
}

}  // namespace
}  // namespace adit
