// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/command_line/command_line.hpp"
#include "common/config/number_text.hpp"
#include "common/text/message_text.hpp"
#include "procs/supervisor/control/control_client.hpp"
#include "procs/supervisor/control/control_socket.hpp"
#include "tools/adit/adit_app.hpp"

namespace adit {
namespace {

using Row = std::vector<std::string>;

/// Columns of `adit ps`, in the order in which the supervisor sends them.
enum Column { kName, kDeputy, kGroup, kState, kPid, kCpu, kMemory, kRestarts, kNote, kColumns };

const Row kHeading{"NAME", "COMPUTER", "GROUP", "STATE", "PID", "CPU %", "MB", "RESTARTS", ""};

std::string scaled(const std::string& number, double factor) {
  return fmt::format("{:.1f}", parse_number<double>(number).value_or(0.0) * factor);
}

Row tokens_of(const std::string& line) {
  Row tokens;
  std::istringstream text(line);
  for (std::string token; std::getline(text, token, '\t');) tokens.push_back(message_line(token));
  tokens.resize(kColumns);
  return tokens;
}

/// CPU and memory are shown only for running processes.
Row formatted(Row row) {
  const bool running = row[kPid] != "0";
  row[kPid] = running ? row[kPid] : "-";
  row[kCpu] = running ? scaled(row[kCpu], 100.0) : "-";
  row[kMemory] = running ? scaled(row[kMemory], 1e-6) : "-";
  return row;
}

bool is_number_column(std::size_t column) { return column >= kPid && column <= kRestarts; }

std::size_t width_of(const std::vector<Row>& rows, std::size_t column) {
  std::size_t width = 0;
  for (const Row& row : rows) width = std::max(width, row[column].size());
  return width;
}

std::string padded(const std::string& token, std::size_t width, bool right) {
  const std::string blanks(width - token.size(), ' ');
  return right ? blanks + token : token + blanks;
}

struct ProcessOptions {
  std::filesystem::path socket;
  std::vector<std::string> names;
  std::string script;
  bool all = false;
  bool follow = false;
};

constexpr const char* kChangeDetails =
    R"(Controls only processes in the process list of the supervisor. Only the user who runs the supervisor, or
root, on the same computer may do this. A supervisor in charge also controls the processes of the other
computers. A process waits for its dependencies (depends_on); they are not started with it.)";

constexpr const char* kChangeExamples =
    R"(  adit start mapping terrain
  adit start --all                  in the order of the dependencies
  adit start --script explore       run a script of the list; replaces a script that still runs
  adit restart mapping)";

constexpr const char* kPsDetails =
    R"(Columns: computer and group of the process, state, process id, CPU (100 % is one core) and memory of the
process and its children, restarts since the supervisor started (in parentheses the recent ones, without
10 s of stable run in between, which count for the restart limit), last error.

States:
  stopped    not running
  waiting    for its dependencies
  starting   running, without a heartbeat yet
  running
  stopping
  pausing    before the next restart
  failed     the restart limit is reached
  unknown    no status from its computer)";

constexpr const char* kPsExamples = R"(  adit ps
  watch -n1 adit ps)";

constexpr const char* kLogsDetails =
    R"(Prints the last thousand lines of output of a process. For a process of another computer, these are the
lines received since the supervisor of this computer started.)";

constexpr const char* kLogsExamples =
    R"(  adit logs mapping
  adit logs mapping -f              also print new output, until Ctrl-C)";

constexpr const char* kReloadDetails =
    R"(Unchanged processes keep running, changed ones are restarted if they run, removed ones are stopped, and
new ones wait for adit start. Each computer reads its own list. An invalid list is rejected, and the current
list stays in effect. Same as kill -HUP and systemctl reload adit-supervisor.)";

constexpr const char* kReloadExamples = "  adit reload";

/// Prints the output of a process line by line, so that a chunk may end within a character. Escape
/// sequences in it do not act on the terminal.
class PrintedLines {
 public:
  ~PrintedLines() { std::cout << printable_lines(rest_) << std::flush; }
  void add(std::string_view text) {
    rest_ += text;
    const std::size_t end = rest_.rfind('\n') + 1;  // 0 if there is none
    std::cout << printable_lines(std::string_view(rest_).substr(0, end)) << std::flush;
    rest_.erase(0, end);
  }

