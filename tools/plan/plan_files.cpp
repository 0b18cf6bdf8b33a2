// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/plan/plan_files.hpp"

#include <numbers>

#include "common/files/text_file.hpp"
#include "common/picture/cloud_picture.hpp"
#include "common/picture/terrain_picture.hpp"
#include "procs/planning/planning_picture.hpp"
#include "tools/plan/path_json.hpp"
#include "tools/plan/plan_facts.hpp"

namespace adit {
namespace {

constexpr int kSlices = 8;  // over half a turn, after which they are the same again
constexpr int kScanWidth = 708;
constexpr int kScanHeight = 400;

std::vector<double> slice_angles() {
  std::vector<double> angles;
  for (int i = 0; i < kSlices; ++i) angles.push_back(i * std::numbers::pi / kSlices);
  return angles;
}

}  // namespace

void write_plan_files(const std::string& title, const Cloud& cloud, const ScanPlan& plan,
                      const Planning& planning, const Vehicle& vehicle,
                      const std::filesystem::path& folder) {
  PlanPicture picture =
      planning_picture(title, plan.terrain, plan.path, planning, vehicle, slice_angles());
  picture.goal = plan.goal;
  picture.facts = plan_facts(cloud, plan);
  picture.scan = cloud_image(cloud, kScanWidth, kScanHeight);
  write_terrain_png(plan.terrain, folder / "terrain.png");
  write_terrain_png(plan.terrain, folder / "clearance.png", TerrainLayer::kClearance);
  write_terrain_png(plan.terrain, folder / "unknown.png", TerrainLayer::kKnowledge);
  write_slices_png(picture, folder / "c_space.png");
  write_kernels_png(picture, folder / "kernels.png");
  write_path_png(picture, folder / "plan.png");
  write_plan_png(picture, folder / "sheet.png");
  write_text(path_json(cloud, plan), folder / "path.json");
}

}  // namespace adit
