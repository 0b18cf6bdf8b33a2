// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>

#include <Eigen/Core>

namespace adit {

/// The coordinate system of a survey's files. The frame "survey", in which everything is computed,
/// has the same axes; its origin is near the mine, so that single precision resolves a millimetre.
class SurveyFrame {
 public:
  /// Without control: map itself, an engineering system whose origin is the start of the mission.
  static SurveyFrame local();

  /// `origin`: of survey, in the grid [m]. `crs_wkt`: of the grid. `crs_name`:
  /// for GeoJSON, "urn:ogc:def:crs:EPSG::n" or the same WKT. `statement`: what the grid is, a
  /// sentence for people.
  SurveyFrame(Eigen::Vector3d origin, std::string crs_wkt, std::string crs_name,
              std::string statement)
      : origin_(std::move(origin)),
        crs_wkt_(std::move(crs_wkt)),
        crs_name_(std::move(crs_name)),
        statement_(std::move(statement)) {}

  [[nodiscard]] const Eigen::Vector3d& origin() const { return origin_; }
  [[nodiscard]] const std::string& crs_wkt() const { return crs_wkt_; }
  [[nodiscard]] const std::string& crs_name() const { return crs_name_; }
  [[nodiscard]] const std::string& statement() const { return statement_; }

  /// Easting, northing and elevation.
  [[nodiscard]] Eigen::Vector3d in_grid(const Eigen::Vector3d& p_survey) const {
    return p_survey + origin_;
  }
  [[nodiscard]] Eigen::Vector2d in_grid(const Eigen::Vector2d& p_survey) const {
    return p_survey + origin_.head<2>();
  }

 private:
  Eigen::Vector3d origin_;
  std::string crs_wkt_;
  std::string crs_name_;
  std::string statement_;
};

}  // namespace adit
