// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>

#include "common/config/config_file.hpp"
#include "common/config/config_loader.hpp"
#include "common/config/config_writer.hpp"

/// Parameters are structs that hold their defaults and say once what their keys are:
///   struct MatcherParams {
///     double search_radius_m = 0.3;
///     OptimiserParams optimiser;
///     template <class V> void visit(V& v) {
///       v("search_radius_m", search_radius_m, above(0.0));
///       v("optimiser", optimiser);
///     }
///   };
/// The same visit loads them, checks them, prints them and knows which keys exist. Keys are bool,
/// int, double, std::string, std::vector<double>, Pose2 or a struct of the same make. A struct that
/// several stages must agree on is `v.shared("lasers", lasers)`: a section of its own in the file.
namespace adit {

/// The defaults, changed by what one section of the file says, and those that it shares with
/// others. Throws ConfigError.
template <class Params>
Params load_section(const ConfigFile& file, std::string_view section) {
  Params params;
  ConfigLoader loader(file, section);
  params.visit(loader);
  loader.finish();
  return params;
}

/// The section as YAML with every key, and those that it shares, ready to be edited and loaded
/// again.
template <class Params>
std::string to_yaml(const Params& params, std::string_view section) {
  Params copy = params;  // one visit serves reading and writing, and so cannot be const
  ConfigWriter writer(section);
  copy.visit(writer);
  return writer.text();
}

}  // namespace adit
