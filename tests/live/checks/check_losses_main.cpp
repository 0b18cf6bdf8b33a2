// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// check_losses DIR: whether the journals of the mission in DIR have every local map and every 3D
// scan that its logs say was announced. Prints on one line, with tabs between: how far the true
// body is from the start [m], local maps announced, of them lost, 3D scans announced, of them lost,
// and which, as KIND ID@SECONDS-BEFORE: when, and how long before its log ends. Ends with 1 where
// something is lost.
#include <array>
#include <cstdio>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include "tests/live/checks/mission_losses.hpp"
#include "tools/mission/mission_folder.hpp"

namespace adit {
namespace {

using test::AnnouncedItem;

std::string names_of(const std::string& kind, const std::vector<AnnouncedItem>& items) {
  std::string names;
  for (const AnnouncedItem& item : items) {
    std::array<char, 80> text{};
    std::snprintf(text.data(), text.size(), " %s %d@%.1f-%.1f", kind.c_str(), item.id, item.at_s,
                  item.before_log_end_s);
    names += text.data();
  }
  return names;
}

int check(const std::string& folder) {
  const MissionFolder mission(folder);
  const test::Announced announced = test::announced_in(mission.logs());
  const test::MissionLosses lost = test::losses(announced, mission.path() / "mapping.journal",
                                                mission.path() / "volume_map.journal");
  std::printf("%.2f\t%zu\t%zu\t%zu\t%zu\t%s\n", announced.distance_from_start_m,
              announced.maps.size(), lost.maps.size(), announced.scans.size(), lost.scans.size(),
              (names_of("map", lost.maps) + names_of("scan", lost.scans)).c_str());
  return lost.maps.empty() && lost.scans.empty() ? 0 : 1;
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  if (argc != 2) {
    std::cerr << "check_losses DIR\n";
    return 2;
  }
  return adit::check(argv[1]);
} catch (const std::exception& error) {
  std::cerr << "check_losses: " << error.what() << "\n";
  return 2;
}
