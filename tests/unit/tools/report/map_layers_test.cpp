// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/svg/map_layers.hpp"

#include <cstddef>
#include <regex>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace adit {
namespace {

/// Radii of the circles around the numbers of scans.
std::vector<double> badge_radii(const std::vector<int>& numbers) {
  std::vector<ScanMark> scans;
  for (const int number : numbers) {
    ScanMark scan;
    scan.number = number;
    scan.T_map_laser = {10.0 * static_cast<double>(scans.size()), 0.0, 0.0};
    scans.push_back(scan);
  }
  const MapView view(nullptr, {{0, {0.0, 0.0, 0.0}}, {1, {50.0, 10.0, 0.0}}});
  const std::string svg = scans_svg(scans, view, "");
  const std::regex radius(R"(r="([0-9.]+)\")");
  std::vector<double> radii;
  for (std::sregex_iterator at(svg.begin(), svg.end(), radius); at != std::sregex_iterator(); ++at)
    radii.push_back(std::stod((*at)[1]));
  return radii;
}

constexpr double kDigitWidth = 5.2;  // of the bold digits of 8.5 px in map.css

TEST(MapLayers, SurroundTheNumbersOfAllScans) {
  const std::vector<int> numbers{7, 42, 123, 1042};
  const std::vector<double> radii = badge_radii(numbers);
  ASSERT_EQ(radii.size(), numbers.size());
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto digits = static_cast<double>(std::to_string(numbers[i]).size());
    EXPECT_GE(2.0 * radii[i], digits * kDigitWidth) << numbers[i];
  }
  EXPECT_EQ(radii[0], radii[1]);
}

}  // namespace
}  // namespace adit
