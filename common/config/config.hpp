// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "common/config/config_file.hpp"
#include "common/config/config_loader.hpp"
#include "common/config/config_writer.hpp"

/// Parameters are structs with defaults that list their keys once:
///   struct MatcherParams {
///     double search_radius_m = 0.3;
///     OptimizerParams optimizer;
///     template <class V> void visit(V& v) {
///       v("search_radius_m", search_radius_m, above(0.0));
///       v("optimizer", optimizer);
///     }
///   };
/// The same visit loads, checks and prints them, and defines the known keys. Keys are bool, int,
/// double, std::string, std::vector<double>, Pose2, a nested struct of this form or a list of such
/// structs. A struct that several stages share is `v.shared("lasers", lasers)`: a section of its
/// own in the file.
namespace adit {

/// The defaults, overridden by one section of the file and the shared sections it uses. Throws
/// ConfigError.
template <class Params>
Params load_section(const ConfigFile& file, std::string_view section) {
  Params params;
  ConfigLoader loader(file, section);
  params.visit(loader);
  loader.finish();
  return params;
}

/// The section as YAML with every key, followed by the shared sections it uses; loads again.
template <class Params>
std::string to_yaml(const Params& params, std::string_view section) {
  Params copy = params;  // `visit` also serves loading, and so cannot be const
  ConfigWriter writer(section);
  copy.visit(writer);
  return writer.text();
}

}  // namespace adit
