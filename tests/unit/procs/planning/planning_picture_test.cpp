// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/planning/planning_picture.hpp"

#include <filesystem>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tests/support/worlds/terrain_scenes.hpp"

namespace adit {
namespace {

struct DrawnPlan {
  explicit DrawnPlan(const TerrainMap& terrain_map) : terrain(terrain_map) {
    path = planning.plan(terrain, PlanGoal{}, {});
    picture = planning_picture(path.reason, terrain, path, planning, Vehicle{}, {0.0, 0.5});
  }

  TerrainMap terrain;
  Planning planning{PlanningParams{}};
  PlannedPath path;
  PlanPicture picture;
};

TEST(PlanningPicture, HasSlicesOfTheSizeOfTheTerrainAndKernels) {
  const DrawnPlan drawn(terrain_of(random_corridor(4)));
  ASSERT_EQ(drawn.picture.slices.size(), 2U);
  for (const GreyCells& slice : drawn.picture.slices) {
    EXPECT_EQ(slice.grey.box(), drawn.terrain.cells.box());
  }
  EXPECT_EQ(drawn.picture.kernels.size(), 8U);
}

TEST(PlanningPicture, IsDrawnWithAPathAndWithoutOne) {
  const test::ScratchFolder folder;
  TerrainMap blocked = terrain_of(CorridorScene{});
  paint_box(blocked, obstacle_cell(0.6), {2.8, -2.0}, {3.0, 2.0});
  write_plan_png(DrawnPlan(terrain_of(random_corridor(4))).picture, folder.path() / "found.png");
  write_plan_png(DrawnPlan(blocked).picture, folder.path() / "blocked.png");
  for (const char* name : {"found.png", "blocked.png"}) {
    EXPECT_GT(std::filesystem::file_size(folder.path() / name), 1000U);  // not empty
  }
}

TEST(PlanningPicture, ThrowsWhereItCannotBeWritten) {
  const DrawnPlan drawn(terrain_of(CorridorScene{}));
  EXPECT_THROW(write_plan_png(drawn.picture, "/nowhere/plan.png"), std::runtime_error);
}

}  // namespace
}  // namespace adit
