// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/definition/campaign_definition.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "common/config/config.hpp"
#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr const char* kSection = "campaign";

[[noreturn]] void fail(const ConfigFile& file, const std::string& key, const std::string& reason) {
  const ConfigNode* const section = file.section(kSection);
  throw ConfigError(fmt::format("{}:{}: {}{}{} {}", file.name(), section ? section->line : 1,
                                kSection, key.empty() ? "" : ".", key, reason));
}

void check_score(const ConfigFile& file, const std::string& key, const ScoreDefinition& score) {
  if (!is_column_name(score.name))
    fail(file, key + ".name", "is " + quote(score.name) + ", not a name of letters a-z, 0-9 and _");
  if (score.file.empty()) fail(file, key + ".file", "is missing");
  if (score.pointer.empty() == score.column.empty())
    fail(file, key, "needs either a pointer (JSON) or a column (CSV)");
  try {
    const nlohmann::json::json_pointer pointer(score.pointer);
  } catch (const nlohmann::json::exception&) {
    fail(file, key + ".pointer", "is " + quote(score.pointer) + ", not as in /mission/outcome");
  }
}

void check_unit_file(const ConfigFile& file, const std::string& key,
                     const UnitFileDefinition& unit_file) {
  const std::filesystem::path path = unit_file.name;
  const bool leaves = std::ranges::count(path, "..") > 0;
  if (path.empty() || path.is_absolute() || leaves || !path.has_filename())
    fail(file, key + ".name", "is " + quote(unit_file.name) + ", not a path below {out}");
}

void check_rate(const ConfigFile& file, const std::string& key, const RateDefinition& rate) {
  if (rate.name.empty()) fail(file, key + ".name", "is missing");
  if (rate.condition.empty()) fail(file, key + ".condition", "is missing");
  if (rate.min > rate.max) fail(file, key, "has a min above its max");
}

template <class Items>
void require_unique_names(const ConfigFile& file, const std::string& list, const Items& items) {
  std::set<std::string> names;
  for (const auto& item : items) {
    if (!names.insert(item.name).second)
      fail(file, list, "has the name " + quote(item.name) + " twice");
  }
}

void check(const ConfigFile& file, const CampaignDefinition& campaign) {
  if (campaign.command.empty()) fail(file, "command", "is missing");
  for (std::size_t i = 0; i < campaign.files.size(); ++i)
    check_unit_file(file, fmt::format("files[{}]", i), campaign.files[i]);
  for (std::size_t i = 0; i < campaign.scores.size(); ++i)
    check_score(file, fmt::format("scores[{}]", i), campaign.scores[i]);
  for (std::size_t i = 0; i < campaign.rates.size(); ++i)
    check_rate(file, fmt::format("rates[{}]", i), campaign.rates[i]);
  for (std::size_t i = 0; i < campaign.distributions.size(); ++i) {
    if (campaign.distributions[i].value.empty())
      fail(file, fmt::format("distributions[{}].value", i), "is missing");
  }
  require_unique_names(file, "files", campaign.files);
  require_unique_names(file, "scores", campaign.scores);
  require_unique_names(file, "rates", campaign.rates);
}

}  // namespace

bool is_column_name(const std::string& name) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || c == '_'; };
  return !name.empty() && is_letter(name.front()) &&
         std::ranges::all_of(name, [&](char c) { return is_letter(c) || (c >= '0' && c <= '9'); });
}

bool CampaignDefinition::stops_early() const {
  return std::ranges::any_of(rates, [](const auto& rate) { return rate.stop_width > 0.0; });
}

bool CampaignDefinition::accepts(int exit_code) const {
  return std::ranges::any_of(exit_codes,
                             [&](double code) { return std::lround(code) == exit_code; });
}

CampaignDefinition load_campaign(const ConfigFile& file,
                                 const std::vector<std::string>& other_sections) {
  std::vector<std::string> sections{kSection};
  sections.insert(sections.end(), other_sections.begin(), other_sections.end());
  file.require_known_sections(sections);
  if (!file.section(kSection)) throw ConfigError(file.name() + ": the section campaign is missing");
  CampaignDefinition campaign = load_section<CampaignDefinition>(file, kSection);
  if (campaign.name.empty()) campaign.name = std::filesystem::path(file.name()).stem().string();
  for (DistributionDefinition& distribution : campaign.distributions) {
    if (distribution.name.empty()) distribution.name = distribution.value;
  }
  check(file, campaign);
  return campaign;
}

}  // namespace adit
