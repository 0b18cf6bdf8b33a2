// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/campaign/run/campaign_folder.hpp"

#include <cerrno>
#include <csignal>
#include <optional>
#include <string_view>
#include <system_error>

#include "common/config/number_text.hpp"
#include "tools/campaign/run/unit_result.hpp"

namespace adit {

void CampaignFolder::remove_old_attempts() const {
  const std::string host = "." + host_name() + ".";
  for (const auto& entry : std::filesystem::directory_iterator(units())) {
    const std::string name = entry.path().filename().string();
    if (!name.starts_with('.')) continue;
    const bool has_result = std::filesystem::exists(result(name.substr(1, name.find('.', 1) - 1)));
    const auto at = name.find(host);
    const auto pid = at == std::string::npos
                         ? std::nullopt
                         : parse_number<int>(std::string_view(name).substr(at + host.size()));
    const bool was_killed = pid && kill(*pid, 0) != 0 && errno == ESRCH;
    if (has_result || was_killed) std::filesystem::remove_all(entry.path());
  }
}

NewCampaignFolder::NewCampaignFolder(const CampaignFolder& folder)
    : path_(folder.path), created_(std::filesystem::create_directories(folder.path)) {
  std::filesystem::create_directories(folder.units());
}

NewCampaignFolder::~NewCampaignFolder() {
  std::error_code ignored;
  if (created_) std::filesystem::remove_all(path_, ignored);
}

}  // namespace adit
