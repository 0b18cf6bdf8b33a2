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

/// Response to a request. On the socket, a line "ok" precedes the text; an error is the one line
/// "error TEXT".
struct ControlResponse {
  std::string text;
  std::function<std::string()> more = {};  ///< further text, polled until the client disconnects
};

/// Serves `adit ps` and related commands on a Unix domain socket. Only the same user and root may
/// connect: by the file mode, and by the peer credentials of the kernel (SO_PEERCRED). A request is
/// one line of fields separated by tabs. Never blocks; a client that does not read is disconnected.
class ControlServer {
 public:
  /// Handles a request; an exception becomes the error response.
  using RequestHandler = std::function<ControlResponse(const std::vector<std::string>& fields)>;

  /// Creates the folder and the socket. Throws std::runtime_error on failure, or if another
  /// supervisor listens there.
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
