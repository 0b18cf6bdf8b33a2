// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/compare/compare_surveys.hpp"

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/files/file_error.hpp"
#include "common/files/file_utils.hpp"
#include "common/geometry/local_crs.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tools/survey/files/las_file.hpp"
#include "tools/survey/files/vector_files.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

constexpr double kLengthM = 16.0;
constexpr double kHalfWidthM = 1.6;
constexpr double kHeightM = 2.2;
constexpr double kStepM = 0.06;
constexpr double kNoiseSdM = 0.008;

/// Relief of a surface, into the void.
double relief_m(double s, double t, double phase) {
  return 0.06 * std::sin(2.1 * s + phase) * std::cos(1.7 * t) + 0.03 * std::sin(4.3 * s + 3.1 * t);
}

/// How far a surface moved into the void; `surface`: 0 floor, 1 roof, 2 left wall, 3 right wall.
using Change = std::function<double(int surface, const Eigen::Vector3d& p)>;

double no_change(int /*surface*/, const Eigen::Vector3d& /*p*/) { return 0.0; }

/// The surfaces of a tunnel along x that a laser at `x` sees within 6 m.
std::vector<Eigen::Vector3d> scan_from(double x_laser, const Change& change, std::mt19937& random) {
  std::normal_distribution<double> noise(0.0, kNoiseSdM);
  std::vector<Eigen::Vector3d> points;
  for (double x = std::max(0.0, x_laser - 6.0); x < std::min(kLengthM, x_laser + 6.0);
       x += kStepM) {
    for (double t = -kHalfWidthM; t < kHalfWidthM; t += kStepM) {
      Eigen::Vector3d floor(x, t, relief_m(x, t, 0.3) + noise(random));
      Eigen::Vector3d roof(x, t, kHeightM - relief_m(x, t, 1.9) + noise(random));
      floor.z() += change(0, floor);
      roof.z() -= change(1, roof);
      points.push_back(floor);
      points.push_back(roof);
    }
    for (double z = 0.15; z < kHeightM - 0.15; z += kStepM) {
      Eigen::Vector3d left(x, kHalfWidthM - relief_m(x, z, 2.5) + noise(random), z);
      Eigen::Vector3d right(x, -kHalfWidthM + relief_m(x, z, 4.0) + noise(random), z);
      left.y() -= change(2, left);
      right.y() += change(3, right);
      points.push_back(left);
      points.push_back(right);
    }
  }
  return points;
}

/// A motion of the coordinates of a survey that grows along the tunnel, as drift does.
struct Drift {
  double turn_rad = 0.0;
  double up_m = 0.0;  ///< at the end of the tunnel
};

class CompareSurveys : public testing::Test {
 protected:
  /// Writes a survey, as `adit survey` does, of a tunnel; returns its folder.
  fs::path survey(const std::string& name, unsigned int seed, const Change& change = no_change,
                  const Drift& drift = {}, const std::string& crs = "mine") {
    const fs::path folder = folder_ / name;
    fs::create_directory(folder);
    std::mt19937 random(seed);
    std::vector<LasPoint> points;
    VectorLayer scans{"scans",
                      VectorLayer::Geometry::kPoint,
                      {{"scan", VectorLayer::Field::Type::kInteger},
                       {"laser_m", VectorLayer::Field::Type::kNumber},
                       {"step_sd_m", VectorLayer::Field::Type::kNumber},
                       {"step_turn_sd_rad", VectorLayer::Field::Type::kNumber},
                       {"step_z_sd_m", VectorLayer::Field::Type::kNumber}},
                      {}};
    std::uint32_t number = 0;
    for (double x = 2.0; x < kLengthM; x += 4.0) {
      ++number;
      const Eigen::Vector3d up(0.0, 0.0, drift.up_m * x / kLengthM);
      const Eigen::AngleAxisd turn(drift.turn_rad, Eigen::Vector3d::UnitZ());
      const auto placed = [&](const Eigen::Vector3d& p) {
        return Eigen::Vector3d(kOrigin + turn * p + up);
      };
      for (const Eigen::Vector3d& p : scan_from(x, change, random))
        points.push_back({placed(p), 0, number, 0.02F, 0.02F});
      const Eigen::Vector3d at = placed({x, 0.0, 0.0});
      scans.features.push_back(
          {{at}, {std::int64_t{number}, at.z() + 0.6, 0.005, 0.001, 0.005}, ""});
    }
    const LasPoints all = [&points](const std::function<void(const LasPoint&)>& visit) {
      for (const LasPoint& point : points) visit(point);
    };
    write_las(all, "LOCAL_CS[\"mine\"]", folder / "cloud.las");
    write_geopackage({scans}, local_crs_wkt(crs, "shaft 1"), folder / "survey.gpkg");
    return folder;
  }

