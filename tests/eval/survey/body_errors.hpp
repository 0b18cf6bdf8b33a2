// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>

#include "tests/eval/survey/survey_errors.hpp"
#include "tests/eval/survey/survey_truth.hpp"
#include "tools/survey/mine_survey.hpp"

namespace adit {

/// Errors of what a survey computes from elevations and outlines.
struct BodyErrors {
  SurveyErrors mesh_m;        ///< of triangles of the void, along their normals
  std::size_t triangles = 0;  ///< of which this many were compared
  std::size_t strays = 0;     ///< without a true surface within 0.3 m
  /// Volume of water up to three levels, over its true area: a height.
  SurveyErrors flooded_m;
  SurveyErrors pillars_m2;       ///< areas of closed pillars, as shares of the true ones
  SurveyErrors open_pillars_m2;  ///< the same of the others, of which the area is an upper bound
  std::size_t pillars = 0;       ///< surveyed
  std::size_t not_pillars = 0;   ///< of these, those that are not in a true one

  void add(const BodyErrors& other);
};

/// Mesh, water and pillars of a survey against the true mine. Places are those of the true poses
/// of local maps, levels of water are in survey.
BodyErrors body_errors(const MineSurvey& survey, const SurveyTruth& truth);

}  // namespace adit
