// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <utility>

#include <nlohmann/json.hpp>

#include "common/files/file_utils.hpp"
#include "tools/survey/files/vector_files.hpp"

namespace adit {
namespace {

using Json = nlohmann::ordered_json;

/// Rounded to millimetres.
Json position(const Eigen::Vector3d& p) {
  Json position = Json::array();
  for (const double x : p) position.push_back(std::round(1e3 * x) / 1e3);
  return position;
}

Json value_of(const AttributeValue& value) {
  if (const auto* const integer = std::get_if<std::int64_t>(&value)) return *integer;
  if (const auto* const number = std::get_if<double>(&value)) return *number;
  if (const auto* const text = std::get_if<std::string>(&value)) return *text;
  return nullptr;
}

Json feature_of(const VectorFeature& feature, const VectorLayer& layer) {
  const bool is_point = layer.geometry == VectorLayer::Geometry::kPoint;
  Json line = Json::array();
  for (const Eigen::Vector3d& p : feature.points) line.push_back(position(p));
  Json properties{{"layer", layer.name}};
  for (std::size_t i = 0; i < feature.values.size(); ++i)
    properties[layer.fields[i].name] = value_of(feature.values[i]);
  return {{"type", "Feature"},
          {"geometry",
           {{"type", is_point ? "Point" : "LineString"},
            {"coordinates", is_point ? line.front() : line}}},
          {"properties", std::move(properties)}};
}

}  // namespace

AttributeValue known(double number) {
  return std::isfinite(number) ? AttributeValue(number) : AttributeValue();
}

void write_geojson(const std::vector<VectorLayer>& layers, const std::string& crs_name,
                   const std::string& statement, const std::filesystem::path& path) {
  Json features = Json::array();
  for (const VectorLayer& layer : layers) {
    for (const VectorFeature& feature : layer.features)
      features.push_back(feature_of(feature, layer));
  }
  const Json json{{"type", "FeatureCollection"},
                  {"crs", {{"type", "name"}, {"properties", {{"name", crs_name}}}}},
                  {"coordinates_are", statement},
                  {"features", std::move(features)}};
  write_text_file(json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n", path);
}

}  // namespace adit
