// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/os/spawn.hpp"

#include <csignal>
#include <map>
#include <system_error>

#include <spawn.h>
#include <unistd.h>

namespace adit {
namespace {

/// What posix_spawn takes, and takes apart again.
class SpawnSetting {
 public:
  explicit SpawnSetting(const std::vector<int>& descriptors) {
    posix_spawn_file_actions_init(&actions);
    for (std::size_t i = 0; i < descriptors.size(); ++i) {
      posix_spawn_file_actions_adddup2(&actions, descriptors[i], static_cast<int>(i));
    }
    posix_spawn_file_actions_addclosefrom_np(&actions, static_cast<int>(descriptors.size()));
    posix_spawnattr_init(&attributes);
    sigset_t signals;
    sigemptyset(&signals);
    posix_spawnattr_setsigmask(&attributes, &signals);
    sigfillset(&signals);
    posix_spawnattr_setsigdefault(&attributes, &signals);
    posix_spawnattr_setflags(&attributes,
                             POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF | POSIX_SPAWN_SETSID);
  }
  ~SpawnSetting() {
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnSetting(const SpawnSetting&) = delete;
  SpawnSetting& operator=(const SpawnSetting&) = delete;

  posix_spawn_file_actions_t actions{};
  posix_spawnattr_t attributes{};
};

std::vector<char*> pointers_to(const std::vector<std::string>& texts) {
  std::vector<char*> pointers;
  for (const std::string& text : texts) pointers.push_back(const_cast<char*>(text.c_str()));
  pointers.push_back(nullptr);
  return pointers;
}

}  // namespace

pid_t spawn(const SpawnOptions& options) {
  const SpawnSetting setting(options.descriptors);
  pid_t pid = -1;
  const int error =
      posix_spawn(&pid, options.arguments.front().c_str(), &setting.actions, &setting.attributes,
                  pointers_to(options.arguments).data(), pointers_to(options.environment).data());
  if (error != 0) {
    throw std::system_error(error, std::generic_category(), options.arguments.front());
  }
  return pid;
}

std::vector<std::string> environment_with(
    const std::vector<std::pair<std::string, std::string>>& additions, const std::string& folder) {
  std::map<std::string, std::string> values;
  for (char** entry = environ; *entry; ++entry) {
    const std::string text = *entry;
    const std::size_t sign = text.find('=');
    if (sign != std::string::npos) values[text.substr(0, sign)] = text.substr(sign + 1);
  }
  std::string& path = values["PATH"];
  path += (path.empty() ? "/usr/local/bin:/usr/bin:/bin:" : ":") + folder;
  for (const auto& [name, value] : additions) values[name] = value;
  std::vector<std::string> environment;
  for (auto& [name, value] : values) environment.push_back(value.insert(0, name + "="));
  return environment;
}

}  // namespace adit
