// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace adit {

/// A configuration that cannot be used; `what()` is one line, with `file:line:` where there is one.
/// Programs end with exit code 2.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One value of a configuration file and where it stands.
struct ConfigNode {
  enum class Kind { kNothing, kScalar, kList, kMap };

  Kind kind = Kind::kNothing;
  int line = 0;                      ///< from 1; of the key, for the values of a map
  std::string key;                   ///< within a map
  std::string text;                  ///< of a scalar
  bool quoted = false;               ///< such a scalar is a string, whatever it looks like
  std::vector<ConfigNode> children;  ///< of a list or map

  [[nodiscard]] const ConfigNode* find(std::string_view name) const;
};

/// A YAML file of one section for each process. Its structure is checked on loading: one document,
/// a map of sections, no key twice. What the keys mean is for `load_section`.
class ConfigFile {
 public:
  /// A file without sections: everything keeps its default.
  ConfigFile() = default;
  /// Throws ConfigError if the file cannot be read or is not well formed.
  static ConfigFile load(const std::filesystem::path& path);
  /// The same from text; `name` stands for the file in messages.
  static ConfigFile parse(const std::string& text, std::string name);

  /// Throws ConfigError if there is a section that is not in the list.
  void require_known_sections(const std::vector<std::string>& known) const;

  [[nodiscard]] const ConfigNode* section(std::string_view name) const { return root_.find(name); }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_ = "(no file)";
  ConfigNode root_;
};

/// Throws ConfigError: `node`, described by `what`, is none of `known`; names the nearest of them.
[[noreturn]] void throw_unknown_key(const std::string& file, const ConfigNode& node,
                                    const std::string& what, const std::vector<std::string>& known);

}  // namespace adit
