// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <list>
#include <string>
#include <vector>

#include "procs/supervisor/os/descriptor.hpp"

namespace adit {

/// What a terminal is answered: "ok" or "error" and a text on the first line, then the text.
struct TerminalAnswer {
  std::string text;
  std::function<std::string()> more = {};  ///< what to send besides, as long as somebody listens
};

/// Serves `adit ps` and the like on a socket of this computer that only the same user and root may
/// open: the file is theirs alone, and the kernel says who is at the other end. A request is one
/// line of words divided by tabs. Nothing here ever waits; a client that does not read is let go.
class TerminalServer {
 public:
  /// Answers a request; an exception becomes the error that the terminal shows.
  using Answer = std::function<TerminalAnswer(const std::vector<std::string>& words)>;

  /// Makes the folder and the socket. Throws std::runtime_error where that cannot be, or another
  /// supervisor listens there already.
  explicit TerminalServer(std::filesystem::path path);
  ~TerminalServer();
  TerminalServer(const TerminalServer&) = delete;
  TerminalServer& operator=(const TerminalServer&) = delete;

  void poll(const Answer& answer);

 private:
  struct Client {
    Descriptor socket;
    std::string heard = {};
    std::string to_send = {};
    std::function<std::string()> more = {};
    bool answered = false;
    bool gone = false;
  };

  void accept_all();
  static void hear(Client& client, const Answer& answer);
  static void send(Client& client);
  static bool is_done(const Client& client);

  std::filesystem::path path_;
  Descriptor socket_;
  std::list<Client> clients_;
};

}  // namespace adit
