// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report.hpp"

#include <optional>
#include <stdexcept>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/files/text_file.hpp"
#include "tools/map/result_folder.hpp"
#include "tools/report/log_place.hpp"
#include "tools/report/mission_ear.hpp"
#include "tools/report/mission_page.hpp"
#include "tools/report/report_files.hpp"
#include "tools/report/scan_cards.hpp"
#include "tools/report/text.hpp"

namespace adit {
namespace {

LogCensus census_of(const ReportOptions& options) {
  LogCensus census = take_census(options.logs);
  for (const auto channel :
       {channels::kPhase, channels::kPose, channels::kLocalMap, channels::kCloud}) {
    if (census.has(channel)) return census;
  }
  throw std::runtime_error("nothing of a mission in " + options.logs.front().string() +
                           ": neither PHASE nor POSE, LOCAL_MAP or CLOUD");
}

std::string title_of(const LogCensus& census) {
  return "Mission of " + date_text(census.first_utime).substr(0, 10);
}

MapToDraw to_draw(const MissionRecords& records, const MissionFacts& facts, const MissionMap& map,
                  const std::optional<OccupancyGrid>& grid) {
  const auto& exploration = records.state.exploration();
  return {&map, grid ? &*grid : nullptr, exploration ? &*exploration : nullptr,
          scan_marks(records, map), facts.homeward_utime};
}

std::vector<std::string> notes_of(const LogCensus& census, const MissionEar& ear,
                                  const MissionMap& map) {
  std::vector<std::string> notes = census.complaints;
  for (std::string& complaint : ear.complaints()) notes.push_back(std::move(complaint));
  if (map.missing_local_maps() > 0) {
    notes.push_back(counted(map.missing_local_maps(), "local map") +
                    " of the pose graph are not in the log");
  }
  return notes;
}

}  // namespace

MissionReport write_report(const ReportOptions& options, const ReportProgress& progress) {
  const auto tell = [&](const std::string& label, double done) {
    if (progress) progress(label, done);
  };
  const LogCensus census = census_of(options);
  const ResultFolder results(options.folder);
  MissionEar ear(census, options.remap);
  ear.listen(options, [&](double done) { tell("reading", done); });

  tell("drawing", 0.0);
  const MissionMap map(ear.map());
  const auto grid = map.grid(census.lasers());
  const MissionRecords records = ear.records();
  const MissionFacts facts = mission_facts(records, map);
  const MapToDraw drawn = to_draw(records, facts, map, grid);
  const std::string title = title_of(census);
  tell("writing", 0.3);
  MissionReport report{outcome_text(facts), facts.scans, facts.way_m, 0,
                       notes_of(census, ear, map)};
  for (std::string& sentence :
       write_report_files({records, facts, drawn, ear.volume(), title}, results.unfinished())) {
    report.complaints.push_back(std::move(sentence));
  }
  const std::string page = mission_page(records, facts, drawn, title, report.complaints);
  report.page_bytes = page.size();
  write_text(page, results.unfinished() / "mission.html");
  place_log(options.logs, options.folder, results.unfinished());
  results.publish();
  tell("writing", 1.0);
  return report;
}

}  // namespace adit
