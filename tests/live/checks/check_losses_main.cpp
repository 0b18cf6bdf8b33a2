// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// check_losses DIR: checks that the journals of the mission in DIR contain every local map and
// every 3D scan that was published according to its logs. Prints one line, separated by tabs:
// distance of the true body from the start [m], local maps published, lost, 3D scans published,
// lost, and the lost items as KIND ID@SECONDS-BEFORE: time of publication, and time before the end
// of the log. Exit code 1 if an item is lost.
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tests/live/checks/mission_losses.hpp"
#include "tools/mission/mission_folder.hpp"

namespace adit {
namespace {

using test::PublishedItem;

std::string names_of(const std::string& kind, const std::vector<PublishedItem>& items) {
  std::string names;
  for (const PublishedItem& item : items) {
    names += fmt::format(" {} {}@{:.1f}-{:.1f}", kind, item.id, item.at_s, item.before_log_end_s);
  }
  return names;
}

int check(const std::string& folder) {
  const MissionFolder mission(folder);
  const test::PublishedData published = test::published_in(mission.logs());
  const test::MissionLosses lost = test::losses(published, mission.path() / "mapping.journal",
                                                mission.path() / "volume_map.journal");
  std::cout << fmt::format("{:.2f}\t{}\t{}\t{}\t{}\t{}\n", published.distance_from_start_m,
                           published.maps.size(), lost.maps.size(), published.scans.size(),
                           lost.scans.size(),
                           names_of("map", lost.maps) + names_of("scan", lost.scans));
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