  CompareResult compare(const fs::path& older, const fs::path& newer, bool by_coordinates = false) {
    return compare_surveys({older, newer, folder_ / "change", by_coordinates});
  }

  const Eigen::Vector3d kOrigin{1000.0, 2000.0, 50.0};
  test::ScratchFolder folder_;
};

/// A cavity in the roof around x = 6: 0.5 m³ in all.
double fall(int surface, const Eigen::Vector3d& p) {
  constexpr double kRadiusM = 0.8;
  constexpr double kDepthM = 0.497;  // paraboloid: volume is half of base times depth
  const double r = std::hypot(p.x() - 6.0, p.y()) / kRadiusM;
  return surface == 1 && r < 1.0 ? -kDepthM * (1.0 - r * r) : 0.0;
}

/// The left wall has moved in by 0.1 m from x = 9 to 12.
double moved_wall(int surface, const Eigen::Vector3d& p) {
  return surface == 2 && p.x() > 9.0 && p.x() < 12.0 ? 0.1 : 0.0;
}

TEST_F(CompareSurveys, FindNoChangeInAnUnchangedMine) {
  const CompareResult result = compare(survey("a", 1), survey("b", 2));
  EXPECT_GT(result.area_m2, 130.0);
  EXPECT_LT(result.significant_m2, 0.05 * result.area_m2);
  EXPECT_TRUE(result.regions.empty());
  EXPECT_EQ(result.registered, result.scans);
}

TEST_F(CompareSurveys, FindAFallOfHalfACubicMetre) {
  const CompareResult result = compare(survey("a", 1), survey("b", 2, fall));
  ASSERT_EQ(result.regions.size(), 1U);
  const ChangeRegion& region = result.regions.front();
  EXPECT_EQ(region.kind, SurfaceKind::kRoof);
  EXPECT_TRUE(region.rock_gone);
  EXPECT_NEAR(region.volume_m3, -0.5, 0.1);  // cylinders smooth the rim
  EXPECT_NEAR(result.origin.x() + region.p.x(), 1006.0, 0.2);
  EXPECT_NEAR(region.most_m, -0.497, 0.06);
}

TEST_F(CompareSurveys, FindAWallMovedByADecimetre) {
  const CompareResult result = compare(survey("a", 1), survey("b", 2, moved_wall));
  ASSERT_EQ(result.regions.size(), 1U);
  const ChangeRegion& region = result.regions.front();
  EXPECT_EQ(region.kind, SurfaceKind::kWall);
  EXPECT_FALSE(region.rock_gone);
  EXPECT_NEAR(region.mean_m, 0.1, 0.02);
  EXPECT_NEAR(region.area_m2, 3.0 * (kHeightM - 0.3), 1.2);
}

TEST_F(CompareSurveys, TakeOutTheDriftOfAMission) {
  const Drift drift{.turn_rad = 0.006, .up_m = 0.08};
  const CompareResult registered = compare(survey("a", 1), survey("b", 2, fall, drift));
  ASSERT_EQ(registered.regions.size(), 1U);
  EXPECT_NEAR(registered.regions.front().volume_m3, -0.5, 0.1);
  // By the coordinates the stated 2 cm do not cover 8 cm: that is change, or an error of theirs.
  const CompareResult by_coordinates = compare(folder_ / "a", folder_ / "b", true);
  EXPECT_GT(by_coordinates.significant_m2, registered.significant_m2);
  EXPECT_GT(by_coordinates.detection_median_m, registered.detection_median_m);
}

TEST_F(CompareSurveys, WriteTheirFiles) {
  compare(survey("a", 1), survey("b", 2, fall));
  for (const char* name : {"change.tif", "change.gpkg", "change.pdf", "changes.csv"})
    EXPECT_GT(test::contents(folder_ / "change" / name).size(), 100U) << name;
  EXPECT_THAT(test::contents(folder_ / "change" / "changes.csv"), HasSubstr(",roof,"));
}

TEST_F(CompareSurveys, RejectWhatCannotBeCompared) {
  const fs::path a = survey("a", 1);
  EXPECT_THROW(compare(a, survey("other", 1, no_change, {}, "another mine")), std::runtime_error);
  EXPECT_THROW(compare(a, folder_ / "none"), FileError);
  const fs::path cut = survey("cut", 2);
  fs::resize_file(cut / "cloud.las", 5000);
  EXPECT_THROW(compare(a, cut), FileError);
  write_text_file("LASF", cut / "cloud.las");
  EXPECT_THROW(compare(a, cut), FileError);
  EXPECT_FALSE(fs::exists(folder_ / "change"));
}

}  // namespace
}  // namespace adit
