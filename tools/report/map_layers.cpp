// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/map_layers.hpp"

#include <algorithm>

#include "tools/map/graph_files.hpp"
#include "tools/report/text.hpp"

namespace adit {
namespace {

constexpr double kAimUnits = 12.0;
constexpr double kPathStepUnits = 0.6;  // finer than what is seen

std::string group(const char* layer, const std::string& parts) {
  return parts.empty() ? "" : std::string("<g class=\"") + layer + "\">" + parts + "</g>";
}

std::string line(const char* css_class, const std::string& d) {
  return d.empty() ? "" : std::string("<path class=\"") + css_class + "\" d=\"" + d + "\"/>";
}

std::string disc(const std::string& css_class, const Eigen::Vector2d& at, double radius,
                 const std::string& text = "") {
  const std::string circle = "<circle class=\"" + css_class + "\" cx=\"" + fixed(at.x(), 1) +
                             "\" cy=\"" + fixed(at.y(), 1) + "\" r=\"" + fixed(radius, 1) + "\"";
  return text.empty() ? circle + "/>" : circle + "><title>" + escaped(text) + "</title></circle>";
}

/// Two places and the line between them.
std::string stroke(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  std::string d(1, 'M');
  d += svg_point(a);
  d += 'L';
  d += svg_point(b);
  return d;
}

std::string edges(const std::vector<GraphPicture::Edge>& edges, const MapView& view) {
  std::string d;
  for (const auto& [a, b] : edges) d += stroke(view.at(a), view.at(b));
  return d;
}

/// A way between two times, without the steps that nobody sees.
std::string way(const Trajectory& path, std::int64_t from_utime, std::int64_t to_utime,
                const MapView& view) {
  std::string d;
  std::optional<Eigen::Vector2d> last;
  for (const TimedPose& pose : path) {
    if (pose.utime < from_utime || pose.utime > to_utime) continue;
    const Eigen::Vector2d at = view.at(pose.pose.translation());
    if (last && (at - *last).norm() < kPathStepUnits && pose.utime < path.back().utime) continue;
    d += last ? 'L' : 'M';
    d += svg_point(at);
    last = at;
  }
  return d;
}

std::string css_of(StubState state) {
  if (!is_closed(state)) return "open";
  return state == StubState::kExplored || state == StubState::kWayOut ? "done" : "closed";
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
  }
  return "";
}

std::string corridors_svg(const CorridorGraph& graph, const MapView& view) {
  std::string parts;
  for (const Corridor& corridor : graph.corridors) {
    std::string d;
    for (const Eigen::Vector2d& p : corridor.points) {
      d += d.empty() ? 'M' : 'L';
      d += svg_point(view.at(p));
    }
    parts += line("corridor", d);
  }
  for (const CorridorNode& node : graph.nodes) {
    using Kind = CorridorNode::Kind;
    if (node.kind == Kind::kJunction) parts += disc("junction", view.at(node.p_map), 3, "junction");
    if (node.kind == Kind::kDeadEnd)
      parts += disc("dead-end", view.at(node.p_map), 2.5, "dead end");
  }
  return group("layer-corridors", parts);
}

std::string graph_svg(const MissionMap& map, const MapView& view) {
  const GraphPicture graph = graph_picture(map.whole());
  std::string nodes;
  for (const Pose2& node : graph.nodes) nodes += disc("node", view.at(node.translation()), 1.2);
  return group("layer-graph", line("edge", edges(graph.sequential, view)) + nodes +
                                  line("closure", edges(graph.closures, view))) +
         group("layer-revoked", line("revoked", edges(graph.revoked, view)));
}

std::string ways_svg(const Trajectory& path, const std::optional<std::int64_t>& homeward_utime,
                     const MapView& view) {
  if (path.empty()) return "";
  const std::int64_t end = path.back().utime;
  const std::int64_t turn = homeward_utime.value_or(end);
  const std::string home = homeward_utime ? way(path, turn, end, view) : "";
  return group("layer-way",
               line("out", way(path, path.front().utime, turn, view)) + line("back", home));
}

std::string stubs_svg(const std::vector<Stub>& stubs, const MapView& view,
                      const std::string& page) {
  std::string parts;
  for (const bool closed : {true, false}) {  // what is open over what is closed
    for (const Stub& stub : stubs) {
      if (is_closed(stub.state) != closed) continue;
      const std::string css = css_of(stub.state);
      const Eigen::Vector2d at = view.at(stub.p_map);
      const Eigen::Vector2d aim(stub.direction_map.x(), -stub.direction_map.y());
      const std::string id = std::to_string(stub.id);
      parts += "<a href=\"" + page + "#stub-" + id + "\">";
      if (css != "done") {
        parts += line(("aim " + css).c_str(), stroke(at, at + kAimUnits * aim));
      }
      parts += disc("stub " + css, at, css == "done" ? 2.6 : 4.5,
                    "Opening " + id + ", " + name_of(stub.state) + ": " + stub.evidence) +
               "</a>";
    }
  }
  return group("layer-stubs", parts);
}

std::string scans_svg(const std::vector<ScanMark>& scans, const MapView& view,
                      const std::string& page) {
  constexpr double kRadius = 7.5;
  constexpr double kBeside = 16.0;
  constexpr int kRowsMax = 4;
  std::vector<Eigen::Vector2d> taken;
  std::string parts;
  for (const ScanMark& scan : scans) {
    const Eigen::Vector2d place = view.at(scan.T_map_ahead.translation());
    const Eigen::Vector2d left(-std::sin(scan.T_map_ahead.theta),
                               -std::cos(scan.T_map_ahead.theta));
    Eigen::Vector2d at = place + kBeside * left;
    const auto is_taken = [&](const Eigen::Vector2d& other) {
      return (other - at).norm() < 2.0 * kRadius;
    };
    for (int row = 2; row <= kRowsMax && std::any_of(taken.begin(), taken.end(), is_taken); ++row) {
      at = place + row * kBeside * left;
    }
    taken.push_back(at);
    const std::string number = std::to_string(scan.number);
    parts += "<a class=\"scan" + std::string(scan.found ? "" : " stuck") + "\" href=\"" + page +
             "#scan-" + number + "\"><title>" + escaped(scan.text) + "</title>" +
             line("lead", stroke(place, at)) + disc("mark", at, kRadius) + "<text x=\"" +
             fixed(at.x(), 1) + "\" y=\"" + fixed(at.y() + 3.0, 1) + "\">" + number + "</text></a>";
  }
  return group("layer-scans", parts);
}

std::string start_svg(const Trajectory& path, const MapView& view) {
  if (path.empty()) return "";
  return disc("home", view.at(path.front().pose.translation()), 6.0, "where it started") +
         disc("end", view.at(path.back().pose.translation()), 4.0, "where it stood at last");
}

}  // namespace adit
