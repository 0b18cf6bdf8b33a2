// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/channel_filter.hpp"

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include <netinet/in.h>
#include <sys/socket.h>

namespace adit {
namespace {

constexpr std::uint32_t kHeaderBytes = 8;  // of UDP; offsets in the filter count from this header
constexpr std::uint32_t kChannelOffset = kHeaderBytes + 8;
constexpr std::uint32_t kShortMessage = 0x4c433032;  // "LC02"
constexpr std::uint32_t kPass = 0xffffffff;
constexpr std::uint32_t kDrop = 0;

sock_filter statement(int code, std::uint32_t k) {
  return {static_cast<std::uint16_t>(code), 0, 0, k};
}

/// Continues if the comparison holds; otherwise jumps by `jump_offset`, counted from the next
/// instruction.
sock_filter jump_unless(int code, std::uint32_t k, std::size_t jump_offset) {
  return {static_cast<std::uint16_t>(BPF_JMP | BPF_K | code), 0,
          static_cast<std::uint8_t>(jump_offset), k};
}

int load_code(std::size_t bytes) { return bytes == 4 ? BPF_W : bytes == 2 ? BPF_H : BPF_B; }

/// Compares the name and its NUL in the largest available words. The length is checked first: a
/// load beyond the end of the datagram would drop it, even if another channel matches.
std::vector<sock_filter> pass_channel(std::string_view name) {
  const std::string text = std::string(name) + '\0';
  const auto end = static_cast<std::uint32_t>(kChannelOffset + text.size());
  std::vector<sock_filter> part{statement(BPF_LD | BPF_W | BPF_LEN, 0),
                                jump_unless(BPF_JGE, end, 0)};
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t left = text.size() - at;
    const std::size_t bytes = left >= 4 ? 4 : left >= 2 ? 2 : 1;
    std::uint32_t value = 0;
    for (const char c : text.substr(at, bytes)) value = value << 8 | static_cast<std::uint8_t>(c);
    part.push_back(statement(BPF_LD | BPF_ABS | load_code(bytes),
                             static_cast<std::uint32_t>(kChannelOffset + at)));
    part.push_back(jump_unless(BPF_JEQ, value, 0));
    at += bytes;
  }
  part.push_back(statement(BPF_RET | BPF_K, kPass));
  for (std::size_t i = 1; i < part.size(); i += 2) {
    if (BPF_CLASS(part[i].code) == BPF_JMP) {
      part[i].jf = static_cast<std::uint8_t>(part.size() - i - 1);
    }
  }
  return part;
}

bool is_bound_datagram_socket(int descriptor) {
  int type = 0;
  socklen_t size = sizeof(type);
  if (getsockopt(descriptor, SOL_SOCKET, SO_TYPE, &type, &size) != 0 || type != SOCK_DGRAM) {
    return false;
  }
  sockaddr_in address{};
  size = sizeof(address);
  auto* const any = reinterpret_cast<sockaddr*>(&address);
  return getsockname(descriptor, any, &size) == 0 && address.sin_family == AF_INET &&
         address.sin_port != 0;
}

}  // namespace

std::vector<sock_filter> channel_filter(const Channels& channels) {
  std::vector<sock_filter> program{statement(BPF_LD | BPF_W | BPF_ABS, kHeaderBytes),
                                   {BPF_JMP | BPF_JEQ | BPF_K, 1, 0, kShortMessage},
                                   statement(BPF_RET | BPF_K, kPass)};
  for (const std::string& channel : channels) {
    const std::vector<sock_filter> part = pass_channel(channel);
    program.insert(program.end(), part.begin(), part.end());
  }
  program.push_back(statement(BPF_RET | BPF_K, kDrop));
  return program;
}

bool attach_channel_filter(const Channels& channels, const std::set<int>& sockets) {
  std::vector<sock_filter> filter = channel_filter(channels);
  const bool fits = filter.size() <= BPF_MAXINSNS;
  const sock_fprog program{static_cast<unsigned short>(filter.size()), filter.data()};
  bool all = !sockets.empty();
  for (const int socket : sockets) {
    if (fits && setsockopt(socket, SOL_SOCKET, SO_ATTACH_FILTER, &program, sizeof(program)) == 0) {
      continue;
    }
    const int none = 0;  // a filter attached before would drop the newest channels
    setsockopt(socket, SOL_SOCKET, SO_DETACH_FILTER, &none, sizeof(none));
    all = false;
  }
  return all;
}

std::set<int> bound_datagram_sockets() {
  std::set<int> found;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", none)) {
    const int descriptor = std::atoi(entry.path().filename().c_str());
    if (is_bound_datagram_socket(descriptor)) found.insert(descriptor);
  }
  return found;
}

std::set<int> bound_datagram_sockets_except(const std::set<int>& existing) {
  std::set<int> found = bound_datagram_sockets();
  for (const int other : existing) found.erase(other);
  return found;
}

}  // namespace adit
