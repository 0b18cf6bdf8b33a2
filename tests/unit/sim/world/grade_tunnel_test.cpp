// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/world/grade_tunnel.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "sim/vehicle/stance.hpp"
#include "sim/world/build_world.hpp"
#include "sim/world/surface/heights.hpp"
#include "sim/world/world_file.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

std::string error_of(const std::string& name) {
  try {
    find_world(name);
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

HeightProfile profile_of(const std::string& name) {
  const HeightsDescription heights = find_world(name).heights;
  return HeightProfile(heights.profile_m, HeightProfile::grade_named(heights.grade));
}

double slope_at(const HeightProfile& profile, double s_m) {
  constexpr double kHalf = 0.01;
  return (profile.at(s_m + kHalf) - profile.at(s_m - kHalf)) / (2.0 * kHalf);
}

TEST(GradeTunnel, IsFoundByName) {
  EXPECT_EQ(find_world("grade:8").name, "grade_8_30m");
  EXPECT_EQ(find_world("grade:-2.5,rough,sudden,50m", 7).name, "grade_-2.5_sudden_rough_50m");
  EXPECT_EQ(find_world("grade:8", 7).seed, 7);
}

TEST(GradeTunnel, RejectsANameThatIsNotValid) {
  EXPECT_THAT(error_of("grade:"), HasSubstr("'' is not a grade"));
  EXPECT_THAT(error_of("grade:nan"), HasSubstr("'nan' is not a grade"));
  EXPECT_THAT(error_of("grade:8,steep"), HasSubstr("'steep' is neither sudden"));
  EXPECT_THAT(error_of("grade:8,60m"), HasSubstr("'60m' is neither sudden"));
}

TEST(GradeTunnel, HasItsGradeOverItsStretch) {
  for (const double percent : {-25.0, -3.0, 8.0, 30.0}) {
    for (const double over_m : {20.0, 35.0, 50.0}) {
      for (const bool sudden : {false, true}) {
        const std::string name = "grade:" + std::to_string(percent) + (sudden ? ",sudden" : "") +
                                 "," + std::to_string(over_m) + "m";
        const HeightProfile profile = profile_of(name);
        const double grade = percent / 100.0;
        EXPECT_NEAR(slope_at(profile, 10.0), 0.0, 1e-12) << name;
        EXPECT_NEAR(slope_at(profile, 20.0 + over_m / 2.0), grade, 1e-9) << name;
        EXPECT_NEAR(slope_at(profile, 20.0 + over_m + 5.0), 0.0, 1e-12) << name;
        // A parabola of 8 m has the mean slope of a straight line of 4 m.
        const double rise_m = grade * (sudden ? over_m : over_m - 8.0);
        EXPECT_NEAR(profile.at(90.0), rise_m, 1e-9) << name;
        for (double s = 0.0; s < 90.0; s += 0.1) {
          // Smooth interpolation between the points of a parabola is a little steeper at its end.
          EXPECT_LE(std::abs(slope_at(profile, s)), std::abs(grade) * 1.03 + 1e-9) << name;
        }
      }
    }
  }
}

TEST(GradeTunnel, IsDrivenFromEndToEnd) {
  for (const char* name : {"grade:25", "grade:-25,sudden", "grade:30,rough", "grade:-30,rough"}) {
    const Site site(build_world(find_world(name)));
    Stance stance(site, {});
    ASSERT_EQ(stance.put({3.0, 0.0, 0.0}, site.world().truth.floor_height({3.0, 0.0}).value()),
              std::nullopt);
    for (double x = 3.0; x < 88.0; x += 0.05) {
      ASSERT_EQ(stance.move({x, 0.0, 0.0}), std::nullopt) << name << " at " << x;
    }
  }
}

}  // namespace
}  // namespace adit
