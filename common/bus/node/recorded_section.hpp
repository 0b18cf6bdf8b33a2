// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "common/config/config.hpp"
#include "common/messages/diagnostics.hpp"

namespace adit {

/// A section of a recorded CONFIG; nothing if it has no such section. A CONFIG that cannot be read
/// (damaged, or of another version) gives nothing and adds one warning per stage.
template <class Params>
std::optional<Params> recorded_section(const ConfigSnapshot& snapshot, const std::string& section,
                                       std::vector<std::string>& warnings) {
  try {
    const ConfigFile config =
        ConfigFile::parse(snapshot.yaml, fmt::format("CONFIG of {}", snapshot.stage));
    if (config.section(section) == nullptr) return std::nullopt;
    return load_section<Params>(config, section);
  } catch (const ConfigError& error) {
    const std::string warning = fmt::format("recorded {}; it is not used", error.what());
    if (std::find(warnings.begin(), warnings.end(), warning) == warnings.end()) {
      warnings.push_back(warning);
    }
    return std::nullopt;
  }
}

}  // namespace adit
