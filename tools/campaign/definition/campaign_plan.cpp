// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/definition/campaign_plan.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "common/files/file_error.hpp"
#include "common/files/file_utils.hpp"
#include "common/seal/sha256.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

constexpr const char* kOut = "{out}";
constexpr const char* kIdFormat = "adit campaign unit 1";  // changes with what an id covers
constexpr std::size_t kIdDigits = 16;  // two of 10^6 units share one with probability 3e-8

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  for (auto at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
    text.replace(at, what.size(), by);
  return text;
}

void shuffle_by_parameters(std::vector<CampaignUnit>& units) {
  std::vector<std::pair<std::string, std::size_t>> order;
  for (std::size_t i = 0; i < units.size(); ++i)
    order.emplace_back(sha256_hex(units[i].parameters), i);
  std::ranges::sort(order);
  std::vector<CampaignUnit> shuffled;
  for (const auto& [hash, i] : order) shuffled.push_back(std::move(units[i]));
  units = std::move(shuffled);
}

}  // namespace

UnitMaker::UnitMaker(const CampaignDefinition& campaign, std::string file, fs::path folder,
                     fs::path programs)
    : file_(std::move(file)),
      folder_(std::move(folder)),
      programs_(std::move(programs)),
      files_(campaign.files) {
  command_ = words(campaign.command, "command");
  if (!campaign.inputs.empty()) inputs_ = words(campaign.inputs, "inputs").arguments;
}

CampaignUnit UnitMaker::unit(const UnitParameters& parameters) {
  CampaignUnit unit;
  unit.parameters = parameters.json();
  unit.environment = command_.environment;
  for (auto& [name, value] : unit.environment) value = expanded(value, parameters, "command");
  for (const std::string& word : command_.arguments)
    unit.arguments.push_back(expanded(word, parameters, "command"));
  for (const UnitFileDefinition& file : files_) {
    unit.files.emplace_back(expanded(file.name, parameters, "files"),
                            expanded(file.text, parameters, "files"));
  }
  const fs::path program = find_program(unit.arguments.front());
  unit.arguments.front() = program.string();
  unit.id = id(unit, program, parameters);
  return unit;
}

void UnitMaker::fail(const std::string& key, const std::string& reason) const {
  throw ConfigError(fmt::format("{}: campaign.{} {}", file_, key, reason));
}

CommandLine UnitMaker::words(const std::string& text, const std::string& key) const {
  const Result<CommandLine> line = parse_command_line(text);
  if (!line) fail(key, fmt::format("{} has: {}", quote(text), line.rejection()));
  return *line;
}

std::string UnitMaker::expanded(const std::string& text, const UnitParameters& parameters,
                                const std::string& key) const {
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool is_double = text.compare(i, 2, "{{") == 0 || text.compare(i, 2, "}}") == 0;
    if (is_double) {
      result += text[i++];
      continue;
    }
    if (text[i] != '{') {
      result += text[i];
      continue;
    }
    const std::size_t end = text.find('}', i);
    if (end == std::string::npos) fail(key, "has a { without a }: " + quote(text));
    const std::string name = text.substr(i + 1, end - i - 1);
    const ParameterValue* const value = parameters.find(name);
    if (!value && name != "out")
      fail(key, fmt::format("has the placeholder {} that is no parameter of {}", quote(name),
                            parameters.json()));
    result += value ? value->text : kOut;
    i = end;
  }
  return result;
}

fs::path UnitMaker::find_program(const std::string& name) {
  const auto [found, is_new] = programs_found_.try_emplace(name);
  if (is_new) found->second = search_program(name);
  return found->second;
}

fs::path UnitMaker::search_program(const std::string& name) const {
  std::vector<fs::path> candidates;
  if (name.find('/') != std::string::npos) {
    candidates.push_back(folder_ / name);
  } else {
    candidates.push_back(programs_ / name);
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path ? path : "/usr/local/bin:/usr/bin:/bin");
    for (std::string folder; std::getline(folders, folder, ':');)
      candidates.push_back(fs::path(folder.empty() ? "." : folder) / name);
  }
  for (const fs::path& candidate : candidates) {
    if (access(candidate.c_str(), X_OK) == 0 && !fs::is_directory(candidate))
      return fs::absolute(candidate).lexically_normal();
  }
  fail("command", "has no program " + quote(name));
}

const std::string& UnitMaker::hash_of(const fs::path& path, const std::string& key) {
  const auto [found, is_new] = hashes_.try_emplace(path.string());
  if (is_new) {
    try {
      found->second = sha256_of_file(path);
    } catch (const FileError& error) {
      fail(key, std::string("has ") + error.what());
    }
  }
  return found->second;
}

/// What the result depends on. The program counts by content, not by its path.
std::string UnitMaker::id(const CampaignUnit& unit, const fs::path& program,
                          const UnitParameters& parameters) {
  std::set<std::string> inputs;
  for (const std::string& input : inputs_) inputs.insert(expanded(input, parameters, "inputs"));
  for (const auto& [name, value] : parameters.values()) {
    if (value.is_file) inputs.insert(value.text);
  }
  Json content{kIdFormat, hash_of(program, "command"), unit.environment};
  content.push_back(std::vector(unit.arguments.begin() + 1, unit.arguments.end()));
  if (!unit.files.empty()) content.push_back(unit.files);
  for (const std::string& input : inputs)
    content.push_back({input, hash_of(folder_ / input, "inputs")});
  return sha256_hex(content.dump(-1, ' ', false, Json::error_handler_t::replace))
      .substr(0, kIdDigits);
}

