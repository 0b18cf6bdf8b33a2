// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

#include "tools/campaign/results/histogram.hpp"
#include "tools/campaign/results/rates.hpp"

namespace adit {

// Small pictures of the page of a campaign, as inline SVG.

/// A share and its interval between 0 and 100 %, on the range that is wanted.
std::string interval_svg(const Rate& rate);

/// Bars over an axis with the smallest and the largest value; empty without values.
std::string histogram_svg(const Histogram& histogram);

/// A number with four significant digits.
std::string compact_number(double number);

/// A style sheet that cmake/AditEmbed compiles into the program.
struct CampaignStyle {
  std::string name;
  std::string text;
};

/// campaign.css alone. Generated.
std::vector<CampaignStyle> campaign_styles();

}  // namespace adit
