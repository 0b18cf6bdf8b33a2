// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "procs/supervisor/control/control_client.hpp"
#include "procs/supervisor/control/control_socket.hpp"
#include "tools/adit/adit_app.hpp"
#include "tools/adit/process_table.hpp"

namespace adit {
namespace {

struct ProcessOptions {
  std::filesystem::path socket;
  std::vector<std::string> names;
  std::string script;
  bool all = false;
  bool follow = false;
};

constexpr const char* kChangeFooter =
    R"(Only what stands in the supervisor's process list can be started, and only by the user whose supervisor
it is, or root, on the same computer. One in charge has the processes of other computers started too. A
process waits for what it depends on, which is not started with it.

Examples:
  adit start mapping terrain
  adit start --all                  in the order of what depends on what
  adit start --script explore       a script of the list; takes the place of one that still runs
  adit restart mapping)";

constexpr const char* kPsFooter =
    R"(States: stopped, waiting (for what it depends on), starting (runs, and has not shown life yet), running,
stopping, pausing (until it is started again), failed (given up), unknown (its computer is silent).
CPU and memory are those of the process and all that it started; 100 % is one core.

Examples:
  adit ps
  watch -n1 adit ps)";

constexpr const char* kLogsFooter =
    R"(The last thousand lines that a process has printed; of another computer's, those of them that came over
the network since the supervisor of this one started.

Examples:
  adit logs mapping
  adit logs mapping -f              and what it prints from now on, until Ctrl-C)";

constexpr const char* kReloadFooter =
    R"(What has not changed runs on, what has is restarted if it runs, what is gone is stopped, what is new waits
for adit start. Each computer reads its own list. A list that is wrong is refused and the old one stays. The
same as: kill -HUP, systemctl reload adit-supervisor.)";

std::shared_ptr<ProcessOptions> add_socket_option(CLI::App& command) {
  auto options = std::make_shared<ProcessOptions>();
  options->socket = find_socket_path();
  command
      .add_option("--socket", options->socket,
                  "Where the supervisor listens; the user's own without, or the system's")
      ->type_name("PATH");
  return options;
}

void change(const std::string& verb, const ProcessOptions& options) {
  std::vector<std::string> words{verb};
  if (!options.script.empty()) {
    words = {"script", options.script};
  } else if (options.all == !options.names.empty()) {
    throw std::invalid_argument("say which processes, or --all");
  }
  words.insert(words.end(), options.names.begin(), options.names.end());
  request_from_supervisor(options.socket, words);
}

CLI::App* add_change_command(CLI::App& adit, const std::string& verb, const std::string& what) {
  CLI::App* command = adit.add_subcommand(verb, what);
  command->footer(kChangeFooter);
  const auto options = add_socket_option(*command);
  CLI::Option* names = command->add_option("NAME", options->names, "Processes of the list");
  CLI::Option* all = command->add_flag("--all", options->all, "All processes of the list");
  if (verb == "start") {
    command->add_option("--script", options->script, "Run a script of the list")
        ->excludes(names)
        ->excludes(all);
  }
  command->callback([verb, options] { change(verb, *options); });
  return command;
}

}  // namespace

void add_process_commands(CLI::App& adit) {
  add_change_command(adit, "start", "Start processes that the supervisor keeps");
  add_change_command(adit, "stop", "Stop processes that the supervisor keeps");
  add_change_command(adit, "restart", "Stop processes and start them again");
  CLI::App* ps = adit.add_subcommand("ps", "Show the processes that the supervisor keeps");
  ps->footer(kPsFooter);
  const auto options = add_socket_option(*ps);
  ps->callback([options] {
    std::cout << process_table_text(request_from_supervisor(options->socket, {"ps"}));
  });
}

void add_reload_command(CLI::App& adit) {
  CLI::App* reload = adit.add_subcommand("reload", "Have the supervisor read its list again");
  reload->footer(kReloadFooter);
  const auto options = add_socket_option(*reload);
  reload->callback(
      [options] { std::cout << request_from_supervisor(options->socket, {"reload"}); });
}

void add_logs_command(CLI::App& adit) {
  CLI::App* logs =
      adit.add_subcommand("logs", "Show what a process that the supervisor keeps prints");
  logs->footer(kLogsFooter);
  const auto options = add_socket_option(*logs);
  logs->add_option("NAME", options->names, "A process of the list")->required()->expected(1);
  logs->add_flag("-f,--follow", options->follow, "Go on with what it prints");
  logs->callback([options] {
    request_from_supervisor(options->socket,
                            {options->follow ? "follow" : "logs", options->names.front()},
                            [](std::string_view text) { std::cout << text << std::flush; });
  });
}

}  // namespace adit
