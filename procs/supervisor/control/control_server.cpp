// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/control/control_server.hpp"

#include <array>
#include <cerrno>
#include <exception>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <sys/stat.h>

#include "procs/supervisor/control/control_socket.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kRequestBytesMax = 65'536;
constexpr std::size_t kWaitingBytesMax = 4'000'000;
constexpr std::size_t kClientsMax = 50;
constexpr mode_t kOwnerOnly = 0077;

[[noreturn]] void fail(const fs::path& path, const std::string& what) {
  throw std::runtime_error(path.string() + ": " + what);
}

std::string errno_text() { return std::generic_category().message(errno); }

/// Creates the folder with access for the owner only, so that no other user can put a socket there.
void make_folder(const fs::path& folder) {
  const mode_t mask = umask(kOwnerOnly);
  std::error_code error;
  fs::create_directories(folder, error);
  umask(mask);
  struct stat info {};
  if (lstat(folder.c_str(), &info) != 0) fail(folder, errno_text());
  if (!S_ISDIR(info.st_mode) || (info.st_uid != geteuid() && info.st_uid != 0)) {
    fail(folder, "is not a directory of this user");
  }
}

/// Removes the socket file of a supervisor that was killed. Throws if a supervisor listens there.
void remove_stale(const fs::path& path) {
  const sockaddr_un address = unix_address(path);
  const FileDescriptor probe(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (connect(probe.get(), to_sockaddr(address), sizeof(address)) == 0) {
    fail(path, "another supervisor listens here");
  }
  if (errno == ECONNREFUSED) fs::remove(path);
}

bool is_authorized(int socket) {
  ucred peer{};
  socklen_t size = sizeof(peer);
  if (getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return false;
  return peer.uid == geteuid() || peer.uid == 0;
}

std::vector<std::string> fields_of(const std::string& line) {
  std::vector<std::string> fields(1);
  for (const char c : line) {
    if (c == '\t') {
      fields.emplace_back();
    } else {
      fields.back() += c;
    }
  }
  return fields;
}

}  // namespace

ControlServer::ControlServer(fs::path path) : path_(std::move(path)) {
  make_folder(path_.parent_path());
  remove_stale(path_);
  socket_ = FileDescriptor(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const sockaddr_un address = unix_address(path_);
  const mode_t mask = umask(kOwnerOnly | S_IXUSR);
  const int bound = bind(socket_.get(), to_sockaddr(address), sizeof(address));
  const std::string bind_error = errno_text();
  umask(mask);
  if (bound != 0) fail(path_, bind_error);
  if (listen(socket_.get(), static_cast<int>(kClientsMax)) != 0) fail(path_, errno_text());
}

ControlServer::~ControlServer() {
  std::error_code ignored;
  fs::remove(path_, ignored);
}

void ControlServer::poll(const RequestHandler& handler) {
  accept_all();
  for (Client& client : clients_) {
    if (!client.responded) receive(client, handler);
    send(client);
  }
  clients_.remove_if([](const Client& client) { return client.closed; });
}

void ControlServer::accept_all() {
  for (;;) {
    FileDescriptor client(accept4(socket_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!client) return;
    if (clients_.size() < kClientsMax && is_authorized(client.get())) {
      clients_.push_back({std::move(client)});
    }
  }
}

void ControlServer::receive(Client& client, const RequestHandler& handler) {
  std::array<char, 4096> buffer;
  const ssize_t n = recv(client.socket.get(), buffer.data(), buffer.size(), 0);
  if (n > 0) client.received.append(buffer.data(), static_cast<std::size_t>(n));
  const std::size_t end = client.received.find('\n');
  if (end == std::string::npos) {
    client.closed =
        n == 0 || (n < 0 && errno != EAGAIN) || client.received.size() > kRequestBytesMax;
    return;
  }
  client.responded = true;
  try {
    ControlResponse response = handler(fields_of(client.received.substr(0, end)));
    client.unsent = "ok\n" + response.text;
    client.more = std::move(response.more);
  } catch (const std::exception& error) {
    client.unsent = "error " + std::string(error.what()) + "\n";
  }
}

void ControlServer::send(Client& client) {
  if (client.more) client.unsent += client.more();
  while (!client.unsent.empty() && !client.closed) {
    const ssize_t n =
        ::send(client.socket.get(), client.unsent.data(), client.unsent.size(), MSG_NOSIGNAL);
    if (n < 0 && errno == EAGAIN) break;
    if (n < 0) client.closed = true;
    client.unsent.erase(0, n < 0 ? 0 : static_cast<std::size_t>(n));
  }
  if (client.unsent.size() > kWaitingBytesMax) client.closed = true;
  if (client.responded && is_done(client)) client.closed = true;
}

bool ControlServer::is_done(const Client& client) {
  if (!client.more) return client.unsent.empty();
  char nothing = 0;
  return recv(client.socket.get(), &nothing, 1, MSG_DONTWAIT | MSG_PEEK) == 0;  // disconnected
}

}  // namespace adit
