// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/campaign_status.hpp"

#include "common/files/file_error.hpp"
#include "common/files/locked_file.hpp"
#include "common/service/wall_time.hpp"
#include "tools/campaign/definition/campaign_definition.hpp"
#include "tools/campaign/page/campaign_html.hpp"
#include "tools/campaign/results/comparison.hpp"
#include "tools/campaign/results/result_table.hpp"
#include "tools/campaign/run/campaign_folder.hpp"

namespace adit {
namespace {

bool is_locked(const std::filesystem::path& path) try {
  const LockedFile file(path);
  return false;
} catch (const FileError&) {
  return true;
}

std::string setting(Database& database, const std::string& key) {
  SqlStatement get = database.prepare("SELECT value FROM settings WHERE key = ?");
  get.bind(0, key);
  return get.step() ? get.text(0) : "";
}

/// By the results since the campaign was started last.
std::optional<double> time_to_go(Database& database, int missing) {
  SqlStatement run = database.prepare(
      "SELECT (SELECT count(*) FROM units JOIN results USING (id)) - began_with.value, began.value "
      "FROM settings AS began, settings AS began_with WHERE began.key = 'run_began_utime' AND "
      "began_with.key = 'run_began_with'");
  if (!run.step() || run.integer(0) <= 0) return std::nullopt;
  const double elapsed_s = 1e-6 * static_cast<double>(wall_utime() - run.integer(1));
  return elapsed_s / static_cast<double>(run.integer(0)) * missing;
}

}  // namespace

CampaignStatus read_campaign_status(const std::filesystem::path& folder) {
  const CampaignFolder files{folder};
  require_campaign(folder);
  Database database(files.database(), Database::Mode::kRead);
  const CampaignDefinition definition =
      load_campaign(ConfigFile::parse(setting(database, "file"), files.database().string()),
                    {"matrix", "search", "space"});
  const CampaignPage page = describe_campaign(definition, database);
  CampaignStatus status;
  status.name = setting(database, "name");
  status.units = page.units;
  status.with_result = page.with_result;
  status.is_running = is_locked(files.lock());
  status.states = page.states;
  status.rates = page.rates;
  if (status.is_running)
    status.time_to_go_s = time_to_go(database, status.units - status.with_result);
  return status;
}

}  // namespace adit
