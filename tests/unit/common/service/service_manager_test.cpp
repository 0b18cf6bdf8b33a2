// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/service/service_manager.hpp"

#include <array>
#include <cstddef>
#include <cstdlib>
#include <string>

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

/// A notification socket like that of systemd. '@' is the NUL of an abstract socket.
class Listener {
 public:
  explicit Listener(const std::string& name)
      : socket_(socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    name.copy(address.sun_path, sizeof(address.sun_path) - 1);
    if (name.front() == '@') address.sun_path[0] = '\0';
    const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + name.size());
    EXPECT_EQ(bind(socket_, reinterpret_cast<const sockaddr*>(&address), size), 0);
    setenv("NOTIFY_SOCKET", name.c_str(), 1);
  }
  ~Listener() {
    unsetenv("NOTIFY_SOCKET");
    close(socket_);
  }
  Listener(const Listener&) = delete;
  Listener& operator=(const Listener&) = delete;

  [[nodiscard]] std::string received() const {
    std::array<char, 200> buffer{};
    const ssize_t n = recv(socket_, buffer.data(), buffer.size(), 0);
    return n < 0 ? "nothing" : std::string(buffer.data(), static_cast<std::size_t>(n));
  }

 private:
  int socket_;
};

TEST(ServiceManager, ReceivesNotificationsOnItsSocket) {
  const test::ScratchFolder folder;
  const Listener listener((folder / "notify").string());
  const ServiceManager manager;
  EXPECT_EQ(listener.received(), "nothing");
  manager.notify("READY=1\nSTATUS=all run");
  EXPECT_EQ(listener.received(), "READY=1\nSTATUS=all run");
}

TEST(ServiceManager, ReceivesNotificationsOnAnAbstractSocket) {
  const Listener listener("@adit-test-" + std::to_string(getpid()));
  ServiceManager().notify("WATCHDOG=1");
  EXPECT_EQ(listener.received(), "WATCHDOG=1");
}

TEST(ServiceManager, MayBeMissing) {
  EXPECT_NO_THROW(ServiceManager().notify("READY=1"));
  const test::ScratchFolder folder;
  std::string name = (folder / "notify").string();
  setenv("NOTIFY_SOCKET", name.c_str(), 1);
  EXPECT_NO_THROW(ServiceManager().notify("READY=1"));
  unsetenv("NOTIFY_SOCKET");
}

TEST(ServiceManager, ExpectsAWatchdogOfTheMainProcessOnly) {
  EXPECT_FALSE(ServiceManager::expects_watchdog());
  setenv("WATCHDOG_PID", std::to_string(getpid()).c_str(), 1);
  EXPECT_TRUE(ServiceManager::expects_watchdog());
  setenv("WATCHDOG_PID", std::to_string(getppid()).c_str(), 1);
  EXPECT_FALSE(ServiceManager::expects_watchdog());
  unsetenv("WATCHDOG_PID");
}

}  // namespace
}  // namespace adit
