// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/drive/waypoint_file.hpp"

#include <cmath>
#include <istream>
#include <sstream>
#include <stdexcept>
#include <string>

#include <fmt/format.h>

#include "common/config/number_text.hpp"
#include "common/files/file_utils.hpp"
#include "common/text/message_text.hpp"
#include "sim/world/built_in_world_files.hpp"

namespace adit {
namespace {

std::vector<std::string> split(const std::string& line) {
  std::istringstream text(line.substr(0, line.find('#')));
  std::vector<std::string> fields;
  for (std::string field; text >> field;) fields.push_back(field);
  return fields;
}

double parse(const std::string& field) {
  const auto value = parse_number<double>(field);
  if (!value || !std::isfinite(*value)) {
    throw std::runtime_error(fmt::format("{} is not a number", quote(field)));
  }
  return *value;
}

Waypoint parse_waypoint(const std::vector<std::string>& fields) {
  if (fields.size() != 2 && fields.size() != 3) {
    throw std::runtime_error("expected 'x y' or 'x y speed'");
  }
  Waypoint waypoint{{parse(fields[0]), parse(fields[1])}, std::nullopt};
  if (fields.size() == 3) {
    waypoint.speed_m_s = parse(fields[2]);
    if (*waypoint.speed_m_s <= 0.0) throw std::runtime_error("the speed must be above 0");
  }
  return waypoint;
}

/// `name` is that of the file, for errors.
std::vector<Waypoint> parse_waypoints(std::istream& text, const std::string& name) {
  std::vector<Waypoint> waypoints;
  std::string line;
  for (int line_number = 1; std::getline(text, line); ++line_number) {
    const auto fields = split(line);
    if (fields.empty()) continue;
    try {
      waypoints.push_back(parse_waypoint(fields));
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(fmt::format("{}:{}: {}", name, line_number, error.what()));
    }
  }
  if (waypoints.empty()) throw std::runtime_error(fmt::format("{}: no waypoint", name));
  return waypoints;
}

}  // namespace

std::vector<Waypoint> read_waypoints(const std::filesystem::path& path) {
  std::istringstream file(read_text_file(path));
  return parse_waypoints(file, path.string());
}

std::vector<Waypoint> built_in_drive(const std::string& world) {
  for (const WorldFileText& file : built_in_world_files()) {
    if (file.name != world || file.drive.empty()) continue;
    std::istringstream text(file.drive);
    return parse_waypoints(text, world + "_drive.txt");
  }
  throw std::runtime_error(fmt::format("there is no built-in drive through {}", quote(world)));
}

}  // namespace adit
