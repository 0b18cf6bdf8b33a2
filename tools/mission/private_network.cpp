// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/mission/private_network.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <net/if.h>
#include <net/route.h>
#include <sched.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "procs/supervisor/os/file_descriptor.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLoopback = "lo";

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

/// A setting of the kernel takes one write.
void write_setting(const std::string& text, const fs::path& path) {
  std::ofstream file(path);
  file << text;
  if (!file.flush()) throw std::runtime_error(fmt::format("cannot write {}", path.string()));
}

/// Files keep their owner: the user namespace maps ids to themselves.
void map_user_to_itself(uid_t user, gid_t group) {
  const auto map = [](auto id) { return fmt::format("{0} {0} 1\n", id); };
  write_setting("deny", "/proc/self/setgroups");
  write_setting(map(user), "/proc/self/uid_map");
  write_setting(map(group), "/proc/self/gid_map");
}

void bring_up_loopback(const FileDescriptor& socket) {
  ifreq request{};
  std::strncpy(request.ifr_name, kLoopback, IFNAMSIZ - 1);
  if (ioctl(socket.get(), SIOCGIFFLAGS, &request) != 0) fail("flags of lo");
  request.ifr_flags |= IFF_UP | IFF_RUNNING;
  if (ioctl(socket.get(), SIOCSIFFLAGS, &request) != 0) fail("cannot bring up lo");
}

sockaddr address(const char* text) {
  sockaddr_in internet{};
  internet.sin_family = AF_INET;
  inet_pton(AF_INET, text, &internet.sin_addr);
  sockaddr any{};
  static_assert(sizeof any == sizeof internet);
  std::memcpy(&any, &internet, sizeof any);
  return any;
}

void route_multicast(const FileDescriptor& socket) {
  std::string device = kLoopback;
  rtentry route{};
  route.rt_dst = address("224.0.0.0");
  route.rt_genmask = address("240.0.0.0");
  route.rt_flags = RTF_UP;
  route.rt_dev = device.data();
  if (ioctl(socket.get(), SIOCADDRT, &route) != 0) fail("cannot add a multicast route");
}

bool is_same_inode(const fs::path& a, const fs::path& b) {
  struct stat of_a {};
  struct stat of_b {};
  return stat(a.c_str(), &of_a) == 0 && stat(b.c_str(), &of_b) == 0 && of_a.st_ino == of_b.st_ino;
}

}  // namespace

bool enter_private_network() {
  const uid_t user = geteuid();
  const gid_t group = getegid();
  const bool as_root = user == 0 && unshare(CLONE_NEWNET) == 0;
  if (!as_root) {
    if (unshare(CLONE_NEWUSER | CLONE_NEWNET) != 0) return false;
    map_user_to_itself(user, group);
  }
  const FileDescriptor socket(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  if (!socket) fail("socket");
  bring_up_loopback(socket);
  route_multicast(socket);
  return true;
}

void enter_network_of(pid_t pid) {
  const fs::path target = fs::path("/proc") / fmt::to_string(pid) / "ns";
  for (const char* space : {"user", "net"}) {  // the first gives the permission for the second
    if (is_same_inode(target / space, fs::path("/proc/self/ns") / space)) continue;
    const FileDescriptor joined(open((target / space).c_str(), O_RDONLY | O_CLOEXEC));
    if (joined && setns(joined.get(), 0) == 0) continue;
    throw std::runtime_error(fmt::format("cannot join the network of process {}: {}", pid,
                                         std::generic_category().message(errno)));
  }
}

std::optional<pid_t> process_of_mission(const fs::path& folder) {
  pid_t pid = 0;
  std::ifstream(folder / "mission.pid") >> pid;
  const bool runs = pid > 0 && fs::exists(fmt::format("/proc/{}", pid));
  return runs ? std::optional(pid) : std::nullopt;
}

void enter_network_of_mission(const fs::path& folder) {
  const std::optional<pid_t> process = process_of_mission(folder);
  if (!process) throw std::runtime_error("no mission is running in " + folder.string());
  enter_network_of(*process);
  unsetenv("LCM_DEFAULT_URL");
}

}  // namespace adit
