// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// hazards_table MISSIONS..: compares the hazards that the page and the survey of a mission show
// with the simulated mine, as a table in Markdown: how many of those shown are there, and how many
// of those that the robot could see are shown.
#include <algorithm>
#include <array>
#include <cmath>
#include <exception>
#include <filesystem>
#include <iostream>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "sim/world/plan/plan_shapes.hpp"
#include "tests/eval/markdown.hpp"
#include "tests/eval/survey/survey_truth.hpp"
#include "tools/survey/plan/hazard_marks.hpp"

namespace adit {
namespace {

constexpr double kNearM = 0.5;  // by which a hazard may be beside its mark
constexpr double kSeenAboveM = 0.1;
constexpr double kSeenM = 6.0;                  // from which a hazard is seen
constexpr double kSampleM = 0.1;                // between samples of the mine in a mark
constexpr double kLaserHeightM = 0.7;           // above the ground
constexpr std::array kInsideM{0.35, 0.7, 1.1};  // heights from which a low roof is looked for
constexpr double kRoofToleranceM = 0.05;

struct Counts {
  int shown = 0;
  int true_ones = 0;
  int visible = 0;
  int found = 0;

  void add(const Counts& other) {
    shown += other.shown;
    true_ones += other.true_ones;
    visible += other.visible;
    found += other.found;
  }
};

using CountsByKind = std::map<std::string, Counts>;

/// A hazard of the mine, by some of its points.
struct RealHazard {
  std::string kind;
  std::string name;
  std::vector<Eigen::Vector2d> points;  ///< p_world [m]
  double z_m = 0.0;                     ///< of what is seen of it, in world
};

/// The column of air at a place of the mine.
struct Air {
  double floor_m = 0.0;
  double roof_m = 0.0;
};

class HazardTruth {
 public:
  HazardTruth(const MineSurvey& survey, const SurveyTruth& truth)
      : survey_(survey), truth_(truth), world_(truth.world()) {}

  [[nodiscard]] bool is_true(const HazardMark& mark) const {
    const std::size_t node = survey_.graph().node_at(mark.hazard.utime);
    const auto T_world_survey = truth_.T_world_survey_at(node);
    if (!T_world_survey) return false;
    const LevelPose T_world = *T_world_survey * mark.T_survey_centre;
    const std::vector<Eigen::Vector3d> samples = samples_of(mark, T_world);
    const std::string& kind = mark.hazard.kind;
    if (kind == "water") return any_within(samples, world_.water);
    if (kind == "mud") return near(samples.front(), world_.soft_ground);
    if (kind == "methane") return near(samples.front(), world_.gas);
    if (kind == "low roof") return has_low_roof(samples);
    if (kind == "drop") return has_drop(samples);
    return has_obstacle(samples);
  }

  [[nodiscard]] std::vector<RealHazard> real() const {
    std::vector<RealHazard> hazards;
    for (const StandingWater& water : world_.water)
      hazards.push_back({"water", water.name, water.outline, water.level_m});
    for (const SoftGround& ground : world_.soft_ground)
      hazards.push_back({"mud", ground.name, {ground.p_world}, 0.0});
    for (const GasPocket& pocket : world_.gas)
      hazards.push_back({"methane", pocket.name, {pocket.p_world}, 0.0});
    for (const Obstacle& obstacle : world_.truth.obstacles) {
      const bool is_mud =
          std::any_of(world_.soft_ground.begin(), world_.soft_ground.end(),
                      [&](const SoftGround& ground) { return ground.name == obstacle.name; });
      const bool is_hole = obstacle.kind == PartKind::kFloor && !is_mud &&
                           obstacle.z_high_m - obstacle.z_low_m > step_m();
      if (is_hole)
        hazards.push_back(
            {"drop", obstacle.name, obstacle.outline, obstacle.z_high_m + kSeenAboveM});
      if (obstacle.kind == PartKind::kRoof)
        hazards.push_back(
            {"low roof", obstacle.name, obstacle.outline, obstacle.z_low_m - kSeenAboveM});
    }
    for (RealHazard& hazard : hazards) {
      Eigen::Vector2d sum(0.0, 0.0);
      for (const Eigen::Vector2d& point : hazard.points) sum += point;
      hazard.points.emplace_back(sum / static_cast<double>(hazard.points.size()));
    }
    return hazards;
  }