std::string shell_word(const std::string& word) {
  const bool is_plain = !word.empty() && std::ranges::all_of(word, [](unsigned char c) {
    return std::isalnum(c) != 0 ||
           std::string_view("_-./:=,+@%").find(static_cast<char>(c)) != std::string_view::npos;
  });
  if (is_plain) return word;
  std::string quoted = "'";
  quoted.append(replaced(word, "'", "'\\''"));
  return quoted.append("'");
}

fs::path own_program_folder() { return fs::read_symlink("/proc/self/exe").parent_path(); }

CampaignPlan plan_without_units(const CampaignDefinition& campaign, const std::string& file,
                                const fs::path& folder) {
  CampaignPlan plan;
  plan.folder = fs::absolute(folder).lexically_normal();
  plan.time_max_s = campaign.time_max_s;
  plan.memory_max_mb = campaign.memory_max_mb;
  for (const double code : campaign.exit_codes)
    plan.exit_codes.push_back(static_cast<int>(std::lround(code)));
  if (!campaign.remove.empty()) {
    const Result<CommandLine> patterns = parse_command_line(campaign.remove);
    if (!patterns)
      throw ConfigError(fmt::format("{}: campaign.remove has: {}", file, patterns.rejection()));
    plan.remove = patterns->arguments;
  }
  return plan;
}

CampaignPlan make_plan(const CampaignDefinition& campaign,
                       const std::vector<UnitParameters>& parameters, const std::string& file,
                       const fs::path& folder, const fs::path& programs) {
  CampaignPlan plan = plan_without_units(campaign, file, folder);
  UnitMaker maker(campaign, file, plan.folder, programs);
  std::map<std::string, std::size_t> by_id;
  for (const UnitParameters& of_unit : parameters) {
    CampaignUnit unit = maker.unit(of_unit);
    const auto [first, is_new] = by_id.try_emplace(unit.id, plan.units.size());
    if (!is_new)
      throw ConfigError(fmt::format("{}: the units {} and {} are the same command", file,
                                    plan.units[first->second].parameters, unit.parameters));
    plan.units.push_back(std::move(unit));
  }
  if (campaign.stops_early()) shuffle_by_parameters(plan.units);
  for (std::size_t i = 0; i < plan.units.size(); ++i)
    plan.units[i].number = static_cast<int>(i) + 1;
  return plan;
}

std::vector<std::string> with_output(const std::vector<std::string>& arguments,
                                     const std::string& out) {
  std::vector<std::string> result;
  for (const std::string& argument : arguments) result.push_back(replaced(argument, kOut, out));
  return result;
}

std::string shell_line(const CampaignPlan& plan, const CampaignUnit& unit, const std::string& out) {
  std::string line = fmt::format("cd {} &&", shell_word(plan.folder.string()));
  const std::vector<std::string> words = with_output(unit.arguments, out);
  if (words != unit.arguments || !unit.files.empty())
    line += fmt::format(" mkdir -p {} &&", shell_word(out));
  for (const auto& [name, text] : unit.files) {
    const fs::path path = fs::path(out) / name;
    line +=
        fmt::format(" mkdir -p {} && printf %s {} > {} &&", shell_word(path.parent_path().string()),
                    shell_word(with_output({text}, out).front()), shell_word(path.string()));
  }
  for (const auto& [name, value] : unit.environment)
    line += fmt::format(" {}={}", name, shell_word(value));
  for (const std::string& word : words) line += fmt::format(" {}", shell_word(word));
  return line;
}

void write_plan(const CampaignPlan& plan, const fs::path& path) {
  std::string text = Json{{"folder", plan.folder.string()},
                          {"time_max_s", plan.time_max_s},
                          {"memory_max_mb", plan.memory_max_mb},
                          {"exit_codes", plan.exit_codes},
                          {"remove", plan.remove}}
                         .dump(-1, ' ', false, Json::error_handler_t::replace) +
                     "\n";
  for (const CampaignUnit& unit : plan.units) {
    text += Json{{"id", unit.id},
                 {"number", unit.number},
                 {"parameters", unit.parameters},
                 {"environment", unit.environment},
                 {"arguments", unit.arguments},
                 {"files", unit.files}}
                .dump(-1, ' ', false, Json::error_handler_t::replace) +
            "\n";
  }
  write_text_file(text, path);
}

CampaignPlan read_plan(const fs::path& path, const std::string& id) try {
  std::ifstream file(path);
  if (!file) throw FileError(path.string() + ": cannot be read");
  std::string line;
  std::getline(file, line);
  const Json common = Json::parse(line);
  CampaignPlan plan;
  plan.folder = common.at("folder").get<std::string>();
  plan.time_max_s = common.at("time_max_s");
  plan.memory_max_mb = common.at("memory_max_mb");
  common.at("exit_codes").get_to(plan.exit_codes);
  common.at("remove").get_to(plan.remove);
  while (std::getline(file, line)) {
    if (line.find(id) == std::string::npos) continue;
    const Json json = Json::parse(line);
    if (json.at("id") != id) continue;
    CampaignUnit unit;
    unit.id = id;
    unit.number = json.at("number");
    unit.parameters = json.at("parameters");
    json.at("environment").get_to(unit.environment);
    json.at("arguments").get_to(unit.arguments);
    json.at("files").get_to(unit.files);
    plan.units.push_back(std::move(unit));
    return plan;
  }
  throw FileError(fmt::format("{}: has no unit {}", path.string(), quote(id)));
} catch (const nlohmann::json::exception&) {
  throw FileError(path.string() + ": is not the plan of a campaign");
}

}  // namespace adit
