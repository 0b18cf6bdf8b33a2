// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include <Eigen/Core>

namespace adit {

/// Name of the coordinate system of a survey without control.
inline constexpr const char* kLocalGridName = "local grid of the mission";

/// The coordinate system of a survey's files. The frame "survey", in which everything is computed,
/// has the same axes and the lengths of the mine; its origin is near it, so that single precision
/// resolves a millimetre.
class SurveyFrame {
 public:
  /// Without control: map itself, an engineering system whose origin is the start of the mission.
  static SurveyFrame local();

  /// `origin`: of survey, in the grid [m]. `scale`: lengths in plan in the grid over lengths in
  /// survey, which are those of the mine. `crs_wkt`: of the grid. `crs_name`:
  /// for GeoJSON, "urn:ogc:def:crs:EPSG::n" or the same WKT. `statement`: what the grid is, a
  /// sentence for people.
  SurveyFrame(Eigen::Vector3d origin, double scale, std::string crs_wkt, std::string crs_name,
              std::string statement)
      : origin_(std::move(origin)),
        scale_(scale),
        crs_wkt_(std::move(crs_wkt)),
        crs_name_(std::move(crs_name)),
        statement_(std::move(statement)) {}

  [[nodiscard]] const Eigen::Vector3d& origin() const { return origin_; }
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] const std::string& crs_wkt() const { return crs_wkt_; }
  [[nodiscard]] const std::string& crs_name() const { return crs_name_; }
  [[nodiscard]] const std::string& statement() const { return statement_; }

  /// Easting, northing and elevation.
  [[nodiscard]] Eigen::Vector3d in_grid(const Eigen::Vector3d& p_survey) const {
    return {origin_.x() + scale_ * p_survey.x(), origin_.y() + scale_ * p_survey.y(),
            origin_.z() + p_survey.z()};
  }
  [[nodiscard]] Eigen::Vector2d in_grid(const Eigen::Vector2d& p_survey) const {
    return origin_.head<2>() + scale_ * p_survey;
  }
  [[nodiscard]] Eigen::Vector2d in_survey(const Eigen::Vector2d& p_grid) const {
    return (p_grid - origin_.head<2>()) / scale_;
  }

 private:
  Eigen::Vector3d origin_;
  double scale_;
  std::string crs_wkt_;
  std::string crs_name_;
  std::string statement_;
};

}  // namespace adit
