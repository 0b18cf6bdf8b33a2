// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/site.hpp"

#include <array>
#include <cmath>

#include <unistd.h>

#include "common/config/config_file.hpp"
#include "common/files/shared_file.hpp"
#include "common/process_list/parser.hpp"
#include "procs/supervisor/terminal/socket_path.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

std::string host_name() {
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

fs::path beside_this_program(const std::string& name) {
  std::error_code unknown;
  return fs::read_symlink("/proc/self/exe", unknown).parent_path() / name;
}

void make_log_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || access(folder.c_str(), W_OK | X_OK) != 0) {
    throw ConfigError("supervisor.log_dir: " + folder.string() + " cannot be written to");
  }
}

void give_deputies(ProcessList& list, const std::string& in_charge, const std::string& file) {
  for (ListedCommand& command : list.commands) {
    if (!command.deputy.empty() && command.deputy != "localhost") continue;
    if (in_charge.empty()) {
      throw ConfigError(file + ": command \"" + command.id +
                        "\" names no deputy, and supervisor.in_charge is not set");
    }
    command.deputy = in_charge;
  }
}

}  // namespace

SupervisorSite make_site(const SupervisorParams& params) {
  if (params.processes.empty()) {
    throw ConfigError("supervisor.processes is not set: the file of the process list");
  }
  SupervisorSite site;
  site.deputy = params.deputy_id.empty() ? host_name() : params.deputy_id;
  site.in_charge = params.role == "in_charge";
  site.socket = params.socket.empty() ? default_socket_path() : fs::path(params.socket);
  site.watcher =
      params.watcher.empty() ? beside_this_program("adit-watch") : fs::path(params.watcher);
  if (access(site.watcher.c_str(), X_OK) != 0) {
    throw ConfigError("supervisor.watcher: " + site.watcher.string() + " cannot be run");
  }
  site.log_dir = params.log_dir;
  site.log_limits = {std::llround(params.log_file_max_mb * 1e6), params.log_files};
  if (!site.log_dir.empty()) make_log_folder(site.log_dir);
  site.list = read_process_list(shared_file(params.processes, "processes"));
  give_deputies(site.list, site.in_charge ? site.deputy : params.in_charge, params.processes);
  if (!params.start_script.empty() && !site.list.find_script(params.start_script)) {
    throw ConfigError("supervisor.start_script: " + params.processes + " has no script \"" +
                      params.start_script + "\"");
  }
  return site;
}

}  // namespace adit
