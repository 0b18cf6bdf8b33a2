// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/ros/messages/ros_messages.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/geometry/pose2.hpp"
#include "tests/support/bags/ros1_bag_writer.hpp"
#include "tools/export/ros2/cdr_writer.hpp"
#include "tools/ros/messages/ros_fields.hpp"

namespace adit {
namespace {

using testing::ElementsAre;

constexpr std::int64_t kUtime = 1'700'000'000'123'456;

RosMessage of(const std::string& bytes, const char* encoding) {
  return {{reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, encoding};
}

/// The fields of a message in either encoding, from one description.
class RosWriter {
 public:
  explicit RosWriter(bool cdr) : cdr_(cdr) {}

  RosWriter& u8(std::uint8_t value) {
    return cdr_ ? (two_.u8(value), *this) : (one_.u8(value), *this);
  }
  RosWriter& u32(std::size_t value) {
    return cdr_ ? (two_.u32(value), *this) : (one_.u32(value), *this);
  }
  RosWriter& f32(float value) { return cdr_ ? (two_.f32(value), *this) : (one_.f32(value), *this); }
  RosWriter& f64(double value) {
    return cdr_ ? (two_.f64(value), *this) : (one_.f64(value), *this);
  }
  RosWriter& text(const char* value) {
    return cdr_ ? (two_.text(value), *this) : (one_.text(value), *this);
  }
  RosWriter& header(const char* frame) {
    return cdr_ ? (two_.header(kUtime, frame), *this) : (one_.header(kUtime, frame), *this);
  }
  RosWriter& numbers(const std::vector<double>& values) {
    for (const double value : values) f64(value);
    return *this;
  }
  RosWriter& zeros(int count) {
    return numbers(std::vector<double>(static_cast<std::size_t>(count)));
  }

  [[nodiscard]] const std::string& bytes() const { return cdr_ ? two_.bytes() : one_.bytes(); }
  [[nodiscard]] RosMessage message() const { return of(bytes(), cdr_ ? "cdr" : "ros1"); }

 private:
  bool cdr_;
  test::Ros1Bytes one_;
  CdrWriter two_;
};

class RosMessages : public testing::TestWithParam<bool> {
 protected:
  RosWriter writer_{GetParam()};
};

TEST_P(RosMessages, ReadALaserScan) {
  writer_.header("laser").f32(-1.0F).f32(1.0F).f32(0.5F).f32(0.0F).f32(0.1F).f32(0.2F).f32(30.0F);
  writer_.u32(5);
  for (const float range : {1.0F, 2.0F, 3.0F, 4.0F, 5.0F}) writer_.f32(range);
  writer_.u32(0);
  const auto scan = ros_laser_scan(writer_.message());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->utime, kUtime);
  EXPECT_EQ(scan->frame, "laser");
  EXPECT_EQ(scan->angle_min_rad, -1.0);
  EXPECT_EQ(scan->angle_step_rad, 0.5);
  EXPECT_FLOAT_EQ(static_cast<float>(scan->range_min_m), 0.2F);
  EXPECT_FLOAT_EQ(static_cast<float>(scan->range_max_m), 30.0F);
  EXPECT_THAT(scan->ranges_m, ElementsAre(1.0F, 2.0F, 3.0F, 4.0F, 5.0F));
}

TEST_P(RosMessages, ReadTheFirstEchoes) {
  writer_.header("/laser").f32(0.0F).f32(1.0F).f32(0.5F).f32(0.0F).f32(0.1F).f32(0.2F).f32(30.0F);
  writer_.u32(3).u32(2).f32(1.5F).f32(2.5F).u32(0).u32(1).f32(3.5F).u32(0);
  const auto scan = ros_multi_echo_laser_scan(writer_.message());
  ASSERT_TRUE(scan);
  EXPECT_EQ(scan->frame, "laser");  // tf2 knows no slash
  EXPECT_THAT(scan->ranges_m, ElementsAre(1.5F, std::numeric_limits<float>::infinity(), 3.5F));
}

TEST_P(RosMessages, ReadOdometry) {
  const double half = 0.5 * 0.3;
  writer_.header("odom").text("base_link").numbers({1.0, 2.0, 0.5});
  writer_.numbers({0.0, 0.0, std::sin(half), std::cos(half)}).zeros(36 + 6 + 36);
  const auto reading = ros_odometry(writer_.message());
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->child_frame, "base_link");
  EXPECT_NEAR(in_plan(reading->T_frame_child).theta, 0.3, 1e-12);
  EXPECT_EQ(reading->T_frame_child.translation(), Eigen::Vector3d(1.0, 2.0, 0.5));
}

TEST_P(RosMessages, RejectARotationThatIsNone) {
  writer_.header("odom").text("base_link").zeros(3 + 4 + 36 + 6 + 36);
  EXPECT_FALSE(ros_odometry(writer_.message()));
}

TEST_P(RosMessages, ReadAnImu) {
  writer_.header("imu")
      .zeros(4 + 9)
      .numbers({0.1, 0.2, 0.3})
      .zeros(9)
      .numbers({1.0, 2.0, 9.8})
      .zeros(9);
  const auto reading = ros_imu(writer_.message());
  ASSERT_TRUE(reading);
  EXPECT_EQ(reading->angular_velocity, Eigen::Vector3d(0.1, 0.2, 0.3));
  EXPECT_EQ(reading->linear_acceleration, Eigen::Vector3d(1.0, 2.0, 9.8));
}

TEST_P(RosMessages, ReadTransforms) {
  writer_.u32(2);
  writer_.header("a").text("bc").numbers({1.0, 2.0, 3.0, 0.0, 0.0, 0.0, 1.0});
  writer_.header("bc").text("def").numbers({4.0, 5.0, 6.0, 0.0, 0.0, 1.0, 0.0});
  const auto transforms = ros_transforms(writer_.message());
  ASSERT_TRUE(transforms);
  ASSERT_EQ(transforms->size(), 2U);
  EXPECT_EQ((*transforms)[1].parent, "bc");
  EXPECT_EQ((*transforms)[1].child, "def");
  EXPECT_EQ((*transforms)[1].T_parent_child.translation(), Eigen::Vector3d(4.0, 5.0, 6.0));
  EXPECT_NEAR(std::abs(in_plan((*transforms)[1].T_parent_child).theta), std::numbers::pi, 1e-12);
}

/// Two rows of two points with a field between the coordinates and padding behind a row; one point
/// is not finite.
TEST_P(RosMessages, ReadAPointCloud) {
  writer_.header("velodyne").u32(2).u32(2).u32(4);
  writer_.text("x").u32(0).u8(7).u32(1).text("intensity").u32(4).u8(7).u32(1);
  writer_.text("y").u32(8).u8(7).u32(1).text("z").u32(12).u8(8).u32(1);
  writer_.u8(0).u32(20).u32(44).u32(88);
  std::string data;
  int i = 0;
  for (int row = 0; row < 2; ++row) {
    for (int column = 0; column < 2; ++column, ++i) {
      const float x = i == 2 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(i);
      append_little_endian(data, std::bit_cast<std::uint32_t>(x), 4);
      append_little_endian(data, std::uint32_t{0}, 4);
      append_little_endian(data, std::bit_cast<std::uint32_t>(10.0F), 4);
      append_little_endian(data, std::bit_cast<std::uint64_t>(0.25), 8);
    }
    data += "pad.";
  }
  for (const char c : data) writer_.u8(static_cast<std::uint8_t>(c));
  writer_.u8(1);
  const auto cloud = ros_point_cloud(writer_.message());
  ASSERT_TRUE(cloud);
  EXPECT_THAT(cloud->points,
              ElementsAre(Eigen::Vector3f(0.0F, 10.0F, 0.25F), Eigen::Vector3f(1.0F, 10.0F, 0.25F),
                          Eigen::Vector3f(3.0F, 10.0F, 0.25F)));
}

TEST_P(RosMessages, RejectEveryTruncation) {
  writer_.header("laser").f32(0.0F).f32(1.0F).f32(0.5F).f32(0.0F).f32(0.1F).f32(0.2F).f32(30.0F);
  writer_.u32(2).f32(1.0F).f32(2.0F);
  const std::string whole = writer_.bytes();
  const char* const encoding = GetParam() ? "cdr" : "ros1";
  EXPECT_TRUE(ros_laser_scan(of(whole, encoding)));
  for (std::size_t size = 0; size < whole.size(); ++size)
    EXPECT_FALSE(ros_laser_scan(of(whole.substr(0, size), encoding))) << size;
}

INSTANTIATE_TEST_SUITE_P(Encodings, RosMessages, testing::Bool(), [](const auto& suite) {
  return std::string(suite.param ? "Cdr" : "Ros1");
});

/// OMG DDSI-RTPS: 0x0000 is big-endian.
TEST(RosFields, ReadBigEndianCdr) {
  const std::string bytes(
      "\0\0\0\0"          // representation
      "\x65\x53\xF1\x00"  // 1 700 000 000 s
      "\0\0\x03\xE8"      // 1000 ns
      "\0\0\0\x02"
      "a\0"
      "\0\0"  // alignment
      "\x3F\x80\0\0",
      24);
  const RosMessage message = of(bytes, "cdr");
  RosFields fields(message.bytes, message.encoding);
  const RosFields::Header header = fields.header();
  EXPECT_EQ(header.utime, 1'700'000'000'000'001);
  EXPECT_EQ(header.frame, "a");
  EXPECT_EQ(fields.f32(), 1.0);
  EXPECT_TRUE(fields.ok());
  EXPECT_FALSE(RosFields(message.bytes, "protobuf").ok());
}

}  // namespace
}  // namespace adit
