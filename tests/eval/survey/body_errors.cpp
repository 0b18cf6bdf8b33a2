// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/eval/survey/body_errors.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <Eigen/Geometry>

#include "common/geometry/order_statistics.hpp"
#include "common/geometry/ring.hpp"
#include "tools/survey/water/flood.hpp"
#include "tools/survey/water/mine_water.hpp"

namespace adit {
namespace {

constexpr float kSurfaceReachM = 0.3F;        // of a true surface from a triangle
constexpr double kAboveFloorM = 0.7;          // where rays to the true floor begin
constexpr double kFloodedAreaMinM2 = 0.5;     // as mine_water
constexpr std::array kLevels{0.2, 0.5, 0.8};  // of the water: quantiles of the floor
constexpr std::size_t kTriangleStep = 7;      // of the triangles, which are alike beside each other

void add_mesh(const MineSurvey& survey, const SurveyTruth& truth, BodyErrors& errors) {
  const SurfaceMesh& mesh = survey.mesh();
  for (std::size_t i = 0; i < mesh.triangles.size(); i += kTriangleStep) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Eigen::Vector3d& p_a = mesh.vertices[a];
    const Eigen::Vector3d& p_b = mesh.vertices[b];
    const Eigen::Vector3d& p_c = mesh.vertices[c];
    const Eigen::Vector3d middle = (p_a + p_b + p_c) / 3.0;
    const Eigen::Vector3d normal = (p_b - p_a).cross(p_c - p_a).normalized();
    const auto T_world =
        truth.T_world_survey_at(survey.graph().node_near_in_survey(middle.head<2>()));
    if (!T_world) continue;
    const Eigen::Vector3d from = *T_world * (middle + double{kSurfaceReachM} * normal);
    const Eigen::Vector3d to = *T_world * middle;
    const Ray ray{from.cast<float>(), (to - from).normalized().cast<float>()};
    const auto hit = truth.scene().cast(ray, 2.0F * kSurfaceReachM, RayScene::Layer::kSolid);
    ++errors.triangles;
    if (hit) {
      errors.mesh_m.add(double{hit->distance_m} - double{kSurfaceReachM}, 0.0);
    } else {
      ++errors.strays;
    }
  }
}

/// The same cells with the true floor.
FloodGround true_ground(FloodGround ground, const MineSurvey& survey, const SurveyTruth& truth) {
  for (std::size_t i = 0; i < ground.floor_m.size(); ++i) {
    float& floor_m = ground.floor_m[i];
    if (!std::isfinite(floor_m)) continue;
    const Eigen::Vector2d p = centre_of(ground.floor_m.cell(i), ground.cell_m);
    const auto T_world = truth.T_world_survey_at(survey.graph().node_near_in_survey(p));
    if (!T_world) continue;
    const Eigen::Vector3d above =
        *T_world * Eigen::Vector3d(p.x(), p.y(), double{floor_m} + kAboveFloorM);
    const auto z_m = truth.surface_z_m(above, false);
    if (z_m) floor_m = static_cast<float>(*z_m - truth.T_world_survey().z_m);
  }
  return ground;
}

void add_water(const MineSurvey& survey, const SurveyTruth& truth, BodyErrors& errors) {
  const OccupancyGrid* const free_space = survey.occupied() ? &*survey.occupied() : nullptr;
  const FloodGround ground = flood_ground(survey.filled_columns(), free_space);
  const FloodGround real = true_ground(ground, survey, truth);
  std::vector<double> floor_m;
  for (std::size_t i = 0; i < real.floor_m.size(); ++i) {
    if (std::isfinite(real.floor_m[i])) floor_m.push_back(real.floor_m[i]);
  }
  if (floor_m.empty()) return;
  for (const double level : kLevels) {
    const double level_m = quantile(floor_m, level);
    double true_m3 = 0.0;
    double true_m2 = 0.0;
    for (const WaterBody& body : flooded_at(real, level_m, kFloodedAreaMinM2)) {
      true_m3 += body.volume_m3;
      true_m2 += body.area_m2;
    }
    if (true_m2 == 0.0) continue;
    Measured volume_m3{0.0, 0.0};
    for (const SurveyedWater& water :
         mine_water(survey.columns(), survey.filled_columns(), free_space, {}, level_m)) {
      if (water.kind != SurveyedWater::Kind::kFlooded) continue;
      volume_m3.value += water.volume_m3.value;
      volume_m3.sd += water.volume_m3.sd;  // of one level: they err together
    }
    errors.flooded_m.add((volume_m3.value - true_m3) / true_m2, volume_m3.sd / true_m2);
  }
}

/// A point in a ring, in the middle of the widest part at half of its height.
Eigen::Vector2d inside_of(const std::vector<Eigen::Vector2d>& ring) {
  const auto [low, high] = std::ranges::minmax_element(
      ring, {}, [](const Eigen::Vector2d& p) -> double { return p.y(); });
  const double y = 0.5 * (low->y() + high->y()) + 1e-6;
  std::vector<double> crossings;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d& a = ring[i];
    const Eigen::Vector2d& b = ring[(i + 1) % ring.size()];
    if ((a.y() > y) != (b.y() > y))
      crossings.push_back(a.x() + (b.x() - a.x()) * (y - a.y()) / (b.y() - a.y()));
  }
  std::ranges::sort(crossings);
  Eigen::Vector2d inside = ring.front();
  double widest = 0.0;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    if (crossings[i + 1] - crossings[i] <= widest) continue;
    widest = crossings[i + 1] - crossings[i];
    inside = {0.5 * (crossings[i] + crossings[i + 1]), y};
  }
  return inside;
}

void add_pillars(const MineSurvey& survey, const SurveyTruth& truth, BodyErrors& errors) {
  for (const Pillar& pillar : survey.pillars()) {
    ++errors.pillars;
    const Eigen::Vector2d middle = inside_of(pillar.outline.points);
    const auto T_world = truth.T_world_survey_at(survey.graph().node_near_in_survey(middle));
    if (!T_world) continue;
    const Eigen::Vector2d p_world = T_world->plan * middle;
    const auto& rings = truth.world().truth.plan;
    const auto real = std::ranges::find_if(rings, [&](const PlanRing& ring) {
      return ring.is_pillar() && encloses(ring.points, p_world);
    });
    if (real == rings.end()) {
      ++errors.not_pillars;
      continue;
    }
    const double area_m2 = -real->signed_area_m2();
    SurveyErrors& areas = pillar.is_closed() ? errors.pillars_m2 : errors.open_pillars_m2;
    areas.add(pillar.area_m2.value / area_m2 - 1.0, pillar.area_m2.sd / area_m2);
  }
}

}  // namespace

void BodyErrors::add(const BodyErrors& other) {
  mesh_m.add(other.mesh_m);
  triangles += other.triangles;
  strays += other.strays;
  flooded_m.add(other.flooded_m);
  pillars_m2.add(other.pillars_m2);
  open_pillars_m2.add(other.open_pillars_m2);
  pillars += other.pillars;
  not_pillars += other.not_pillars;
}

BodyErrors body_errors(const MineSurvey& survey, const SurveyTruth& truth) {
  BodyErrors errors;
  add_mesh(survey, truth, errors);
  add_water(survey, truth, errors);
  add_pillars(survey, truth, errors);
  return errors;
}

}  // namespace adit
