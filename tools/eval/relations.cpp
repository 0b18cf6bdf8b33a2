// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/eval/relations.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>

#include <nlohmann/json.hpp>

#include "tools/eval/number_table.hpp"

namespace adit {
namespace {

ErrorStatistics statistics(std::vector<double> errors) {
  if (errors.empty()) return {};
  std::sort(errors.begin(), errors.end());
  const auto n = static_cast<double>(errors.size());
  const double mean = std::accumulate(errors.begin(), errors.end(), 0.0) / n;
  double squares = 0.0;
  for (const double error : errors) squares += (error - mean) * (error - mean);
  const std::size_t half = errors.size() / 2;
  const double median =
      errors.size() % 2 == 1 ? errors[half] : (errors[half - 1] + errors[half]) / 2;
  return {mean, std::sqrt(squares / n), median, errors.back()};
}

nlohmann::ordered_json json_of(const ErrorStatistics& errors) {
  return {{"mean", errors.mean},
          {"sd", errors.standard_deviation},
          {"median", errors.median},
          {"max", errors.max}};
}

}  // namespace

std::vector<Relation> read_relations(std::istream& in, std::string_view name) {
  std::vector<Relation> relations;
  NumberTable table(in, name, 8);
  while (const auto row = table.next()) {
    const auto& v = *row;
    relations.push_back(
        {table.microseconds(v[0]), table.microseconds(v[1]), Pose2{v[2], v[3], v[7]}});
  }
  return relations;
}

std::vector<Relation> read_relations(const std::filesystem::path& path) {
  std::istringstream in = open_table(path);
  return read_relations(in, path.string());
}

RelationsScore score_relations(const std::vector<Relation>& relations,
                               const Trajectory& trajectory) {
  std::vector<double> translations_m;
  std::vector<double> rotations_deg;
  for (const Relation& relation : relations) {
    const auto T_map_1 = interpolate(trajectory, relation.utime_1);
    const auto T_map_2 = interpolate(trajectory, relation.utime_2);
    if (!T_map_1 || !T_map_2) continue;
    const Pose2 error = relation.T_1_2.inverse() * between(*T_map_1, *T_map_2);
    translations_m.push_back(error.translation().norm());
    rotations_deg.push_back(rad_to_deg(std::abs(error.theta)));
  }
  RelationsScore score;
  score.used = translations_m.size();
  score.outside = relations.size() - score.used;
  score.translation_m = statistics(std::move(translations_m));
  score.rotation_deg = statistics(std::move(rotations_deg));
  return score;
}

std::string to_json(const RelationsScore& score) {
  nlohmann::ordered_json json;
  json["relations"] = score.used + score.outside;
  json["used"] = score.used;
  json["outside_trajectory"] = score.outside;
  if (score.used > 0) {
    json["translation_m"] = json_of(score.translation_m);
    json["rotation_deg"] = json_of(score.rotation_deg);
  }
  return json.dump(2);
}

}  // namespace adit
