// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <nlohmann/json.hpp>

#include "tools/eval/map_score.hpp"

namespace adit {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const PositionErrors& errors) {
  return {{"rmse_m", errors.rmse_m}, {"mean_m", errors.mean_m}, {"max_m", errors.max_m}};
}

/// Without figures where there was no stretch.
Json json_of(const RelativeErrors& errors) {
  Json json = {{"length_m", errors.length_m}, {"stretches", errors.stretches}};
  if (errors.stretches == 0) return json;
  json["translation_m"] = errors.translation_m;
  json["rotation_deg"] = errors.rotation_deg;
  return json;
}

Json json_of(const TrajectoryScore& score) {
  Json relative = Json::array();
  for (const RelativeErrors& errors : score.relative) relative.push_back(json_of(errors));
  return {{"poses", score.poses},
          {"aligned", json_of(score.aligned)},
          {"anchored", json_of(score.anchored)},
          {"relative", relative},
          {"true_length_m", score.true_length_m},
          {"length_ratio", score.length_ratio}};
}

Json json_of(const MapScore& score) {
  Json json = {{"mapped_points", score.mapped_points},
               {"reference_points", score.reference_points},
               {"coverage", score.coverage},
               {"coverage_of_mine", nullptr},
               {"deviation", score.deviation},
               {"wall_distance",
                {{"mean_m", score.wall_distance.mean_m},
                 {"median_m", score.wall_distance.median_m},
                 {"p95_m", score.wall_distance.p95_m}}}};
  if (score.coverage_of_mine) json["coverage_of_mine"] = *score.coverage_of_mine;
  return json;
}

}  // namespace

std::string to_json(const TrajectoryScore& trajectory, const MapScore& map) {
  return Json{{"trajectory", json_of(trajectory)}, {"map", json_of(map)}}.dump(2);
}

}  // namespace adit