  /// Whether the robot came near to it with nothing between; gas and mud are measured at the robot.
  [[nodiscard]] bool is_visible(const RealHazard& hazard) const {
    const bool at_robot = hazard.kind == "mud" || hazard.kind == "methane";
    for (const TimedPose& pose : survey_.input().truth()) {
      const Eigen::Vector3d eye = pose.position() + Eigen::Vector3d(0.0, 0.0, kLaserHeightM);
      for (const Eigen::Vector2d& point : hazard.points) {
        const double range_m = (point - eye.head<2>()).norm();
        if (at_robot ? range_m < 0.5
                     : range_m < kSeenM && sees(eye, {point.x(), point.y(), hazard.z_m}))
          return true;
      }
    }
    return false;
  }

  [[nodiscard]] bool is_shown(const RealHazard& hazard,
                              const std::vector<HazardMark>& marks) const {
    return std::any_of(marks.begin(), marks.end(), [&](const HazardMark& mark) {
      if (mark.hazard.kind != hazard.kind) return false;
      const std::size_t node = survey_.graph().node_at(mark.hazard.utime);
      const auto T_world_survey = truth_.T_world_survey_at(node);
      if (!T_world_survey) return false;
      const Pose2 T_mark_world = (*T_world_survey * mark.T_survey_centre).plan.inverse();
      return std::any_of(hazard.points.begin(), hazard.points.end(), [&](const auto& point) {
        const Eigen::Vector2d outside =
            (T_mark_world * point).cwiseAbs() - 0.5 * mark.hazard.size_m;
        return outside.maxCoeff() < 2.0 * kNearM;
      });
    });
  }

 private:
  [[nodiscard]] double step_m() const { return survey_.input().vehicle().step_max_m; }

  static std::vector<Eigen::Vector3d> samples_of(const HazardMark& mark, const LevelPose& T_world) {
    std::vector<Eigen::Vector3d> samples{T_world.translation()};
    const Eigen::Vector2d half = 0.5 * mark.hazard.size_m.array() + kNearM;
    for (double x = -half.x(); x <= half.x(); x += kSampleM) {
      for (double y = -half.y(); y <= half.y(); y += kSampleM)
        samples.emplace_back(T_world * Eigen::Vector3d(x, y, 0.0));
    }
    return samples;
  }

  static bool any_within(const std::vector<Eigen::Vector3d>& samples,
                         const std::vector<StandingWater>& waters) {
    return std::any_of(samples.begin(), samples.end(), [&](const Eigen::Vector3d& sample) {
      return std::any_of(waters.begin(), waters.end(), [&](const StandingWater& water) {
        return depth_m(PlanPolygon{water.outline}, sample.head<2>()) > 0.0;
      });
    });
  }

  /// Whether a place is within the radius of one of them, and of the robot.
  template <class Region>
  static bool near(const Eigen::Vector3d& p, const std::vector<Region>& regions) {
    return std::any_of(regions.begin(), regions.end(), [&](const Region& region) {
      return (region.p_world - p.head<2>()).norm() < 2.0 * region.radius_m + 1.0;
    });
  }

  [[nodiscard]] std::optional<Air> air_at(const Eigen::Vector3d& p_world,
                                          double height_m = kLaserHeightM) const {
    const Eigen::Vector3d inside = p_world + Eigen::Vector3d(0.0, 0.0, height_m);
    const auto floor = truth_.surface_z_m(inside, false);
    const auto roof = truth_.surface_z_m(inside, true);
    if (!floor || !roof) return std::nullopt;
    return Air{*floor, *roof};
  }

  [[nodiscard]] bool has_low_roof(const std::vector<Eigen::Vector3d>& samples) const {
    const double vehicle_m = survey_.input().vehicle().height_m + kRoofToleranceM;
    return std::any_of(samples.begin(), samples.end(), [&](const Eigen::Vector3d& sample) {
      // A beam may be anywhere between, and the ground is not exactly where the robot's is.
      return std::any_of(kInsideM.begin(), kInsideM.end(), [&](double height_m) {
        const auto air = air_at(sample, height_m);
        return air && air->roof_m - air->floor_m < vehicle_m;
      });
    });
  }

