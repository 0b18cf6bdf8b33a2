// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>

#include <CLI/CLI.hpp>

#include "tools/adit/commands.hpp"
#include "tools/adit/completion.hpp"

namespace adit {
namespace {

constexpr const char* kCompletionFooter = R"(Examples:
  source <(adit completion bash)                              in ~/.bashrc
  source <(adit completion zsh)                               in ~/.zshrc, after compinit
  adit completion fish > ~/.config/fish/completions/adit.fish)";

using MakeScript = std::string (*)(const std::vector<CommandWords>&);

void add_shell(CLI::App& completion, const CLI::App& adit, const std::string& shell,
               MakeScript make_script) {
  CLI::App* command = completion.add_subcommand(shell, "Print the script for " + shell);
  command->callback([&adit, make_script] { std::cout << make_script(list_commands(adit)); });
}

}  // namespace

void add_completion_command(CLI::App& adit) {
  CLI::App* completion =
      adit.add_subcommand("completion", "Print a script that completes adit's words in a shell");
  completion->require_subcommand(1);
  completion->footer(kCompletionFooter);
  add_shell(*completion, adit, "bash", bash_completion);
  add_shell(*completion, adit, "zsh", zsh_completion);
  add_shell(*completion, adit, "fish", fish_completion);
}

}  // namespace adit
