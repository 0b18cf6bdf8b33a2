// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <Eigen/Core>

#include "common/types/cloud.hpp"
#include "tools/survey/frame/survey_graph.hpp"
#include "tools/survey/input/cloud_store.hpp"

namespace adit::test {

inline constexpr std::int64_t kSurveyUtime = 1'600'000'000'000'000;

/// A graph of local maps at places along x, a second apart; map and survey are the same.
inline SurveyGraph graph_along_x(int count, double apart_m) {
  std::vector<SurveyGraph::Node> nodes;
  for (int i = 0; i < count; ++i) {
    SurveyGraph::Node node;
    node.id = i;
    node.T_map_local = {{apart_m * i, 0.0, 0.0}, 0.0};
    node.T_survey_local = node.T_map_local;
    node.T_odom_local = node.T_map_local;
    node.utime = kSurveyUtime + 1'000'000 * i;
    nodes.push_back(node);
  }
  return SurveyGraph(std::move(nodes));
}

/// Half of the sides of a tunnel's rectangular section.
struct BoxSection {
  double half_width_m = 2.0;
  double height_m = 2.0;
};

inline CloudStore stored(const std::vector<Cloud>& clouds) {
  CloudStore store;
  for (const Cloud& cloud : clouds) store.push_back(cloud);
  return store;
}

/// A 3D scan of a level tunnel along x from `from_m` to `to_m`, at the origin of odom: the surfaces
/// sampled each 5 cm.
inline Cloud scan_of_tunnel(double from_m, double to_m, const BoxSection& box = {}) {
  constexpr double kStep = 0.05;
  Cloud cloud;
  cloud.utime = kSurveyUtime;
  cloud.id = 1;
  for (double x = from_m; x <= to_m; x += kStep) {
    CloudLine line{kSurveyUtime, {0.0F, 0.0F, 0.6F}, {}, {}};
    const auto add = [&](double y, double z) {
      line.points.emplace_back(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
    };
    for (double y = -box.half_width_m; y <= box.half_width_m + 1e-9; y += kStep) {
      add(y, 0.0);
      add(y, box.height_m);
    }
    for (double z = kStep; z < box.height_m; z += kStep) {
      add(-box.half_width_m, z);
      add(box.half_width_m, z);
    }
    cloud.lines.push_back(std::move(line));
  }
  return cloud;
}

/// Places on the ground along x, 0.25 m apart.
inline std::vector<Eigen::Vector3d> path_along_x(double from_m, double to_m) {
  std::vector<Eigen::Vector3d> path;
  for (double x = from_m; x <= to_m; x += 0.25) path.emplace_back(x, 0.0, 0.0);
  return path;
}

}  // namespace adit::test
