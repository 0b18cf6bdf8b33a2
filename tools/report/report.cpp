// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/report.hpp"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "common/bus/channels.hpp"
#include "common/bus/log/event_source.hpp"
#include "common/bus/log/lcm_log.hpp"
#include "common/files/file_utils.hpp"
#include "tools/map/result_folder.hpp"
#include "tools/report/page/scan_cards.hpp"
#include "tools/report/records/mission_log_reader.hpp"
#include "tools/report/report_files.hpp"
#include "tools/report/text_format.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

/// Writes run.lcmlog into `unfinished`: a hard link to one log, or a copy where links are not
/// possible; several logs are concatenated and their events renumbered. It is run.lcmlog.zst if the
/// first log is compressed. Does nothing if the first log is that of `folder`: it is the folder of
/// the mission, which has all its logs. Throws std::runtime_error if the file cannot be written.
void store_log(const std::vector<fs::path>& logs, const fs::path& folder,
               const fs::path& unfinished) {
  const bool compressed = logs.front().extension() == LogWriter::kCompressedExtension;
  const fs::path name = compressed ? compressed_name("run.lcmlog") : "run.lcmlog";
  const fs::path target = unfinished / name;
  std::error_code error;
  if (fs::equivalent(logs.front(), folder / name, error)) return;
  if (logs.size() == 1) {
    fs::create_hard_link(fs::canonical(logs.front()), target, error);
    if (error) fs::copy_file(logs.front(), target);
    return;
  }
  LogWriter writer(target);
  for (const fs::path& log : logs) {
    LogReader reader(log);
    while (const auto event = reader.next()) writer.write(*event);
  }
  writer.close();
}

LogInfo read_mission_log_info(const ReportOptions& options) {
  LogInfo log_info = read_log_info(options.logs);
  for (const auto channel :
       {channels::kPhase, channels::kPose, channels::kLocalMap, channels::kCloud}) {
    if (log_info.has(channel)) return log_info;
  }
  throw std::runtime_error(
      fmt::format("no mission in {}: it has none of PHASE, POSE, LOCAL_MAP and CLOUD",
                  options.logs.front().string()));
}

std::string title_of(const LogInfo& log_info) {
  return fmt::format("Mission of {:.10}", date_text(log_info.first_utime));
}

MapContent map_content(const MissionRecords& records, const MissionStatistics& statistics,
                       const MissionMap& map, const std::optional<OccupancyGrid>& grid) {
  const auto& exploration = records.state.exploration();
  return {&map, grid ? &*grid : nullptr, exploration ? &*exploration : nullptr,
          scan_marks(records, map), statistics.return_home_utime};
}

std::vector<std::string> collect_warnings(const LogInfo& log_info, const MissionLogReader& reader,
                                          const MissionMap& map) {
  std::vector<std::string> warnings = log_info.warnings;
  for (std::string& warning : reader.warnings()) {
    const bool is_new = std::find(warnings.begin(), warnings.end(), warning) == warnings.end();
    if (is_new) warnings.push_back(std::move(warning));
  }
  if (map.missing_local_maps() > 0) {
    warnings.push_back(fmt::format("{} of the pose graph missing in the log",
                                   count_text(map.missing_local_maps(), "local map")));
  }
  return warnings;
}

}  // namespace

MissionReport write_report(const ReportOptions& given, const ReportProgress& progress) {
  ReportOptions options = given;
  options.logs = in_order_of_time(std::move(options.logs));
  const auto report_progress = [&](const std::string& label, double done) {
    if (progress) progress(label, done);
  };
  const LogInfo log_info = read_mission_log_info(options);
  const ResultFolder results(options.folder);
  MissionLogReader reader(log_info, options.remap, options.viewer_page);
  reader.read(options, [&](double done) { report_progress("reading", done); });

  report_progress("drawing", 0.0);
  const MissionMap map(reader.map());
  const auto grid = map.grid(log_info.lasers);
  const MissionRecords records = reader.records();
  const MissionStatistics statistics = mission_statistics(records, map);
  const MapContent content = map_content(records, statistics, map, grid);
  const std::string title = title_of(log_info);
  report_progress("writing", 0.3);
  MissionReport report{outcome_text(statistics),
                       accuracy_text(statistics),
                       statistics.scans,
                       statistics.distance_travelled_m,
                       0,
                       collect_warnings(log_info, reader, map)};
  for (std::string& warning : write_report_files(
           {records, statistics, content, reader.volume(), title}, results.unfinished())) {
    report.warnings.push_back(std::move(warning));
  }
  if (auto& page = reader.page()) {
    const std::string html =
        page->html(records, statistics, map, content.grid, title, report.warnings);
    report.page_bytes = html.size();
    write_text_file(html, results.unfinished() / "mission.html");
  } else {
    report.warnings.emplace_back("no mission.html: this build has no page of the viewer");
  }
  store_log(options.logs, options.folder, results.unfinished());
  results.publish();
  report_progress("writing", 1.0);
  return report;
}

}  // namespace adit
