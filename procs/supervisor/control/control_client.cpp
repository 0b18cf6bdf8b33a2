// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/control/control_client.hpp"

#include <array>
#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "procs/supervisor/control/control_socket.hpp"
#include "procs/supervisor/os/file_descriptor.hpp"

namespace adit {
namespace {

FileDescriptor connected_to(const std::filesystem::path& path) {
  const sockaddr_un address = unix_address(path);
  FileDescriptor connection(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (connect(connection.get(), to_sockaddr(address), sizeof(address)) == 0) return connection;
  throw std::runtime_error("no supervisor at " + path.string() + " (" +
                           std::generic_category().message(errno) +
                           "); start adit-supervisor or set --socket");
}

void send_request(int connection, const std::vector<std::string>& request) {
  std::string line;
  for (const std::string& field : request) line += (line.empty() ? "" : "\t") + field;
  line += '\n';
  std::string_view rest = line;
  while (!rest.empty()) {
    const ssize_t n = send(connection, rest.data(), rest.size(), MSG_NOSIGNAL);
    if (n < 0) throw std::system_error(errno, std::generic_category(), "the supervisor");
    rest.remove_prefix(static_cast<std::size_t>(n));
  }
}

/// Strips the first line of a response: "ok", or an error, which it throws.
class ResponseReader {
 public:
  explicit ResponseReader(const std::function<void(std::string_view)>& take) : take_(take) {}

  void add(std::string_view text) {
    if (accepted_) return take_(text);
    head_ += text;
    const std::size_t end = head_.find('\n');
    if (end == std::string::npos) return;
    const std::string first = head_.substr(0, end);
    if (first != "ok") throw std::runtime_error(first.substr(first.find(' ') + 1));
    accepted_ = true;
    take_(std::string_view(head_).substr(end + 1));
  }

  [[nodiscard]] bool accepted() const { return accepted_; }

 private:
  const std::function<void(std::string_view)>& take_;
  std::string head_;
  bool accepted_ = false;
};

}  // namespace

void request_from_supervisor(const std::filesystem::path& socket,
                             const std::vector<std::string>& request,
                             const std::function<void(std::string_view)>& take) {
  const FileDescriptor connection = connected_to(socket);
  send_request(connection.get(), request);
  ResponseReader response(take);
  std::array<char, 4096> buffer;
  ssize_t n = 0;
  while ((n = recv(connection.get(), buffer.data(), buffer.size(), 0)) > 0) {
    response.add({buffer.data(), static_cast<std::size_t>(n)});
  }
  if (!response.accepted()) throw std::runtime_error("the supervisor closed the connection");
}

std::string request_from_supervisor(const std::filesystem::path& socket,
                                    const std::vector<std::string>& request) {
  std::string response;
  request_from_supervisor(socket, request, [&](std::string_view text) { response += text; });
  return response;
}

}  // namespace adit
