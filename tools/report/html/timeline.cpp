// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "tools/report/html/markup.hpp"
#include "tools/report/html/mission_page.hpp"
#include "tools/report/html/text_format.hpp"

namespace adit {
namespace {

constexpr double kWidth = 1000.0;
constexpr double kBarWidthMin = 0.8;  // keeps short intervals visible
constexpr int kTicks = 5;

/// Maps times to x coordinates of a lane.
class TimeScale {
 public:
  TimeScale(std::int64_t from_utime, std::int64_t to_utime)
      : from_(from_utime), length_(std::max<std::int64_t>(to_utime - from_utime, 1)) {}

  [[nodiscard]] double at(std::int64_t utime) const {
    const double share = static_cast<double>(utime - from_) / static_cast<double>(length_);
    return kWidth * std::clamp(share, 0.0, 1.0);
  }

 private:
  std::int64_t from_;
  std::int64_t length_;
};

std::string bar(const TimeScale& scale, std::int64_t from_utime, std::int64_t to_utime,
                const std::string& text) {
  const double x = scale.at(from_utime);
  const double width = std::max(scale.at(to_utime) - x, kBarWidthMin);
  return fmt::format(R"(<rect x="{}" width="{}" height="10"><title>{}</title></rect>)", fixed(x, 1),
                     fixed(width, 1), escaped(text));
}

std::string lane(const std::string& name, const std::string& css_class, const std::string& bars,
                 const std::string& summary, const std::string& turn) {
  return fmt::format(
      R"(<div class="lane {}"><span>{}</span><svg viewBox="0 0 1000 10" preserveAspectRatio="none" )"
      R"(role="img" aria-label="{}">{}{}</svg><span>{}</span></div>)",
      css_class, escaped(name), escaped(fmt::format("{}: {}", name, summary)), bars, turn,
      escaped(summary));
}

std::string interval_text(const PhaseInterval& interval) {
  const std::string reason = sentence(interval.phase.reason);
  return fmt::format("{}, {} for {}{}{}", clock_text(interval.phase.utime),
                     name_of(interval.phase.phase), duration_text(interval.duration_s()),
                     reason.empty() ? "" : ": ", reason);
}

std::string phase_lane(const MissionRecords& records, const PhaseShare& share,
                       const TimeScale& scale, const std::string& turn) {
  std::string bars;
  for (const PhaseInterval& interval : records.phases.intervals()) {
    if (interval.phase.phase != share.phase) continue;
    bars += bar(scale, interval.phase.utime, interval.to_utime, interval_text(interval));
  }
  const std::string name = name_of(share.phase);
  return lane(name, name, bars,
              fmt::format("{}, {}", duration_text(share.duration_s), percent(share.share)), turn);
}

std::string stop_lane(const MissionRecords& records, const MissionStatistics& statistics,
                      const TimeScale& scale, const std::string& turn) {
  std::string bars;
  for (const MissionEvent& event : records.events.events()) {
    if (event.kind != MissionEvent::Kind::kStop) continue;
    bars += bar(scale, event.utime, event.to_utime,
                fmt::format("{}, stopped by the guard for {}: {}", clock_text(event.utime),
                            duration_text(event.duration_s()), event.description));
  }
  if (bars.empty()) return "";
  return lane("stopped", "stopped", bars,
              fmt::format("{}, {}", count_text(statistics.stops, "stop"),
                          duration_text(statistics.stopped_s)),
              turn);
}

std::string axis(const MissionStatistics& statistics) {
  std::string ticks;
  for (int i = 0; i < kTicks; ++i) {
    ticks += element("span", duration_text(statistics.duration_s() * i / (kTicks - 1)));
  }
  return element("div", "<span></span>" + element("div", ticks) + "<span></span>",
                 "class=\"lane axis\" aria-hidden=\"true\"");
}

std::string phase_table(const MissionRecords& records) {
  std::vector<HtmlRow> rows;
  for (const PhaseInterval& interval : records.phases.intervals()) {
    const MissionPhase& phase = interval.phase;
    rows.push_back(
        {{clock_text(phase.utime), name_of(phase.phase), duration_text(interval.duration_s()),
          records.phases.reported() ? metres(interval.end_distance_travelled_m) : "",
          phase.returning_home ? "returning" : "outbound", escaped(sentence(phase.reason))}});
  }
  return html_details(
      fmt::format("All phases as a table ({})", rows.size()),
      html_table("Phases of the mission",
                 {"start (UTC)", "phase", "duration", "distance at the end", "direction", "reason"},
                 rows));
}

}  // namespace

std::string timeline_html(const MissionRecords& records, const MissionStatistics& statistics) {
  if (records.phases.intervals().empty()) return "<p>The log has no phases.</p>";
  const TimeScale scale(statistics.from_utime, statistics.to_utime);
  std::string turn;
  if (statistics.return_home_utime) {
    turn = fmt::format(R"(<path class="turn" d="M{} 0V10"><title>return home</title></path>)",
                       fixed(scale.at(*statistics.return_home_utime), 1));
  }
  std::string lanes;
  for (const PhaseShare& share : statistics.phases) {
    if (share.phase != Phase::kEnded) lanes += phase_lane(records, share, scale, turn);
  }
  lanes += stop_lane(records, statistics, scale, turn);
  std::string note;
  if (!records.phases.reported()) {
    note = element("p",
                   "The log has no PHASE. The phases are inferred from SCAN_REQUEST, CLOUD and "
                   "DRIVING_STATE.",
                   "class=\"note\"");
  }
  return note + element("div", lanes + axis(statistics), "class=\"timeline\"") +
         phase_table(records);
}

}  // namespace adit
