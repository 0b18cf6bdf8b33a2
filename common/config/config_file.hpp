// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace adit {

/// Thrown for an invalid configuration; `what()` is one line, with `file:line:` where known.
/// Programs exit with code 2.
class ConfigError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// One value of a configuration file with its location.
struct ConfigNode {
  enum class Kind { kNothing, kScalar, kList, kMap };

  Kind kind = Kind::kNothing;
  int line = 0;                      ///< from 1; of the key, for the values of a map
  std::string key;                   ///< within a map
  std::string text;                  ///< of a scalar
  bool quoted = false;               ///< a quoted scalar is a string, even if it reads as a number
  std::vector<ConfigNode> children;  ///< of a list or map

  [[nodiscard]] const ConfigNode* find(std::string_view name) const;
};

/// A YAML file with one section for each process. Loading checks its structure: one document, a map
/// of sections, no duplicate key. `load_section` interprets the keys.
class ConfigFile {
 public:
  /// A file without sections: all parameters keep their defaults.
  ConfigFile() = default;
  /// Throws ConfigError if the file is unreadable or not well formed.
  static ConfigFile load(const std::filesystem::path& path);
  /// The same from text; `name` stands for the file in error messages.
  static ConfigFile parse(const std::string& text, std::string name);

  /// Throws ConfigError for a section that is not in `known`.
  void require_known_sections(const std::vector<std::string>& known) const;

  [[nodiscard]] const ConfigNode* section(std::string_view name) const { return root_.find(name); }
  [[nodiscard]] const std::string& name() const { return name_; }

 private:
  std::string name_ = "(no file)";
  ConfigNode root_;
};

/// Throws ConfigError for `node`, described by `what`, which is not among `known`; suggests the
/// nearest of them.
[[noreturn]] void throw_unknown_key(const std::string& file, const ConfigNode& node,
                                    const std::string& what, const std::vector<std::string>& known);

}  // namespace adit
