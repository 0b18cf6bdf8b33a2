// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/grid/map_server.hpp"

#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using test::contents;

class MapServer : public testing::Test {
 protected:
  test::ScratchFolder scratch_;
  std::filesystem::path folder_ = scratch_.path();
};

TEST_F(MapServer, WritesShadesFromTheHighestRowDown) {
  OccupancyGridParams params;
  params.resolution_m = 1.0;
  OccupancyGrid grid(params);
  ASSERT_TRUE(grid.insert({0, {2.0F}, 0.0, 0.1}, {-3.5, 7.5, 1.57079632679}));  // upwards
  write_map_server(grid, folder_, "map");
  EXPECT_EQ(contents(folder_ / "map.pgm"),
            "P5\n3 5\n255\n"
            "\xCD\xCD\xCD"
            "\xCD" +
                std::string(1, '\0') +
                "\xCD"
                "\xCD\xFE\xCD"
                "\xCD\xFE\xCD"
                "\xCD\xCD\xCD");
  EXPECT_EQ(contents(folder_ / "map.yaml"),
            "image: map.pgm\nmode: trinary\nresolution: 1.000000\n"
            "origin: [-5.000000, 6.000000, 0.0]\n"
            "negate: 0\noccupied_thresh: 0.65\nfree_thresh: 0.196\n");
}

TEST_F(MapServer, AnEmptyMapIsStillAMap) {
  write_map_server(OccupancyGrid({}), folder_, "map");
  EXPECT_EQ(contents(folder_ / "map.pgm"), "P5\n2 2\n255\n\xCD\xCD\xCD\xCD");
}

TEST_F(MapServer, SaysWhatItCannotWrite) {
  EXPECT_THROW(write_map_server(OccupancyGrid({}), folder_ / "missing", "map"), std::runtime_error);
}

}  // namespace
}  // namespace adit
