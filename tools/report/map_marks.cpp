// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>

#include "tools/report/map_layers.hpp"
#include "tools/report/svg_parts.hpp"
#include "tools/report/text.hpp"

namespace adit {
namespace {

constexpr double kAimUnits = 12.0;
constexpr double kRadius = 7.5;
constexpr double kBeside = 16.0;
constexpr int kRowsMax = 4;

std::string css_of(StubState state) {
  if (!is_closed(state)) return "open";
  return state == StubState::kExplored || state == StubState::kWayOut ? "done" : "closed";
}

std::string stub_svg(const Stub& stub, const MapView& view, const std::string& page) {
  const std::string css = css_of(stub.state);
  const Eigen::Vector2d at = view.at(stub.p_map);
  const Eigen::Vector2d aim(stub.direction_map.x(), -stub.direction_map.y());
  const std::string id = std::to_string(stub.id);
  const std::string text = "Opening " + id + ", " + name_of(stub.state) + ": " + stub.evidence;
  const bool done = css == "done";
  return "<a href=\"" + page + "#stub-" + id + "\">" +
         (done ? std::string() : svg_line("aim " + css, svg_stroke(at, at + kAimUnits * aim))) +
         svg_disc("stub " + css, at, done ? 2.6 : 4.5, text) + "</a>";
}

std::string scan_svg(const ScanMark& scan, const Eigen::Vector2d& place, const Eigen::Vector2d& at,
                     const std::string& page) {
  const std::string number = std::to_string(scan.number);
  const std::string css = scan.found ? "scan" : "scan stuck";
  return "<a class=\"" + css + "\" href=\"" + page + "#scan-" + number + "\"><title>" +
         escaped(scan.text) + "</title>" + svg_line("lead", svg_stroke(place, at)) +
         svg_disc("mark", at, kRadius) + "<text x=\"" + fixed(at.x(), 1) + "\" y=\"" +
         fixed(at.y() + 3.0, 1) + "\">" + number + "</text></a>";
}

/// Beside the way, as far from it as it takes not to lie on another.
Eigen::Vector2d free_place(const Eigen::Vector2d& place, const Eigen::Vector2d& left,
                           const std::vector<Eigen::Vector2d>& taken) {
  const auto is_free = [&](const Eigen::Vector2d& at) {
    return std::none_of(taken.begin(), taken.end(), [&](const Eigen::Vector2d& other) {
      return (other - at).norm() < 2.0 * kRadius;
    });
  };
  int row = 1;
  while (row < kRowsMax && !is_free(place + row * kBeside * left)) ++row;
  return place + row * kBeside * left;
}

}  // namespace

const char* name_of(StubState state) {
  switch (state) {
    case StubState::kOpen:
      return "open";
    case StubState::kExplored:
      return "explored";
    case StubState::kBlocked:
      return "blocked";
    case StubState::kTooNarrow:
      return "too narrow";
    case StubState::kBeyondBudget:
      return "too far";
    case StubState::kUnseeable:
      return "nothing came back";
    case StubState::kWayOut:
      return "the way out";
    case StubState::kDoubtful:
      return "no way found, doubtful";
  }
  return "";
}

std::string stubs_svg(const std::vector<Stub>& stubs, const MapView& view,
                      const std::string& page) {
  std::string parts;
  for (const bool closed : {true, false}) {  // what is open over what is closed
    for (const Stub& stub : stubs) {
      if (is_closed(stub.state) == closed) parts += stub_svg(stub, view, page);
    }
  }
  return svg_group("layer-stubs", parts);
}

std::string scans_svg(const std::vector<ScanMark>& scans, const MapView& view,
                      const std::string& page) {
  std::vector<Eigen::Vector2d> taken;
  std::string parts;
  for (const ScanMark& scan : scans) {
    const double heading = scan.T_map_ahead.theta;
    const Eigen::Vector2d place = view.at(scan.T_map_ahead.translation());
    const Eigen::Vector2d left(-std::sin(heading), -std::cos(heading));
    taken.push_back(free_place(place, left, taken));
    parts += scan_svg(scan, place, taken.back(), page);
  }
  return svg_group("layer-scans", parts);
}

}  // namespace adit