  [[nodiscard]] std::vector<double> floors_of(const std::vector<Eigen::Vector3d>& samples) const {
    std::vector<double> floors;
    for (const Eigen::Vector3d& sample : samples) {
      if (const auto air = air_at(sample)) floors.push_back(air->floor_m);
    }
    std::sort(floors.begin(), floors.end());
    return floors;
  }

  /// Ground that is lower by a step than that around it.
  [[nodiscard]] bool has_drop(const std::vector<Eigen::Vector3d>& samples) const {
    const std::vector<double> floors = floors_of(samples);
    return !floors.empty() && floors[floors.size() / 2] - floors.front() > step_m();
  }

  /// Rock, or ground that is not even.
  [[nodiscard]] bool has_obstacle(const std::vector<Eigen::Vector3d>& samples) const {
    const std::vector<double> floors = floors_of(samples);
    return floors.size() < samples.size() || floors.back() - floors.front() > 0.5 * step_m();
  }

  [[nodiscard]] bool sees(const Eigen::Vector3d& eye, const Eigen::Vector3d& to) const {
    const double length_m = (to - eye).norm();
    const Ray ray{eye.cast<float>(), ((to - eye) / length_m).cast<float>()};
    const auto hit =
        truth_.scene().cast(ray, static_cast<float>(length_m), RayScene::Layer::kSolid);
    return !hit || hit->distance_m > 0.9 * length_m;
  }

  const MineSurvey& survey_;
  const SurveyTruth& truth_;
  const World& world_;
};

CountsByKind score(const std::filesystem::path& mission, bool verbose) {
  SurveyOptions options;
  options.mission = {mission};
  const MineSurvey survey(options);
  const SurveyTruth truth(survey);
  const HazardTruth mine(survey, truth);
  const auto marks = hazard_marks(survey.input().hazards(), survey.graph());
  CountsByKind counts;
  for (const HazardMark& mark : marks) {
    Counts& of_kind = counts[mark.hazard.kind];
    const bool is_true = mine.is_true(mark);
    ++of_kind.shown;
    of_kind.true_ones += is_true ? 1 : 0;
    if (verbose && !is_true) {
      const Eigen::Vector3d p = mark.T_survey_centre.translation();
      std::cerr << format("not there: %s %.2f %s at %.1f, %.1f (%.1f by %.1f m): %s\n",
                          mark.hazard.kind.c_str(), mark.hazard.value, mark.hazard.unit.c_str(),
                          p.x(), p.y(), mark.hazard.size_m.x(), mark.hazard.size_m.y(),
                          mark.hazard.evidence.c_str());
    }
  }
  for (const RealHazard& hazard : mine.real()) {
    if (!mine.is_visible(hazard)) continue;
    Counts& of_kind = counts[hazard.kind];
    const bool found = mine.is_shown(hazard, marks);
    ++of_kind.visible;
    of_kind.found += found ? 1 : 0;
    if (verbose && !found) {
      std::cerr << format("not shown: %s %s at %.1f, %.1f of world\n", hazard.kind.c_str(),
                          hazard.name.c_str(), hazard.points.front().x(),
                          hazard.points.front().y());
    }
  }
  return counts;
}

void print_table(const std::vector<std::filesystem::path>& missions, bool verbose) {
  CountsByKind sum;
  for (const std::filesystem::path& mission : missions) {
    if (verbose) std::cerr << mission.string() << "\n";
    for (const auto& [kind, counts] : score(mission, verbose)) sum[kind].add(counts);
  }
  print_heading("| hazard | shown | of these there | in sight of the robot | of these shown |");
  for (const auto& [kind, counts] : sum) {
    std::cout << format("| %s | %d | %d | %d | %d |\n", kind.c_str(), counts.shown,
                        counts.true_ones, counts.visible, counts.found);
  }
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  CLI::App app("Compares the hazards of missions with the simulated mines, as a table in Markdown");
  std::vector<std::filesystem::path> missions;
  bool verbose = false;
  app.add_option("MISSIONS", missions, "Folders or logs of simulated missions")->required();
  app.add_flag("--verbose", verbose, "Print each error to standard error");
  CLI11_PARSE(app, argc, argv);
  adit::print_table(missions, verbose);
  return 0;
} catch (const std::exception& error) {
  std::cerr << "hazards_table: " << error.what() << "\n";
  return 2;
}
