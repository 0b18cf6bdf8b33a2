// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/types/vehicle.hpp"
#include "tools/survey/frame/survey_frame.hpp"
#include "tools/survey/section/cross_section.hpp"

namespace adit {

/// What is to pass: a rectangle that stands on the floor.
struct Envelope {
  std::string name;
  double width_m = 0.0;
  double height_m = 0.0;
};

/// A person with a helmet, a mine cart, and the robot.
std::vector<Envelope> usual_envelopes(const Vehicle& robot);

/// How an envelope passes a section where it passes best.
struct Clearance {
  double offset_m = 0.0;  ///< of its middle from the centre line, to the left
  double above_m = 0.0;   ///< to the roof; negative: it does not fit
  double beside_m = 0.0;  ///< to the nearer wall, at its full height; 0 if it does not fit
  [[nodiscard]] bool fits() const { return above_m >= 0.0; }
};

/// Nothing where a wall, the floor or the roof is unseen. The envelope stands on the highest floor
/// below it.
std::optional<Clearance> clearance_of(const CrossSection& section, const Envelope& envelope);

/// Each section and envelope as comma-separated values, places in the grid.
std::string clearance_table(const std::vector<CrossSection>& sections,
                            const std::vector<Envelope>& envelopes, const SurveyFrame& frame);

}  // namespace adit
