// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace adit {

/// What a shell has to know of one command to complete its words. The root has an empty path.
struct CommandCompletion {
  struct Entry {
    std::string text;  ///< of a sub-command, or of an option with its dashes
    std::string description;
    bool takes_value = false;
  };

  std::string path;  ///< "import carmen"
  std::vector<Entry> subcommands;
  std::vector<Entry> options;
  bool takes_files = false;  ///< has arguments that are not options
};

/// All commands of an app, the root first, read from its tree, so that completion never goes stale.
std::vector<CommandCompletion> list_commands(const CLI::App& app);

/// Scripts that a shell loads: `adit completion bash > …`.
std::string bash_completion(const std::vector<CommandCompletion>& commands);
std::string zsh_completion(const std::vector<CommandCompletion>& commands);
std::string fish_completion(const std::vector<CommandCompletion>& commands);

}  // namespace adit