 private:
  std::string rest_;
};

std::shared_ptr<ProcessOptions> add_socket_option(CLI::App& command) {
  auto options = std::make_shared<ProcessOptions>();
  options->socket = find_socket_path();
  command
      .add_option("--socket", options->socket,
                  "Socket of the supervisor; by default that of the user, else of the system")
      ->type_name("PATH");
  return options;
}

void change(const std::string& verb, const ProcessOptions& options) {
  std::vector<std::string> request{verb};
  if (!options.script.empty()) {
    request = {"script", options.script};
  } else if (options.all == !options.names.empty()) {
    throw std::invalid_argument("either process names or --all is required");
  }
  request.insert(request.end(), options.names.begin(), options.names.end());
  request_from_supervisor(options.socket, request);
}

CLI::App* add_change_command(CLI::App& adit, const std::string& verb, const std::string& purpose) {
  CLI::App* command = add_command(adit, verb, purpose);
  set_help(*command, {kChangeDetails, "", kChangeExamples});
  const auto options = add_socket_option(*command);
  CLI::Option* names = command->add_option("NAME", options->names, "Processes of the process list");
  CLI::Option* all = command->add_flag("--all", options->all, "All processes of the process list");
  if (verb == "start") {
    command->add_option("--script", options->script, "Run a script of the process list")
        ->excludes(names)
        ->excludes(all);
  }
  command->callback([verb, options] { change(verb, *options); });
  return command;
}

}  // namespace

std::string process_table_text(std::string_view rows) {
  std::vector<Row> table;
  std::istringstream lines{std::string(rows)};
  for (std::string line; std::getline(lines, line);) table.push_back(formatted(tokens_of(line)));
  const bool groups = width_of(table, kGroup) > 0;
  table.insert(table.begin(), kHeading);
  std::vector<std::size_t> widths;
  for (std::size_t i = 0; i < kColumns; ++i) widths.push_back(width_of(table, i));
  std::string text;
  for (const Row& row : table) {
    std::string line;
    for (std::size_t i = 0; i < kColumns; ++i) {
      if (i == kGroup && !groups) continue;
      line += padded(row[i], widths[i], is_number_column(i)) + "  ";
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

void add_process_commands(CLI::App& adit) {
  add_change_command(adit, "start", "Start processes of the supervisor");
  add_change_command(adit, "stop", "Stop processes of the supervisor");
  add_change_command(adit, "restart", "Restart processes of the supervisor");
  CLI::App* ps = add_command(adit, "ps", "List the processes of the supervisor");
  set_help(*ps, {kPsDetails, "", kPsExamples});
  const auto options = add_socket_option(*ps);
  ps->callback([options] {
    std::cout << process_table_text(request_from_supervisor(options->socket, {"ps"}));
  });
}

void add_reload_command(CLI::App& adit) {
  CLI::App* reload = add_command(adit, "reload", "Reload the process list of the supervisor");
  set_help(*reload, {kReloadDetails, "", kReloadExamples});
  const auto options = add_socket_option(*reload);
  reload->callback([options] {
    std::cout << printable_lines(request_from_supervisor(options->socket, {"reload"}));
  });
}

void add_logs_command(CLI::App& adit) {
  CLI::App* logs = add_command(adit, "logs", "Print the output of a process of the supervisor");
  set_help(*logs, {kLogsDetails, "", kLogsExamples});
  const auto options = add_socket_option(*logs);
  logs->add_option("NAME", options->names, "Process of the process list")->required()->expected(1);
  logs->add_flag("-f,--follow", options->follow, "Also print new output");
  logs->callback([options] {
    PrintedLines lines;
    request_from_supervisor(options->socket,
                            {options->follow ? "follow" : "logs", options->names.front()},
                            [&lines](std::string_view text) { lines.add(text); });
  });
}

}  // namespace adit
