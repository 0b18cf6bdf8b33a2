// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/lcm_spy.hpp"

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "common/files/zstd_stream.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value ? value : "";
}

std::string find_program(const std::string& name, std::string_view search_path,
                         const std::string& install_hint) {
  std::istringstream folders{std::string(search_path)};
  for (std::string folder; std::getline(folders, folder, ':');) {
    const fs::path path = fs::path(folder) / name;
    if (access(path.c_str(), X_OK) == 0) return path.string();
  }
  throw std::runtime_error(fmt::format("{} is missing, try: {}", name, install_hint));
}

bool is_adit_jar(const fs::path& path) {
  const std::string name = path.filename().string();
  return path.extension() == ".jar" &&
         (name.starts_with("lcmtypes_") || name.starts_with("lcmspy_plugins_"));
}

std::string class_path(const fs::path& folder) {
  std::vector<std::string> jars;
  std::error_code missing_folder;
  for (const auto& entry : fs::directory_iterator(folder, missing_folder)) {
    if (is_adit_jar(entry.path())) jars.push_back(entry.path().string());
  }
  if (jars.empty()) {
    throw std::runtime_error(
        fmt::format("{} has no lcmtypes_adit.jar, try: "
                    "sudo apt install default-jdk-headless liblcm-java, then rebuild",
                    folder.string()));
  }
  std::sort(jars.begin(), jars.end());
  std::string joined = environment("CLASSPATH");
  for (const std::string& jar : jars) joined += (joined.empty() ? "" : ":") + jar;
  return joined;
}

void require_log(const fs::path& log) {
  if (access(log.c_str(), R_OK) != 0) {
    throw std::runtime_error(
        fmt::format("{}: {}", log.string(), std::generic_category().message(errno)));
  }
  std::array<std::uint8_t, 4> begin{};
  std::ifstream(log, std::ios::binary).read(reinterpret_cast<char*>(begin.data()), begin.size());
  if (is_zstd(begin)) {
    throw std::runtime_error(
        fmt::format("{}: lcm-logplayer-gui cannot read a compressed log, try: adit export {} "
                    "--lcmlog PLAIN",
                    log.string(), log.string()));
  }
  if (log.string().find(' ') != std::string::npos) {
    throw std::runtime_error(
        fmt::format("{}: lcm-logplayer-gui cannot open a path with spaces", log.string()));
  }
}

}  // namespace

SpyCommand lcm_spy_command(const fs::path& program_folder, std::string_view search_path,
                           const std::optional<fs::path>& log) {
  constexpr const char* kTools = "sudo apt install liblcm-bin liblcm-java libjchart2d-java";
  if (log) require_log(*log);
  SpyCommand command;
  command.arguments.push_back(
      find_program(log ? "lcm-logplayer-gui" : "lcm-spy", search_path, kTools));
  if (log) command.arguments.push_back(log->string());
  find_program("java", search_path, "sudo apt install default-jre");

  const std::string java_options = environment("JAVA_TOOL_OPTIONS");
  command.environment["CLASSPATH"] =
      class_path((program_folder / "../share/java").lexically_normal());
  command.environment["JAVA_TOOL_OPTIONS"] =
      java_options + (java_options.empty() ? "" : " ") + "-XX:+IgnoreUnrecognizedVMOptions";
  return command;
}

void run_lcm_spy(const std::optional<fs::path>& log) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  SpyCommand command = lcm_spy_command(program.parent_path(), environment("PATH"), log);
  if (environment("DISPLAY").empty()) {
    throw std::runtime_error("DISPLAY is not set: lcm-spy requires a graphical desktop");
  }
  for (const auto& [name, value] : command.environment) setenv(name.c_str(), value.c_str(), 1);
  std::vector<char*> arguments;
  for (std::string& argument : command.arguments) arguments.push_back(argument.data());
  arguments.push_back(nullptr);
  execv(arguments[0], arguments.data());
  throw std::runtime_error(
      fmt::format("{}: {}", command.arguments[0], std::generic_category().message(errno)));
}

}  // namespace adit
