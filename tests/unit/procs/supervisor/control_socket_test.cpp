// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/control/control_socket.hpp"

#include <chrono>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "procs/supervisor/control/control_client.hpp"
#include "procs/supervisor/control/control_server.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit {
namespace {

using testing::HasSubstr;

class ControlSocketTest : public testing::Test {
 protected:
  ControlSocketTest()
      : server_(folder_.path() / "deep" / "s.sock"), thread_([this](const std::stop_token& stop) {
          while (!stop.stop_requested()) {
            server_.poll([](const auto& request) { return respond(request); });
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
          }
        }) {}

  static ControlResponse respond(const std::vector<std::string>& request) {
    if (request[0] == "fail") throw std::invalid_argument("no such thing");
    if (request[0] == "large") return {std::string(3'000'000, 'x')};
    if (request[0] == "count") {
      return {"", [n = 0]() mutable { return std::to_string(n++) + "\n"; }};
    }
    std::string text;
    for (const std::string& field : request) text += "<" + field + ">";
    return {text};
  }

  [[nodiscard]] std::filesystem::path path() const { return folder_.path() / "deep" / "s.sock"; }

  std::string error_of(const std::vector<std::string>& request) const {
    try {
      request_from_supervisor(path(), request);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "no error";
  }

  test::ScratchFolder folder_;
  ControlServer server_;
  std::jthread thread_;
};

TEST_F(ControlSocketTest, TransmitsRequestAndResponse) {
  EXPECT_EQ(request_from_supervisor(path(), {"start", "a b", "", "c"}), "<start><a b><><c>");
  EXPECT_EQ(request_from_supervisor(path(), {"ps"}), "<ps>");
}

TEST_F(ControlSocketTest, TransmitsALargeResponse) {
  EXPECT_EQ(request_from_supervisor(path(), {"large"}).size(), 3'000'000U);
}

TEST_F(ControlSocketTest, ReturnsTheErrorToTheClient) {
  EXPECT_EQ(error_of({"fail"}), "no such thing");
  EXPECT_EQ(request_from_supervisor(path(), {"ps"}), "<ps>");
}

TEST_F(ControlSocketTest, StreamsUntilTheClientDisconnects) {
  std::string received;
  const auto take = [&](std::string_view text) {
    received += text;
    if (received.size() > 20) throw std::runtime_error("enough");
  };
  EXPECT_THROW(request_from_supervisor(path(), {"count"}, take), std::runtime_error);
  EXPECT_THAT(received, testing::StartsWith("0\n1\n2\n"));
  EXPECT_EQ(request_from_supervisor(path(), {"ps"}), "<ps>");
}

TEST_F(ControlSocketTest, IsAccessibleToItsUserOnly) {
  struct stat info {};
  ASSERT_EQ(stat(path().c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777U, 0600U);
  ASSERT_EQ(stat(path().parent_path().c_str(), &info), 0);
  EXPECT_EQ(info.st_mode & 0777U, 0700U);
}

TEST_F(ControlSocketTest, IsNotTakenFromARunningSupervisor) {
  try {
    const ControlServer second(path());
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("another supervisor listens here"));
  }
}

TEST_F(ControlSocketTest, DisconnectsInvalidClients) {
  const FileDescriptor stale(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const sockaddr_un address = unix_address(path());
  ASSERT_EQ(connect(stale.get(), to_sockaddr(address), sizeof(address)), 0);
  const std::string endless(60'000, 'x');
  for (int i = 0; i < 100 && send(stale.get(), endless.data(), endless.size(), MSG_NOSIGNAL) > 0;
       ++i) {
  }
  EXPECT_EQ(request_from_supervisor(path(), {"ps"}), "<ps>");
}

TEST(ControlClient, ReplacesAStaleSocket) {
  const test::ScratchFolder folder;
  const auto path = folder / "s.sock";
  {
    const FileDescriptor killed(socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const sockaddr_un address = unix_address(path);
    ASSERT_EQ(bind(killed.get(), to_sockaddr(address), sizeof(address)), 0);
  }
  EXPECT_NO_THROW(ControlServer{path});
  EXPECT_FALSE(std::filesystem::exists(path));  // removed by the destructor
}

TEST(ControlClient, ReportsAMissingSupervisor) {
  const test::ScratchFolder folder;
  try {
    request_from_supervisor(folder / "none.sock", {"ps"});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("start adit-supervisor"));
  }
  EXPECT_THROW(request_from_supervisor(folder / std::string(200, 'x'), {"ps"}), std::runtime_error);
}

}  // namespace
}  // namespace adit
