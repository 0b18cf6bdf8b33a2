// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/timeline_html.hpp"

#include <algorithm>

#include "tools/report/html.hpp"
#include "tools/report/text.hpp"

namespace adit {
namespace {

constexpr double kWidth = 1000.0;
constexpr double kLeastWidth = 0.8;  // of what is short, so that it is seen
constexpr int kTicks = 5;

/// From times to the width of a lane.
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
  const double width = std::max(scale.at(to_utime) - x, kLeastWidth);
  return std::string("<rect x=\"") + fixed(x, 1) + "\" width=\"" + fixed(width, 1) +
         "\" height=\"10\"><title>" + escaped(text) + "</title></rect>";
}

std::string lane(const std::string& name, const std::string& css_class, const std::string& bars,
                 const std::string& how_long, const std::string& turn) {
  return "<div class=\"lane " + css_class + "\"><span>" + escaped(name) +
         "</span><svg viewBox=\"0 0 1000 10\" preserveAspectRatio=\"none\" role=\"img\" "
         "aria-label=\"" +
         escaped(name + ": " + how_long) + "\">" + bars + turn + "</svg><span>" +
         escaped(how_long) + "</span></div>";
}

std::string stretch_text(const PhaseStretch& stretch) {
  const std::string why = sentence(stretch.phase.reason);
  return clock_text(stretch.phase.utime) + ", " + name_of(stretch.phase.phase) + " for " +
         duration_text(stretch.seconds()) + (why.empty() ? "" : ": " + why);
}

std::string phase_lane(const MissionRecords& records, const PhaseShare& share,
                       const TimeScale& scale, const std::string& turn) {
  std::string bars;
  for (const PhaseStretch& stretch : records.phases.stretches()) {
    if (stretch.phase.phase != share.phase) continue;
    bars += bar(scale, stretch.phase.utime, stretch.to_utime, stretch_text(stretch));
  }
  const std::string name = name_of(share.phase);
  return lane(name, name, bars, duration_text(share.seconds) + ", " + percent(share.share), turn);
}

std::string stop_lane(const MissionRecords& records, const MissionFacts& facts,
                      const TimeScale& scale, const std::string& turn) {
  std::string bars;
  for (const MissionEvent& event : records.events.events()) {
    if (event.kind != MissionEvent::Kind::kStop) continue;
    bars += bar(scale, event.utime, event.to_utime,
                clock_text(event.utime) + ", stopped by the guard for " +
                    duration_text(event.seconds()) + ": " + event.what);
  }
  return bars.empty()
             ? ""
             : lane("guard", "stopped", bars,
                    counted(facts.stops, "stop") + ", " + duration_text(facts.stopped_s), turn);
}

std::string axis(const MissionFacts& facts) {
  std::string ticks;
  for (int i = 0; i < kTicks; ++i) {
    ticks += element("span", duration_text(facts.seconds() * i / (kTicks - 1)));
  }
  return element("div", "<span></span>" + element("div", ticks) + "<span></span>",
                 "class=\"lane axis\" aria-hidden=\"true\"");
}

std::string table(const MissionRecords& records) {
  std::vector<HtmlRow> rows;
  for (const PhaseStretch& stretch : records.phases.stretches()) {
    const MissionPhase& phase = stretch.phase;
    rows.push_back(
        {{clock_text(phase.utime), name_of(phase.phase), duration_text(stretch.seconds()),
          records.phases.said() ? metres(stretch.travelled_to_m) : "",
          phase.homeward ? "homeward" : "", escaped(sentence(phase.reason))}});
  }
  return html_fold(std::string("All phases as a table (") + std::to_string(rows.size()) + ")",
                   html_table("Phases of the mission",
                              {"begin (UTC)", "phase", "length", "way then", "", "why"}, rows));
}

}  // namespace

std::string timeline_html(const MissionRecords& records, const MissionFacts& facts) {
  if (records.phases.stretches().empty()) return "<p>The log tells nothing of the phases.</p>";
  const TimeScale scale(facts.from_utime, facts.to_utime);
  std::string turn;
  if (facts.homeward_utime) {
    const std::string x = fixed(scale.at(*facts.homeward_utime), 1);
    turn = "<path class=\"turn\" d=\"M" + x + " 0V10\"><title>turned around</title></path>";
  }
  std::string lanes;
  for (const PhaseShare& share : facts.phases) {
    if (share.phase != Phase::kEnded) lanes += phase_lane(records, share, scale, turn);
  }
  lanes += stop_lane(records, facts, scale, turn);
  std::string note;
  if (!records.phases.said()) {
    note = element("p",
                   "The log has no PHASE: what is shown was read from scan requests, 3D scans and "
                   "what driving said of itself.",
                   "class=\"note\"");
  }
  return note + element("div", lanes + axis(facts), "class=\"timeline\"") + table(records);
}

}  // namespace adit
