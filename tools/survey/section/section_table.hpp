// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/survey/frame/survey_frame.hpp"
#include "tools/survey/section/cross_section.hpp"

namespace adit {

/// The measures of sections as comma-separated values, a line each; the first line has the names of
/// the columns, with units. What is unknown is empty: the width where
/// the tunnel has no two walls, area and perimeter also where a part of the outline is unseen.
std::string section_table(const std::vector<CrossSection>& sections, const SurveyFrame& frame);

/// The outlines of sections as comma-separated values, a line for each corner.
std::string outline_table(const std::vector<CrossSection>& sections, const SurveyFrame& frame);

}  // namespace adit
