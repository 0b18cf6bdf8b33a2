// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "sim/live/sim_config.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "common/bus/node/stages.hpp"
#include "common/command_line/command_line.hpp"
#include "common/config/config.hpp"
#include "common/config/number_text.hpp"
#include "common/files/file_utils.hpp"
#include "common/text/message_text.hpp"
#include "sim/world/world_file.hpp"

namespace adit {
namespace {

enum class Target { kNone, kLaser, kProcess };

struct Kind {
  std::string_view name;
  Target target;
  bool has_amount;
};

constexpr std::array<Kind, 6> kKinds{{{"laser_dies", Target::kLaser, false},
                                      {"laser_recovers", Target::kLaser, false},
                                      {"time_jump", Target::kNone, true},
                                      {"packet_loss", Target::kNone, true},
                                      {"kill", Target::kProcess, false},
                                      {"suspend", Target::kProcess, false}}};

constexpr const char* kForm = "a fault is KIND[:TARGET][=AMOUNT]@SECONDS";

[[noreturn]] void fail(std::string_view fault, const std::string& reason) {
  throw std::invalid_argument(fmt::format("fault {}: {}", quote(fault), reason));
}

const Kind& kind_of(const FaultDescription& fault) {
  const auto* const kind = std::ranges::find(kKinds, fault.kind, &Kind::name);
  if (kind != kKinds.end()) return *kind;
  std::vector<std::string_view> names;
  for (const Kind& known : kKinds) names.push_back(known.name);
  fail(fault.kind, fmt::format("unknown kind; known: {}", fmt::join(names, ", ")));
}

double number(const std::string& text, const std::string& fault) {
  const auto value = option_number(text);
  if (!value) {
    fail(fault, fmt::format("{} is not a number; {}", quote(text), kForm));
  }
  return *value;
}

/// Removes and returns the text after the last `mark`.
std::optional<std::string> split_off(std::string& text, char mark) {
  const std::size_t at = text.rfind(mark);
  if (at == std::string::npos) return std::nullopt;
  const std::string tail = text.substr(at + 1);
  text.erase(at);
  return tail;
}

}  // namespace

ConfigFile load_config(const std::filesystem::path& path) {
  if (path.empty()) return {};
  ConfigFile file = ConfigFile::load(find_installed_file(path, "config"));
  file.require_known_sections(config_sections());
  return file;
}

FaultDescription parse_fault(const std::string& text) {
  std::string rest = text;
  const auto seconds = split_off(rest, '@');
  if (!seconds) fail(text, fmt::format("it has no time; {}", kForm));
  const auto amount = split_off(rest, '=');
  const auto target = split_off(rest, ':');
  FaultDescription fault;
  fault.kind = rest;
  fault.at_s = number(*seconds, text);
  fault.target = target.value_or("");
  if (amount) fault.amount = number(*amount, text);
  if (amount.has_value() != kind_of(fault).has_amount) {
    fail(text, amount ? "its kind has no amount" : "its kind needs an amount");
  }
  require_complete(fault);
  return fault;
}

void require_complete(const FaultDescription& fault) {
  const Kind& kind = kind_of(fault);
  if (fault.at_s < 0.0) fail(fault.kind, "its time is before the start");
  if (kind.target == Target::kLaser && fault.target != "front" && fault.target != "rear") {
    fail(fault.kind, "its target must be front or rear");
  }
  if (kind.target == Target::kProcess && fault.target.empty()) {
    fail(fault.kind, "its target must be the name of a stage");
  }
  if (kind.target == Target::kNone && !fault.target.empty()) {
    fail(fault.kind, "its kind has no target");
  }
  if (fault.kind == "packet_loss" && (fault.amount < 0.0 || fault.amount > 1.0)) {
    fail(fault.kind, "its amount must be a fraction, 0 to 1");
  }
}

bool is_process_fault(const FaultDescription& fault) {
  return kind_of(fault).target == Target::kProcess;
}

void reject_process_faults(const std::vector<FaultDescription>& faults) {
  for (const FaultDescription& fault : faults) {
    if (is_process_fault(fault)) {
      fail(fmt::format("{}:{}", fault.kind, fault.target), "this run has a single process");
    }
  }
}

SimulationParams load_simulation_params(const std::filesystem::path& config,
                                        const std::vector<std::string>& faults) {
  auto params = load_section<SimulationParams>(load_config(config), kSimSection);
  for (const FaultDescription& fault : params.faults) require_complete(fault);
  for (const std::string& fault : faults) params.faults.push_back(parse_fault(fault));
  return params;
}

std::string yaml_in_effect(const SimulationParams& params, const WorldDescription& world) {
  return to_yaml(params, kSimSection) + to_world_file(world);
}

}  // namespace adit
