// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The readers on small files of every format, intact and damaged.
#include <functional>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/tools/cloud/cloud_bytes.hpp"
#include "tools/cloud/cloud_file.hpp"

namespace adit {
namespace {

using test::bytes_of;
using test::encoded;
using test::Points;
using test::some_points;
using testing::HasSubstr;
using testing::StartsWith;

using Reader = PointCloud (*)(std::span<const std::uint8_t>);

struct Sample {
  Reader read;
  std::string text;
};

/// One sample per format and type.
std::vector<Sample> samples() {
  const Points points = some_points();
  std::vector<Sample> all;
  all.push_back({read_ply, test::ply<float>("ascii", "float", points)});
  for (const char* format : {"binary_little_endian", "binary_big_endian"}) {
    all.push_back({read_ply, test::ply<float>(format, "float", points)});
    all.push_back({read_ply, test::ply<double>(format, "float64", points)});
    all.push_back({read_ply, test::ply<std::int8_t>(format, "char", points)});
    all.push_back({read_ply, test::ply<std::int16_t>(format, "int16", points)});
    all.push_back({read_ply, test::ply<std::int32_t>(format, "int", points)});
  }
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    all.push_back({read_pcd, test::pcd<float>(data, 'F', points)});
    all.push_back({read_pcd, test::pcd<double>(data, 'F', points)});
    all.push_back({read_pcd, test::pcd<std::int8_t>(data, 'I', points)});
    all.push_back({read_pcd, test::pcd<std::int64_t>(data, 'I', points)});
  }
  all.push_back({read_xyz, test::as_text(points)});
  return all;
}

std::string rejection(Reader read, const std::string& text) {
  try {
    (void)read(bytes_of(text));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(CloudReaders, ReadEveryFormat) {
  for (const Sample& sample : samples()) {
    const PointCloud cloud = sample.read(bytes_of(sample.text));
    EXPECT_EQ(cloud.points, some_points()) << sample.text;
    EXPECT_EQ(cloud.skipped, 0U);
  }
}

/// A truncated text file is valid if complete lines or the end of a number are missing.
TEST(CloudReaders, RejectTruncatedFiles) {
  for (const Sample& sample : samples()) {
    const bool is_text = sample.read == read_xyz || sample.text.find("ascii") != std::string::npos;
    for (std::size_t size = 0; size < sample.text.size(); ++size) {
      const std::string text = sample.text.substr(0, size);
      const std::string why = rejection(sample.read, text);
      if (!is_text) {
        EXPECT_THAT(why, testing::ContainsRegex("^(line|byte) [0-9]+: ")) << text;
      }
      EXPECT_EQ(why.find('\n'), std::string::npos);
    }
  }
}

TEST(CloudReaders, SkipAndCountInvalidPoints) {
  constexpr float kInfinity = std::numeric_limits<float>::infinity();
  const Points points{{1, 2, 3}, {std::nan(""), 0, 0}, {0, kInfinity, 0}, {0, 0, -2e5}, {4, 5, 6}};
  for (const auto& [read, text] :
       std::vector<Sample>{{read_ply, test::ply<float>("binary_big_endian", "float", points)},
                           {read_pcd, test::pcd<double>("binary_compressed", 'F', points)},
                           {read_ply, test::ply<float>("ascii", "float", points)},
                           {read_pcd, test::pcd<float>("ascii", 'F', points)},
                           {read_xyz, test::as_text(points)}}) {
    const PointCloud cloud = read(bytes_of(text));
    EXPECT_EQ(cloud.skipped, 3U);
    EXPECT_EQ(cloud.points, (Points{{1, 2, 3}, {4, 5, 6}}));
  }
}

TEST(PlyReader, IgnoresOtherElementsPropertiesAndLists) {
  const std::string head =
      "comment made by hand\nelement camera 2\nproperty list uchar short ids\nproperty double f\n"
      "element vertex 1\nproperty uchar red\nproperty float y\nproperty list int float weights\n"
      "property float x\nproperty float z\nelement face 1000000\nproperty list uchar int v\n"
      "end_header\n";
  const std::string ascii = "ply\r\nformat ascii 1.0\n" + head + "2 7 8 0.5\n0 1\n\n9 2 1 5 1 3\n";
  EXPECT_EQ(read_ply(bytes_of(ascii)).points, (Points{{1, 2, 3}}));
  std::string binary = "ply\nformat binary_little_endian 1.0\n" + head;
  binary += '\2' + encoded<std::int16_t>(7) + encoded<std::int16_t>(8) + encoded(0.5);
  binary += '\0' + encoded(1.0);
  binary += '\x09' + encoded(2.0F) + encoded<std::int32_t>(1) + encoded(5.0F);
  binary += encoded(1.0F) + encoded(3.0F);
  EXPECT_EQ(read_ply(bytes_of(binary)).points, (Points{{1, 2, 3}}));
}

std::string ply_head(const std::string& what, const std::string& format = "ascii") {
  return "ply\nformat " + format + " 1.0\n" + what + "\nend_header\n";
}

TEST(PlyReader, RejectsInvalidHeaders) {
  const std::string xyz = "\nproperty float x\nproperty float y\nproperty float z";
  const auto why = [](const std::string& text) { return rejection(read_ply, text); };
  for (const char* format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
    for (const char* count : {"1", "4000000000", "18446744073709551615"}) {
      const std::string text = ply_head("element vertex " + std::string(count) + xyz, format);
      EXPECT_THAT(why(text), HasSubstr("announces")) << text;
    }
  }
  EXPECT_THAT(why(ply_head("element vertex -1" + xyz)), HasSubstr("line 3: "));
  EXPECT_THAT(why(ply_head("element vertex 1\nproperty float x") + "1\n"),
              HasSubstr("without property y"));
  EXPECT_THAT(why(ply_head("element face 0\nproperty list uchar int v")), HasSubstr("vertex"));
  EXPECT_THAT(why(ply_head("property float x")), StartsWith("line 3: "));
  EXPECT_THAT(why(ply_head("element vertex 1\nproperty half x")), StartsWith("line 4: "));
  EXPECT_THAT(why(ply_head("element vertex 1\nproperty list float int x")),
              HasSubstr("floating-point length"));
  EXPECT_THAT(why(ply_head("element \x1b[2J 1" + xyz)), HasSubstr("valid name"));
  EXPECT_THAT(why(ply_head("", "binary")), StartsWith("line 2: "));
  EXPECT_THAT(why("ply\nelement vertex 0\nend_header\n"), HasSubstr("format"));
  EXPECT_THAT(why("solid box\n"), StartsWith("line 1: "));
}

TEST(PlyReader, RejectsListsLongerThanTheFile) {
  const std::string element =
      "element face 1\nproperty list int double v\nelement vertex 0"
      "\nproperty float x\nproperty float y\nproperty float z";
  for (const std::int32_t count : {-1, 1, 0x7fffffff}) {
    EXPECT_NE(rejection(read_ply, ply_head(element, "binary_little_endian") + encoded(count)), "");
    EXPECT_NE(rejection(read_ply, ply_head(element) + std::to_string(count) + "\n"), "");
  }
}

TEST(PcdReader, ReadsTheSensorPositionFromViewpoint) {
  const PointCloud cloud = read_pcd(bytes_of(test::pcd<float>("binary", 'F', some_points())));
  ASSERT_TRUE(cloud.sensor);
  EXPECT_EQ(*cloud.sensor, Eigen::Vector3d(1, 2, 3));
}

TEST(PcdReader, IgnoresOtherFieldsInAnyOrder) {
  const std::string head =
      "VERSION .7\nFIELDS rgb z n x y\nSIZE 4 4 2 8 4\nTYPE U F I F F\nCOUNT 1 1 3 1 1\n"
      "WIDTH 1\nHEIGHT 1\nPOINTS 1\nDATA ";
  EXPECT_EQ(read_pcd(bytes_of(head + "ascii\n255 3 7 8 9 1 2\n")).points, (Points{{1, 2, 3}}));
  const std::string row = encoded(255U) + encoded(3.0F) + "123456" + encoded(1.0) + encoded(2.0F);
  EXPECT_EQ(read_pcd(bytes_of(head + "binary\n" + row)).points, (Points{{1, 2, 3}}));
  EXPECT_EQ(read_pcd(bytes_of(head + "binary_compressed\n" + test::packed(row))).points,
            (Points{{1, 2, 3}}));
}

TEST(PcdReader, RejectsInvalidHeaders) {
  const auto why = [](const std::string& text) { return rejection(read_pcd, text); };
  for (const char* data : {"ascii", "binary", "binary_compressed"}) {
    EXPECT_NE(why(test::pcd_head(data, 'F', 4, 4'000'000'000)), "") << data;
  }
  std::string two = test::pcd<float>("binary", 'F', some_points());
  two.replace(two.find("WIDTH 4"), 7, "WIDTH 5");
  EXPECT_THAT(why(two), HasSubstr("POINTS is not WIDTH times HEIGHT"));
  EXPECT_THAT(why("FIELDS x y\nSIZE 4 4\nTYPE F F\nPOINTS 1\nDATA ascii\n1 2\n"),
              HasSubstr("field z missing"));
  EXPECT_THAT(why("FIELDS x y z\nSIZE 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n"),
              HasSubstr("inconsistent"));
  EXPECT_THAT(why("FIELDS x y z\nSIZE 4 4 3\nTYPE F F F\nPOINTS 1\nDATA ascii\n"),
              HasSubstr("unknown PCD type"));
  EXPECT_THAT(why("WIDTH 9999999999999\nHEIGHT 9999999999999\nFIELDS x y z\nSIZE 1 1 1\n"
                  "TYPE I I I\nDATA binary\n"),
              HasSubstr("overflows"));
  EXPECT_THAT(why("VIEWPOINT 0 0 nan 1 0 0 0\nDATA ascii\n"), HasSubstr("VIEWPOINT"));
}

TEST(XyzReader, AcceptsSeparatorsCommentsColumnNamesAndFurtherColumns) {
  const std::string text =
      "# a room\nx,y,z,intensity\r\n1,2,3,99\n\n-100.5;0.25;1e1\n// end\n\t4\t5\t6 red\n7 8 9";
  EXPECT_EQ(read_xyz(bytes_of(text)).points,
            (Points{{1, 2, 3}, {-100.5, 0.25, 10}, {4, 5, 6}, {7, 8, 9}}));
}

TEST(XyzReader, ReportsTheMalformedLine) {
  EXPECT_THAT(rejection(read_xyz, "1 2 3\n\n1 2\n"), StartsWith("line 3: "));
  EXPECT_THAT(rejection(read_xyz, "1 2 3\nx y z\n"), StartsWith("line 2: "));
  EXPECT_THAT(rejection(read_xyz, "%PDF-1.4\n"), StartsWith("line 1: "));
}

/// A binary_compressed PCD file of `points` points with these compressed data.
std::string compressed_pcd(std::size_t points, std::uint32_t size, const std::string& data) {
  return test::pcd_head("binary_compressed", 'U', 1, points) +
         encoded(static_cast<std::uint32_t>(data.size())) + encoded(size) + data;
}

TEST(PcdReader, DecompressesOverlappingReferences) {
  const std::string repeated = std::string("\2abc", 4) + std::string("\x80\2", 2);  // abcabcabc
  EXPECT_EQ(read_pcd(bytes_of(compressed_pcd(3, 9, repeated))).points,
            (Points{{97, 97, 97}, {98, 98, 98}, {99, 99, 99}}));
  const std::string longest = std::string("\0z", 2) + std::string("\xe0\xff\0", 3);  // 265 z
  const std::string z = std::string("\x01zz", 3);
  EXPECT_EQ(read_pcd(bytes_of(compressed_pcd(89, 267, longest + z))).points,
            Points(89, Eigen::Vector3d(122, 122, 122)));
  EXPECT_TRUE(read_pcd(bytes_of(compressed_pcd(0, 0, ""))).points.empty());
}

TEST(PcdReader, RejectsDamagedCompressedData) {
  const std::string good = std::string("\2abc", 4) + std::string("\x80\2", 2);
  const auto why = [](std::size_t points, std::uint32_t size, const std::string& data) {
    return rejection(read_pcd, compressed_pcd(points, size, data));
  };
  for (std::size_t size = 0; size < good.size(); ++size) {
    EXPECT_THAT(why(3, 9, good.substr(0, size)), HasSubstr("damaged")) << size;
  }
  EXPECT_THAT(why(2, 6, good), HasSubstr("damaged"));
  EXPECT_THAT(why(4, 12, good), HasSubstr("damaged"));
  EXPECT_THAT(why(0, 0, good), HasSubstr("damaged"));
  EXPECT_THAT(why(1'000'000'000, 3'000'000'000, good), HasSubstr("damaged"));
  EXPECT_THAT(why(3, 8, good), HasSubstr("does not match POINTS"));
  EXPECT_THAT(why(1, 3, std::string("\x20\5", 2)),
              HasSubstr("damaged"));  // refers before the start
}

}  // namespace
}  // namespace adit
