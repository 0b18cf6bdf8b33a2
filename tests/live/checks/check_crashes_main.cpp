// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// check_crashes RECORDED JOURNAL TRUTH TORN: checks that the journal of a mapping process that was
// killed repeatedly contains everything it published, except one record for each of the TORN
// truncations, and gives one consistent map. Prints failed requirements; exit code 1.
#include <algorithm>
#include <exception>
#include <iostream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/messages/codec.hpp"
#include "common/messages/mapping/association.hpp"
#include "common/messages/mapping/local_map.hpp"
#include "procs/mapping/map_journal.hpp"
#include "tests/live/checks/log_check.hpp"
#include "tests/support/scores/stored_map_score.hpp"
#include "tools/eval/trajectory.hpp"

namespace adit {
namespace {

constexpr double kErrorMaxM = 0.5;
constexpr int kSessionsMin = 3;

struct ReceivedMessages {
  std::vector<LocalMap> maps;
  std::vector<Association> associations;
};

ReceivedMessages received_in(const std::string& path) {
  ReceivedMessages received;
  LogFile log(path);
  LocalMapReassembler assembler;
  while (const auto event = log.next()) {
    if (event->channel == channels::kLocalMap) {
      auto map = assembler.add(*from_message(*decode<local_map_t>(event->data)));
      if (map) received.maps.push_back(std::move(*map));
    } else if (event->channel == channels::kAssociation) {
      received.associations.push_back(*from_message(*decode<association_t>(event->data)));
    }
  }
  return received;
}

template <class T>
int missing(const std::vector<T>& received, const std::vector<T>& stored) {
  return static_cast<int>(std::ranges::count_if(
      received, [&](const T& x) { return std::ranges::find(stored, x) == stored.end(); }));
}

Requirements require;

int check(const std::string& recorded, const std::string& journal, const std::string& truth,
          int torn) {
  const ReceivedMessages received = received_in(recorded);
  const StoredMap stored = read_map_journal(journal);
  const MapGraph graph = test::restore_graph(stored);
  const int lost =
      missing(received.maps, stored.maps) + missing(received.associations, stored.associations);
  const double error_max_m = test::error_of(stored, graph, read_tum(truth)).farthest_m;
  const int cross_session_loop_closures = test::loop_closures_between_sessions(stored, graph);
  const int sessions = stored.maps.empty() ? 0 : stored.maps.back().session + 1;
  std::cout << fmt::format(
      "received {} local maps and {} decisions, stored {} and {}, lost {} in {} torn records; {} "
      "sessions, {} loop closures between them, maximum error {} m\n",
      received.maps.size(), received.associations.size(), stored.maps.size(),
      stored.associations.size(), lost, torn, sessions, cross_session_loop_closures, error_max_m);
  require(received.maps.size() > stored.maps.size() / 2, "most local maps are received");
  require(lost <= torn, "published data are lost only in torn records");
  require(sessions >= kSessionsMin, "mapping was killed");
  require(cross_session_loop_closures > 0, "loop closures exist between sessions");
  require(error_max_m < kErrorMaxM, "the map is accurate");
  return require.exit_code();
}

}  // namespace
}  // namespace adit

int main(int argc, char** argv) try {
  if (argc != 5) {
    std::cerr << "check_crashes RECORDED JOURNAL TRUTH TORN\n";
    return 2;
  }
  return adit::check(argv[1], argv[2], argv[3], std::stoi(argv[4]));
} catch (const std::exception& error) {
  std::cerr << "check_crashes: " << error.what() << "\n";
  return 2;
}
