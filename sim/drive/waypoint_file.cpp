// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/drive/waypoint_file.hpp"

#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include "common/config/number_text.hpp"

namespace adit {
namespace {

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream text(line.substr(0, line.find('#')));
  std::vector<std::string> words;
  for (std::string word; text >> word;) words.push_back(word);
  return words;
}

double number(const std::string& word) {
  const auto value = parse_number<double>(word);
  if (!value || !std::isfinite(*value)) throw std::runtime_error("'" + word + "' is not a number");
  return *value;
}

Waypoint waypoint(const std::vector<std::string>& words) {
  if (words.size() != 2 && words.size() != 3) {
    throw std::runtime_error("expected 'x y' or 'x y speed'");
  }
  Waypoint waypoint{{number(words[0]), number(words[1])}, std::nullopt};
  if (words.size() == 3) {
    waypoint.speed_m_s = number(words[2]);
    if (*waypoint.speed_m_s <= 0.0) throw std::runtime_error("the speed must be above 0");
  }
  return waypoint;
}

}  // namespace

std::vector<Waypoint> read_waypoints(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file || std::filesystem::is_directory(path)) {
    throw std::runtime_error("cannot read " + path.string());
  }
  std::vector<Waypoint> waypoints;
  std::string line;
  for (int number_of_line = 1; std::getline(file, line); ++number_of_line) {
    const auto words = words_of(line);
    if (words.empty()) continue;
    try {
      waypoints.push_back(waypoint(words));
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(path.string() + ':' + std::to_string(number_of_line) + ": " +
                               error.what());
    }
  }
  if (waypoints.empty()) throw std::runtime_error(path.string() + ": no waypoint");
  return waypoints;
}

}  // namespace adit
