// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/os/process_table.hpp"

#include <fstream>
#include <string>
#include <system_error>
#include <vector>

#include <unistd.h>

#include "common/config/parse_number.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

// Behind the name, from 0 (proc(5)).
constexpr std::size_t kState = 0;
constexpr std::size_t kParent = 1;
constexpr std::size_t kUserTicks = 11;
constexpr std::size_t kSystemTicks = 12;
constexpr std::size_t kAddressBytes = 20;
constexpr std::size_t kResidentPages = 21;

std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(" \n"), text.size());
    if (end > 0) words.push_back(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return words;
}

double tick_s() {
  static const double seconds = 1.0 / static_cast<double>(sysconf(_SC_CLK_TCK));
  return seconds;
}

}  // namespace

std::optional<ProcessEntry> parse_process_entry(std::string_view stat) {
  const std::size_t name_end = stat.rfind(')');
  if (name_end == std::string_view::npos) return std::nullopt;
  const auto pid = parse_number<pid_t>(stat.substr(0, stat.find(' ')));
  const std::vector<std::string_view> words = words_of(stat.substr(name_end + 1));
  if (!pid || words.size() <= kResidentPages) return std::nullopt;
  const auto number = [&](std::size_t at) {
    return parse_number<std::int64_t>(words[at]).value_or(0);
  };
  ProcessEntry entry;
  entry.pid = *pid;
  entry.parent = static_cast<pid_t>(number(kParent));
  entry.state = words[kState][0];
  entry.cpu_s = static_cast<double>(number(kUserTicks) + number(kSystemTicks)) * tick_s();
  entry.address_bytes = number(kAddressBytes);
  entry.memory_bytes = number(kResidentPages) * sysconf(_SC_PAGESIZE);
  return entry;
}

ProcessTable ProcessTable::read(const fs::path& proc) {
  std::map<pid_t, ProcessEntry> entries;
  std::error_code gone;
  for (const auto& folder : fs::directory_iterator(proc, gone)) {
    const auto pid = parse_number<pid_t>(folder.path().filename().string());
    if (!pid) continue;
    std::ifstream file(folder.path() / "stat");
    std::string stat;
    std::getline(file, stat, '\0');  // all of it; one that ends meanwhile cannot be read
    if (const auto entry = parse_process_entry(stat)) entries[*pid] = *entry;
  }
  return ProcessTable(std::move(entries));
}

std::set<pid_t> ProcessTable::children_of(pid_t parent) const {
  std::set<pid_t> found;
  for (const auto& [pid, entry] : entries_) {
    if (entry.parent == parent) found.insert(pid);
  }
  return found;
}

std::set<pid_t> ProcessTable::descendants_of(pid_t ancestor) const {
  std::set<pid_t> found;
  std::vector<pid_t> to_ask{ancestor};
  while (!to_ask.empty()) {
    const pid_t parent = to_ask.back();
    to_ask.pop_back();
    for (const pid_t child : children_of(parent)) {
      if (child != ancestor && found.insert(child).second) to_ask.push_back(child);
    }
  }
  return found;
}

}  // namespace adit
