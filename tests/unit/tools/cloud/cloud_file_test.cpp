// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/cloud/cloud_file.hpp"

#include <filesystem>
#include <fstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/unit/tools/cloud/cloud_bytes.hpp"

namespace adit {
namespace {

using test::some_points;
using testing::AllOf;
using testing::HasSubstr;

class CloudFile : public testing::Test {
 protected:
  std::filesystem::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

  std::string rejection(const std::filesystem::path& file) {
    try {
      (void)read_cloud_file(file);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

  test::ScratchFolder folder_;
};

TEST_F(CloudFile, IsIdentifiedByExtensionOrFirstBytes) {
  const std::string ply = test::ply<float>("binary_little_endian", "float", some_points());
  const std::string pcd = test::pcd<float>("binary", 'F', some_points());
  for (const auto& file :
       {write("a.ply", ply), write("b.PLY", ply), write("c", ply), write("d.pcd", pcd),
        write("e.bin", pcd), write("f.xyz", test::as_text(some_points())),
        write("g.csv", test::as_text(some_points()))}) {
    EXPECT_EQ(read_cloud_file(file).points, some_points()) << file;
  }
}

TEST_F(CloudFile, ErrorsNameTheFile) {
  EXPECT_THAT(rejection(folder_ / "none.ply"), HasSubstr("none.ply"));
  EXPECT_THAT(rejection(folder_.path()), HasSubstr("directory"));
  EXPECT_THAT(rejection(write("empty.ply", "")),
              AllOf(HasSubstr("empty.ply"), HasSubstr("file is empty")));
  EXPECT_THAT(rejection(write("photo.jpg", "\xff\xd8\xff")), HasSubstr("PLY, PCD and XYZ"));
  EXPECT_THAT(rejection(write("none.xyz", "# nothing\n")), HasSubstr("no points"));
  EXPECT_THAT(rejection(write("nan.xyz", "nan 0 0\n")), HasSubstr("no valid point"));
  EXPECT_THAT(rejection(write("utm.xyz", "610000 5410000 300\n")), HasSubstr("100 km"));
  EXPECT_THAT(rejection(write("bad.xyz", "1 2 3\n1 2\n")), HasSubstr("bad.xyz: line 2: "));
}

TEST_F(CloudFile, RoundTripsPlyExactly) {
  Cloud cloud;
  cloud.lines.resize(2);
  cloud.lines[0].points = {{0.1F, -2.5F, 1e-7F}, {1.0F / 3.0F, 0.0F, -0.0F}};
  cloud.lines[1].points = {{7.0F, 8.0F, 9.0F}};
  write_ply(cloud, folder_ / "cloud.ply");
  const PointCloud read = read_cloud_file(folder_ / "cloud.ply");
  ASSERT_EQ(read.points.size(), 3U);
  EXPECT_EQ(read.points[0].cast<float>(), cloud.lines[0].points[0]);
  EXPECT_EQ(read.points[1].cast<float>(), cloud.lines[0].points[1]);
  EXPECT_EQ(read.points[2].cast<float>(), cloud.lines[1].points[0]);
}

TEST(PointCloud, RejectsTooManyPointsBeforeAllocation) {
  PointCloud cloud;
  EXPECT_THROW(cloud.reserve(PointCloud::kPointsMax + 1), std::runtime_error);
  EXPECT_EQ(cloud.points.capacity(), 0U);
}

}  // namespace
}  // namespace adit
