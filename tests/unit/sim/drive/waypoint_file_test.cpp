// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/drive/waypoint_file.hpp"

#include <fstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using testing::ElementsAre;

class WaypointFile : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& text) {
    std::ofstream(folder_ / "drive.txt") << text;
    return folder_ / "drive.txt";
  }

  /// The message, without the folder.
  std::string error_of(const std::string& text) {
    try {
      read_waypoints(file(text));
    } catch (const std::runtime_error& error) {
      const std::string message = error.what();
      return message.substr(message.find("drive.txt"));
    }
    return "no error";
  }

  test::ScratchFolder folder_;
};

TEST_F(WaypointFile, HasPointsSpeedsAndComments) {
  const auto waypoints =
      read_waypoints(file("# round the pillar\n1 2\n\n-3.5\t4e0 0.2  # slow\r\n"));
  EXPECT_THAT(waypoints,
              ElementsAre(Waypoint{{1.0, 2.0}, std::nullopt}, Waypoint{{-3.5, 4.0}, 0.2}));
}

TEST_F(WaypointFile, ReportsTheInvalidLine) {
  EXPECT_EQ(error_of("1 2\n3\n"), "drive.txt:2: expected 'x y' or 'x y speed'");
  EXPECT_EQ(error_of("1 2 0.3 4\n"), "drive.txt:1: expected 'x y' or 'x y speed'");
  EXPECT_EQ(error_of("#\n\n1 2m\n"), "drive.txt:3: '2m' is not a number");
  EXPECT_EQ(error_of("nan 2\n"), "drive.txt:1: 'nan' is not a number");
  EXPECT_EQ(error_of("1 2 0\n"), "drive.txt:1: the speed must be above 0");
}

TEST_F(WaypointFile, MustExistAndHaveWaypoints) {
  EXPECT_EQ(error_of("# nothing yet\n"), "drive.txt: no waypoint");
  EXPECT_THROW(read_waypoints(folder_ / "none.txt"), std::runtime_error);
  EXPECT_THROW(read_waypoints(folder_.path()), std::runtime_error);
}

}  // namespace
}  // namespace adit
