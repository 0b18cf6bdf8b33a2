// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/scip/parameters.hpp"

#include <charconv>
#include <map>
#include <numbers>
#include <string_view>

namespace adit {
namespace {

constexpr std::size_t kTimeCharacters = 4;
constexpr int kStepsMax = 100'000;

/// "DMIN:23" to 23.
std::optional<int> number_in(std::string_view line) {
  const std::string_view text = line.substr(line.find(':') + 1);
  int number = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), number);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  return number;
}

bool is_plausible(const ScipParameters& laser) {
  const bool has_turn = laser.steps_per_turn > 0 && laser.steps_per_turn <= kStepsMax &&
                        laser.scans_per_minute > 0 && laser.scans_per_minute <= kStepsMax;
  const bool has_steps = laser.first_step >= 0 && laser.first_step < laser.last_step &&
                         laser.last_step <= laser.first_step + laser.steps_per_turn &&
                         laser.front_step >= 0 && laser.front_step <= kStepsMax;
  return has_turn && has_steps && laser.range_min_mm >= 0 &&
         laser.range_min_mm < laser.range_max_mm;
}

}  // namespace

double ScipParameters::step_rad() const { return 2.0 * std::numbers::pi / steps_per_turn; }

Result<ScipParameters> read_parameters(const ScipResponse& response) {
  ScipParameters laser;
  std::map<std::string_view, int*> missing{
      {"DMIN", &laser.range_min_mm},    {"DMAX", &laser.range_max_mm},
      {"ARES", &laser.steps_per_turn},  {"AMIN", &laser.first_step},
      {"AMAX", &laser.last_step},       {"AFRT", &laser.front_step},
      {"SCAN", &laser.scans_per_minute}};
  for (const std::string& line : response.lines) {
    const std::string_view key = std::string_view(line).substr(0, line.find(':'));
    if (key == "MODL" && line.size() > key.size()) laser.model = line.substr(key.size() + 1);
    const auto wanted = missing.find(key);
    const auto number = number_in(line);
    if (wanted == missing.end() || !number) continue;
    *wanted->second = *number;
    missing.erase(wanted);
  }
  if (!missing.empty()) return Rejected{"parameters without a number"};
  if (!is_plausible(laser)) return Rejected{"parameters that contradict each other"};
  return laser;
}

Result<ScipReadings> read_readings(const ScipResponse& response, std::size_t characters) {
  if (response.lines.empty() || response.lines[0].size() != kTimeCharacters) {
    return Rejected{"a scan without time"};
  }
  const auto time_ms = scip_number(response.lines[0]);
  if (!time_ms) return Rejected{"a scan without time"};
  std::string data;
  for (std::size_t i = 1; i < response.lines.size(); ++i) data += response.lines[i];
  if (data.empty() || data.size() % characters != 0) return Rejected{"a scan of another length"};
  ScipReadings readings{*time_ms, {}};
  readings.raw_mm.reserve(data.size() / characters);
  for (std::size_t i = 0; i < data.size(); i += characters) {
    const auto distance = scip_number(std::string_view(data).substr(i, characters));
    if (!distance) return Rejected{"a character that encodes no number"};
    readings.raw_mm.push_back(*distance);
  }
  return readings;
}

std::optional<std::uint32_t> read_time(const ScipResponse& response) {
  if (response.lines.size() != 1 || response.lines[0].size() != kTimeCharacters) {
    return std::nullopt;
  }
  return scip_number(response.lines[0]);
}

}  // namespace adit
