// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/survey/files/las_file.hpp"

#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

LasPoints points_of(const std::vector<LasPoint>& points) {
  return [points](const std::function<void(const LasPoint&)>& visit) {
    for (const LasPoint& point : points) visit(point);
  };
}

/// A number at its place in the specification.
template <class T>
T at(const std::string& bytes, std::size_t offset) {
  T value{};
  std::memcpy(&value, bytes.data() + offset, sizeof value);
  return value;
}

class LasFile : public testing::Test {
 protected:
  std::string write(const std::vector<LasPoint>& points) {
    write_las(points_of(points), "LOCAL_CS[\"mine\"]", folder_ / "cloud.las");
    return test::contents(folder_ / "cloud.las");
  }

  test::ScratchFolder folder_;
  const LasPoint a_{{500000.1234, 5600000.5, -12.3456}, 1'600'000'000'250'000, 7, 0.02F, 0.03F};
  const LasPoint b_{{500010.0, 5600001.0, -10.0}, 1'600'000'001'000'000, 70'000, 0.5F, 0.25F};
};

// Offsets: LAS specification 1.4 - R15, table 3.
TEST_F(LasFile, HasTheHeaderOfVersion14) {
  const std::string las = write({a_, b_});
  EXPECT_EQ(las.substr(0, 4), "LASF");
  EXPECT_EQ(at<std::uint16_t>(las, 6), 0b10001);  // standard GPS time, WKT
  EXPECT_EQ(las[24], 1);
  EXPECT_EQ(las[25], 4);
  EXPECT_EQ(at<std::uint16_t>(las, 90), 257);  // 2020-09-13, day of the year
  EXPECT_EQ(at<std::uint16_t>(las, 92), 2020);
  EXPECT_EQ(at<std::uint16_t>(las, 94), 375);
  EXPECT_EQ(las[104], 6);
  EXPECT_EQ(at<std::uint16_t>(las, 105), 42);
  EXPECT_EQ(at<std::uint64_t>(las, 247), 2U);
  EXPECT_EQ(at<std::uint64_t>(las, 255), 2U);
  EXPECT_NEAR(at<double>(las, 179), 500010.0, 1e-9);    // max x
  EXPECT_NEAR(at<double>(las, 187), 500000.123, 1e-9);  // min x
  EXPECT_NEAR(at<double>(las, 219), -12.346, 1e-9);     // min z
  const auto data = at<std::uint32_t>(las, 96);
  EXPECT_EQ(las.size(), data + 2U * 42U);
}

TEST_F(LasFile, StoresMillimetresTimeScanAndDeviations) {
  const std::string las = write({a_, b_});
  const std::size_t second = at<std::uint32_t>(las, 96) + 42;
  const auto x = at<double>(las, 131) * at<std::int32_t>(las, second) + at<double>(las, 155);
  const auto z = at<double>(las, 147) * at<std::int32_t>(las, second + 8) + at<double>(las, 171);
  EXPECT_NEAR(x, 500010.0, 1e-6);
  EXPECT_NEAR(z, -10.0, 1e-6);
  EXPECT_EQ(las[second + 14], 0x11);
  EXPECT_EQ(at<std::uint16_t>(las, second + 20), 65535);  // as far as a point source counts
  EXPECT_NEAR(at<double>(las, second + 22), 284035219.0, 1e-6);
  EXPECT_EQ(at<std::uint32_t>(las, second + 30), 70'000U);
  EXPECT_EQ(at<float>(las, second + 34), 0.5F);
  EXPECT_EQ(at<float>(las, second + 38), 0.25F);
}

TEST_F(LasFile, DescribesItsExtraBytesAndCoordinateSystem) {
  const std::string las = write({a_});
  EXPECT_THAT(las, HasSubstr("LASF_Projection"));
  EXPECT_THAT(las, HasSubstr("LOCAL_CS[\"mine\"]"));
  EXPECT_THAT(las, HasSubstr("sd_plan"));
  EXPECT_THAT(las, HasSubstr("sd_z"));
}

TEST_F(LasFile, MayBeEmpty) {
  const std::string las = write({});
  EXPECT_EQ(at<std::uint64_t>(las, 247), 0U);
  EXPECT_EQ(las.size(), at<std::uint32_t>(las, 96));
}

TEST_F(LasFile, RejectsPointsThatWholeMillimetresCannotHold) {
  LasPoint far = a_;
  far.p.x() += 3e6;
  EXPECT_THROW(write({a_, far}), std::runtime_error);
}

TEST(GpsTime, CountsLeapSeconds) {
  EXPECT_DOUBLE_EQ(adjusted_gps_time(315'964'800'000'000), -1e9);           // the epoch of GPS
  EXPECT_DOUBLE_EQ(adjusted_gps_time(1'483'228'800'000'000), 167264018.0);  // 2017-01-01, 18 s
  EXPECT_DOUBLE_EQ(adjusted_gps_time(1'483'228'799'000'000), 167264016.0);  // 17 s, one second less
}

}  // namespace
}  // namespace adit
