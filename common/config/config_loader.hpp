// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/config/bounds.hpp"
#include "common/config/config_file.hpp"
#include "common/geometry/pose2.hpp"

namespace adit {

/// A pose in a configuration: a map of x_m, y_m and theta_rad.
struct PoseKeys {
  Pose2& pose;

  template <class V>
  void visit(V& v) {
    v("x_m", pose.x);
    v("y_m", pose.y);
    v("theta_rad", pose.theta);
  }
};

/// Visitor that loads parameters from one section of a file. A key that is absent from the file
/// keeps its value. A value of the wrong type or out of bounds and a key that is not visited throw
/// ConfigError with file, line, key and the allowed values. Numbers must be finite.
class ConfigLoader {
 public:
  ConfigLoader(const ConfigFile& file, std::string_view section);

  void operator()(std::string_view key, bool& value);
  void operator()(std::string_view key, int& value, const Bounds& bounds = {});
  void operator()(std::string_view key, double& value, const Bounds& bounds = {});
  void operator()(std::string_view key, std::string& value);
  void operator()(std::string_view key, std::string& value, const OneOf& allowed);
  /// The bounds apply to each element.
  void operator()(std::string_view key, std::vector<double>& values, const Bounds& bounds = {});
  void operator()(std::string_view key, Pose2& pose);

  template <class Params>
  requires requires(Params& params, ConfigLoader& loader) { params.visit(loader); }
  void operator()(std::string_view key, Params& nested) {
    enter(key);
    nested.visit(*this);
    leave();
  }

  /// A list of maps; each element starts from the defaults.
  template <class Params>
  requires requires(Params& params, ConfigLoader& loader) { params.visit(loader); }
  void operator()(std::string_view key, std::vector<Params>& list) {
    const std::vector<const ConfigNode*> maps = visit_list(key);
    std::vector<Params> loaded(maps.size());
    for (std::size_t i = 0; i < maps.size(); ++i) {
      push(maps[i], levels_.back().path + "." + std::string(key) + "[" + std::to_string(i) + "]");
      loaded[i].visit(*this);
      leave();
    }
    if (has(key)) list = std::move(loaded);
  }

  /// Loads parameters that several stages share, from a section of their own.
  template <class Params>
  void shared(std::string_view section, Params& params) {
    ConfigLoader loader(file_, section);
    params.visit(loader);
    loader.finish();
  }

  /// Must be called after the visit: rejects keys that were not visited.
  void finish() { leave(); }

 private:
  struct Level {
    const ConfigNode* map;  // null if absent from the file
    std::string path;       // "scan_matching.matcher."
    std::vector<std::string> known;
  };

  const ConfigNode* visit_key(std::string_view key);
  std::vector<const ConfigNode*> visit_list(std::string_view key);
  [[nodiscard]] bool has(std::string_view key) const;
  void enter(std::string_view key);
  void push(const ConfigNode* map, std::string path);
  void leave();
  [[noreturn]] void fail(const ConfigNode& node, const std::string& reason) const;
  [[nodiscard]] double read_number(const ConfigNode& node, const Bounds& bounds) const;
  void check(const ConfigNode& node, double value, const Bounds& bounds) const;

  const ConfigFile& file_;
  std::vector<Level> levels_;
};

}  // namespace adit
