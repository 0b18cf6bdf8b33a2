// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <list>
#include <string>
#include <vector>

#include "procs/supervisor/os/file_descriptor.hpp"

namespace adit {

/// What a terminal is answered: "ok" or "error" and a text on the first line, then the text.
struct ControlResponse {
  std::string text;
  std::function<std::string()> more = {};  ///< what to send besides, as long as somebody listens
};

/// Serves `adit ps` and the like on a socket of this computer that only the same user and root may
/// open: the file is theirs alone, and the kernel says who is at the other end. A request is one
/// line of words divided by tabs. Nothing here ever waits; a client that does not read is let go.
class ControlServer {
 public:
  /// Answers a request; an exception becomes the error that the terminal shows.
  using RequestHandler = std::function<ControlResponse(const std::vector<std::string>& words)>;

  /// Makes the folder and the socket. Throws std::runtime_error where that cannot be, or another
  /// supervisor listens there already.
  explicit ControlServer(std::filesystem::path path);
  ~ControlServer();
  ControlServer(const ControlServer&) = delete;
  ControlServer& operator=(const ControlServer&) = delete;

  void poll(const RequestHandler& handler);

 private:
  struct Client {
    FileDescriptor socket;
    std::string received = {};
    std::string unsent = {};
    std::function<std::string()> more = {};
    bool responded = false;
    bool closed = false;
  };

  void accept_all();
  static void receive(Client& client, const RequestHandler& handler);
  static void send(Client& client);
  static bool is_done(const Client& client);

  std::filesystem::path path_;
  FileDescriptor socket_;
  std::list<Client> clients_;
};

}  // namespace adit
