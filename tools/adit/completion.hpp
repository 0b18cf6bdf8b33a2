// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace adit {

/// Completions of one command. The root has an empty path.
struct CommandCompletion {
  struct Entry {
    std::string text;  ///< sub-command, or option with its dashes
    bool takes_value = false;
  };

  std::string path;  ///< "import carmen"
  std::vector<Entry> subcommands;
  std::vector<Entry> options;
  bool takes_files = false;  ///< has positional arguments
};

/// Lists all commands of an app, the root first, from its tree of sub-commands.
std::vector<CommandCompletion> list_commands(const CLI::App& app);

/// Generates the script that bash loads: `source <(adit completion bash)`.
std::string bash_completion(const std::vector<CommandCompletion>& commands);

}  // namespace adit
