// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/terminal/terminal_server.hpp"

#include <array>
#include <cerrno>
#include <exception>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <sys/stat.h>

#include "procs/supervisor/terminal/unix_address.hpp"

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

/// Ours alone, so that nobody else puts a socket there.
void make_folder(const fs::path& folder) {
  const mode_t mask = umask(kOwnerOnly);
  std::error_code error;
  fs::create_directories(folder, error);
  umask(mask);
  struct stat info {};
  if (lstat(folder.c_str(), &info) != 0) fail(folder, errno_text());
  if (!S_ISDIR(info.st_mode) || (info.st_uid != geteuid() && info.st_uid != 0)) {
    fail(folder, "is no folder of this user");
  }
}

/// A socket that nobody listens to is left from a supervisor that was killed.
void remove_stale(const fs::path& path) {
  const sockaddr_un address = unix_address(path);
  const Descriptor probe(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (connect(probe.get(), as_sockaddr(address), sizeof(address)) == 0) {
    fail(path, "another supervisor listens here");
  }
  if (errno == ECONNREFUSED) fs::remove(path);
}

bool may_order(int socket) {
  ucred peer{};
  socklen_t size = sizeof(peer);
  if (getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) return false;
  return peer.uid == geteuid() || peer.uid == 0;
}

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words(1);
  for (const char c : line) {
    if (c == '\t') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

}  // namespace

TerminalServer::TerminalServer(fs::path path) : path_(std::move(path)) {
  make_folder(path_.parent_path());
  remove_stale(path_);
  socket_ = Descriptor(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  const sockaddr_un address = unix_address(path_);
  const mode_t mask = umask(kOwnerOnly | S_IXUSR);
  const int bound = bind(socket_.get(), as_sockaddr(address), sizeof(address));
  const std::string why = errno_text();
  umask(mask);
  if (bound != 0) fail(path_, why);
  if (listen(socket_.get(), static_cast<int>(kClientsMax)) != 0) fail(path_, errno_text());
}

TerminalServer::~TerminalServer() {
  std::error_code ignored;
  fs::remove(path_, ignored);
}

void TerminalServer::poll(const Answer& answer) {
  accept_all();
  for (Client& client : clients_) {
    if (!client.answered) hear(client, answer);
    send(client);
  }
  clients_.remove_if([](const Client& client) { return client.gone; });
}

void TerminalServer::accept_all() {
  for (;;) {
    Descriptor client(accept4(socket_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
    if (!client) return;
    if (clients_.size() < kClientsMax && may_order(client.get())) {
      clients_.push_back({std::move(client)});
    }
  }
}

void TerminalServer::hear(Client& client, const Answer& answer) {
  std::array<char, 4096> buffer;
  const ssize_t n = recv(client.socket.get(), buffer.data(), buffer.size(), 0);
  if (n > 0) client.heard.append(buffer.data(), static_cast<std::size_t>(n));
  const std::size_t end = client.heard.find('\n');
  if (end == std::string::npos) {
    client.gone = n == 0 || (n < 0 && errno != EAGAIN) || client.heard.size() > kRequestBytesMax;
    return;
  }
  client.answered = true;
  try {
    TerminalAnswer given = answer(words_of(client.heard.substr(0, end)));
    client.to_send = "ok\n" + given.text;
    client.more = std::move(given.more);
  } catch (const std::exception& error) {
    client.to_send = "error " + std::string(error.what()) + "\n";
  }
}

void TerminalServer::send(Client& client) {
  if (client.more) client.to_send += client.more();
  while (!client.to_send.empty() && !client.gone) {
    const ssize_t n =
        ::send(client.socket.get(), client.to_send.data(), client.to_send.size(), MSG_NOSIGNAL);
    if (n < 0 && errno == EAGAIN) break;
    if (n < 0) client.gone = true;
    client.to_send.erase(0, n < 0 ? 0 : static_cast<std::size_t>(n));
  }
  if (client.to_send.size() > kWaitingBytesMax) client.gone = true;
  if (client.answered && is_done(client)) client.gone = true;
}

bool TerminalServer::is_done(const Client& client) {
  if (!client.more) return client.to_send.empty();
  char nothing = 0;
  return recv(client.socket.get(), &nothing, 1, MSG_DONTWAIT | MSG_PEEK) == 0;  // hung up
}

}  // namespace adit
