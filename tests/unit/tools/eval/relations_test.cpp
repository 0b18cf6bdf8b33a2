// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/relations.hpp"

#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/recordings.hpp"
#include "tools/carmen/carmen_reader.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

std::vector<Relation> parse(const std::string& text) {
  std::istringstream in(text);
  return read_relations(in, "r");
}

Trajectory odometry_of(const std::filesystem::path& log) {
  Trajectory trajectory;
  CarmenReader reader(log);
  while (const auto record = reader.next()) {
    if (const auto* scan = std::get_if<CarmenScan>(&*record)) {
      trajectory.push_back({scan->odometry.utime, scan->odometry.T_wheel_body});
    }
  }
  return trajectory;
}

TEST(Relations, ReadsThePlanarPart) {
  const auto relations = parse("1134864645.90321 1134864646.5 0.3 0.02 9 9 9 0.24\n");
  ASSERT_EQ(relations.size(), 1U);
  EXPECT_EQ(relations[0].utime_1, 1134864645903210);
  EXPECT_EQ(relations[0].utime_2, 1134864646500000);
  EXPECT_EQ(relations[0].T_1_2, (Pose2{0.3, 0.02, 0.24}));
}

TEST(Relations, AnExactTrajectoryHasNoError) {
  const Trajectory trajectory{{0, {5, 5, 1}}, {2'000'000, Pose2{5, 5, 1} * Pose2{2, 0.5, 3}}};
  const auto score = score_relations(parse("0 2 2 0.5 0 0 0 3"), trajectory);
  EXPECT_EQ(score.used, 1U);
  EXPECT_NEAR(score.translation_m.max, 0.0, 1e-12);
  EXPECT_NEAR(score.rotation_deg.max, 0.0, 1e-12);
}

TEST(Relations, MeasuresTheErrorInTheFrameOfTheRelation) {
  const Trajectory trajectory{{0, {0, 0, 0}}, {2'000'000, {2, 0, 0}}, {4'000'000, {2, 4, 0}}};
  const auto score =
      score_relations(parse("0 1 1 0 0 0 0 0\n0 2 2 3 0 0 0 0.1\n0 4 2 4 0 0 0 -0.3"), trajectory);
  EXPECT_NEAR(score.translation_m.mean, 1.0, 1e-12);  // 0, 3, 0
  EXPECT_NEAR(score.translation_m.standard_deviation, std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(score.translation_m.median, 0.0, 1e-12);
  EXPECT_NEAR(score.translation_m.max, 3.0, 1e-12);
  EXPECT_NEAR(score.rotation_deg.mean, rad_to_deg(0.4 / 3.0), 1e-9);
}

TEST(Relations, CountsRelationsOutsideTheTrajectory) {
  const Trajectory trajectory{{0, {}}, {2'000'000, {}}};
  const auto score = score_relations(parse("0 2 0 0 0 0 0 0\n1 3 0 0 0 0 0 0"), trajectory);
  EXPECT_EQ(score.used, 1U);
  EXPECT_EQ(score.outside, 1U);
}

TEST(Relations, WritesNoFiguresWithoutUsedRelations) {
  EXPECT_THAT(to_json({}), Not(HasSubstr("translation_m")));
  EXPECT_THAT(to_json(score_relations(parse("0 2 2 0.5 0 0 0 3"), {{0, {}}, {2'000'000, {}}})),
              HasSubstr("\"mean\": 2.06"));
}

// Published scores of raw odometry for the same files.
TEST(Relations, ScoresTheOdometryOfIntel) {
  ADIT_RECORDING_OR_SKIP(log, "laser2d/intel_raw.log.gz");
  ADIT_RECORDING_OR_SKIP(relations, "laser2d/intel.relations");
  const auto score = score_relations(read_relations(relations), odometry_of(log));
  EXPECT_EQ(score.used + score.outside, 2984U);  // four are outside the log
  EXPECT_NEAR(score.translation_m.mean, 7.36, 0.005);
  EXPECT_NEAR(score.rotation_deg.mean, 40.0, 0.5);
}

TEST(Relations, ScoresTheOdometryOfCsail) {
  ADIT_RECORDING_OR_SKIP(log, "laser2d/csail_raw.log.gz");
  ADIT_RECORDING_OR_SKIP(relations, "laser2d/csail.relations");
  const auto score = score_relations(read_relations(relations), odometry_of(log));
  EXPECT_EQ(score.used, 1172U);
  EXPECT_NEAR(score.translation_m.mean, 1.68, 0.005);
  EXPECT_NEAR(score.rotation_deg.mean, 5.1, 0.05);
}

}  // namespace
}  // namespace adit
