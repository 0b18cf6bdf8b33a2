// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/sick_lms2xx/settings.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

#include "drivers/sick_lms2xx/measured_values.hpp"

namespace adit {

void LmsSettings::require_valid() const {
  constexpr std::size_t kPasswordBytes = 8;
  if (baud != 9600 && baud != 19200 && baud != 38400 && baud != 500000) {
    throw std::invalid_argument(
        fmt::format("baud is {}: an LMS has 9600, 19200, 38400 and 500000", baud));
  }
  const bool fine = field_of_view_deg == 100 && angle_step_deg == 0.25;
  const bool usual = (field_of_view_deg == 100 || field_of_view_deg == 180) &&
                     (angle_step_deg == 0.5 || angle_step_deg == 1.0);
  if (!fine && !usual) {
    throw std::invalid_argument(fmt::format(
        "an LMS does not measure {}° in steps of {}°: 180° in steps of 1 or 0.5, 100° also of 0.25",
        field_of_view_deg, angle_step_deg));
  }
  if (password.size() != kPasswordBytes) {
    throw std::invalid_argument("the password of an LMS has 8 characters");
  }
}

int LmsSettings::beams() const {
  return static_cast<int>(std::lround(field_of_view_deg / angle_step_deg)) + 1;
}

int LmsSettings::turns() const { return static_cast<int>(std::lround(1.0 / angle_step_deg)); }

double LmsSettings::range_max_m() const { return (LmsMeasuredValues::kCodesFrom - 1) * unit_m(); }

double LmsSettings::scan_duration_us() const {
  return 1e6 * (turns() - 1 + field_of_view_deg / 360.0) / mirror_hz;
}

}  // namespace adit
