// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/exploration_picture.hpp"

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/support/robots/exploring_robot.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/exploration/test_mines.hpp"

namespace adit {
namespace {

using PictureCell = ExplorationPicture::Cell;

ExplorationPicture picture_of_a_junction() {
  Exploration exploration{ExplorationParams{}};
  const auto mine = tunnel_mine(junction());
  const auto run = test::run_exploration(mine, exploration, 2000.0);
  return exploration_picture("a junction", exploration, run.path_map);
}

TEST(ExplorationPicture, ContainsTheObservedSpace) {
  const ExplorationPicture picture = picture_of_a_junction();
  ASSERT_GT(picture.columns, 0);
  EXPECT_EQ(picture.cells.size() % static_cast<std::size_t>(picture.columns), 0U);
  const auto drivable =
      std::count(picture.cells.begin(), picture.cells.end(), PictureCell::kDrivable);
  // 62 m of tunnels, 3 m wide, less half the width of the vehicle at each wall and at the ends.
  EXPECT_NEAR(static_cast<double>(drivable) * picture.cell_m * picture.cell_m, 62.0 * 1.9, 15.0);
  EXPECT_FALSE(picture.report.frontiers.empty());
  EXPECT_FALSE(picture.traversed_path.empty());
}

TEST(ExplorationPicture, DrawsAFullAndAnEmptyPicture) {
  const test::ScratchFolder folder;
  write_exploration_png(picture_of_a_junction(), folder.path() / "junction.png");
  write_exploration_png({}, folder.path() / "nothing.png");
  EXPECT_GT(std::filesystem::file_size(folder.path() / "junction.png"), 3000U);
  EXPECT_GT(std::filesystem::file_size(folder.path() / "nothing.png"), 100U);
}

TEST(ExplorationPicture, NamesTheFileThatItCannotWrite) {
  EXPECT_THROW(write_exploration_png({}, "/nowhere/at/all.png"), std::runtime_error);
}

}  // namespace
}  // namespace adit
