// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/supervisor_setup.hpp"

#include <array>
#include <cmath>

#include <unistd.h>

#include "common/config/config_file.hpp"
#include "common/files/file_utils.hpp"
#include "common/process_list/parser.hpp"
#include "procs/supervisor/control/control_socket.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

fs::path sibling_program(const std::string& name) {
  std::error_code unknown;
  return fs::read_symlink("/proc/self/exe", unknown).parent_path() / name;
}

void create_log_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || access(folder.c_str(), W_OK | X_OK) != 0) {
    throw ConfigError("supervisor.log_dir: " + folder.string() + " is not writable");
  }
}

void assign_deputies(ProcessList& list, const std::string& in_charge, const std::string& file) {
  for (ListedCommand& command : list.commands) {
    if (!command.deputy.empty() && command.deputy != "localhost") continue;
    if (in_charge.empty()) {
      throw ConfigError(file + ": command \"" + command.id +
                        "\" has no deputy, and supervisor.in_charge is not set");
    }
    command.deputy = in_charge;
  }
}

}  // namespace

SupervisorSetup make_setup(const SupervisorParams& params) {
  if (params.processes.empty()) {
    throw ConfigError("supervisor.processes is not set: the file of the process list");
  }
  SupervisorSetup setup;
  setup.deputy = params.deputy_id.empty() ? host_name() : params.deputy_id;
  setup.in_charge = params.role == "in_charge";
  setup.socket = params.socket.empty() ? default_socket_path() : fs::path(params.socket);
  setup.watcher = params.watcher.empty() ? sibling_program("adit-watch") : fs::path(params.watcher);
  if (access(setup.watcher.c_str(), X_OK) != 0) {
    throw ConfigError("supervisor.watcher: " + setup.watcher.string() + " is not executable");
  }
  setup.log_dir = params.log_dir;
  setup.log_limits = {std::llround(params.log_file_max_mb * 1e6), params.log_files};
  if (!setup.log_dir.empty()) create_log_folder(setup.log_dir);
  setup.list = read_process_list(find_installed_file(params.processes, "processes"));
  assign_deputies(setup.list, setup.in_charge ? setup.deputy : params.in_charge, params.processes);
  if (!params.start_script.empty() && !setup.list.find_script(params.start_script)) {
    throw ConfigError("supervisor.start_script: " + params.processes + " has no script \"" +
                      params.start_script + "\"");
  }
  return setup;
}

}  // namespace adit
