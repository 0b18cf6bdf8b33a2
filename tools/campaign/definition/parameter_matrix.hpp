// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "common/config/config_file.hpp"

namespace adit {

/// A value of a parameter, as it is written in the file.
struct ParameterValue {
  std::string text;
  bool is_number = false;
  bool is_file = false;  ///< from a pattern: also an input
};

/// The parameters of a unit, in the order of the file.
class UnitParameters {
 public:
  void set(const std::string& name, ParameterValue value);
  [[nodiscard]] const ParameterValue* find(const std::string& name) const;
  [[nodiscard]] const std::vector<std::pair<std::string, ParameterValue>>& values() const {
    return values_;
  }
  /// {"width_m":1.3,"shape":"bent"}, in the order of names: the same for the same values.
  [[nodiscard]] std::string json() const;

 private:
  std::vector<std::pair<std::string, ParameterValue>> values_;
};

/// Upper limit of the units of a campaign.
inline constexpr std::size_t kCampaignUnitsMax = 1'000'000;

/// The parameters of all units from the section `matrix`: the product of the values of all keys,
/// the last of which changes first, without what `exclude` lists, with what `include` adds. Values
/// are a list, {from: 1, to: 100, step: 1}, or {files: PATTERN} relative to `folder`. A file
/// without the section has one unit without parameters. Throws ConfigError.
std::vector<UnitParameters> expand_matrix(const ConfigFile& file,
                                          const std::filesystem::path& folder);

}  // namespace adit
