// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/survey/frame/survey_frame.hpp"
#include "tools/survey/section/cross_section.hpp"
#include "tools/survey/section/profile.hpp"

namespace adit {

/// Cross-sections as one SVG, to scale 1:100, in the order of tunnels: outline, centre line,
/// elevations, width, height and area with their 95 % intervals. Sections in junctions are left
/// out.
std::string sections_svg(const std::vector<CrossSection>& sections, const SurveyFrame& frame);

/// Longitudinal profiles as one SVG, heights five times as large as lengths: floor and roof, the
/// 95 % interval of the floor as a band, chainage and elevation.
std::string profiles_svg(const std::vector<Profile>& profiles, const SurveyFrame& frame);

}  // namespace adit
