// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/lasers/pty_line.hpp"

#include <array>
#include <cerrno>
#include <cstdlib>
#include <map>
#include <system_error>
#include <utility>

#include <fcntl.h>
#include <termios.h>
#include <unistd.h>

namespace adit {
namespace {

[[noreturn]] void fail(const char* what) {
  throw std::system_error(errno, std::generic_category(), what);
}

}  // namespace

PtyLine::PtyLine(std::filesystem::path link) : link_(std::move(link)) { plug(); }

PtyLine::~PtyLine() { unplug(); }

void PtyLine::unplug() {
  std::error_code ignored;
  std::filesystem::remove(link_, ignored);
  if (master_ >= 0) close(master_);
  master_ = -1;
}

void PtyLine::plug() {
  unplug();
  master_ = posix_openpt(O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) fail("pseudo-terminal");
  std::array<char, 100> name{};
  if (ptsname_r(master_, name.data(), name.size()) != 0) fail("ptsname_r");
  // Without this, what is written before the driver opens it would be echoed back.
  termios raw{};
  if (tcgetattr(master_, &raw) != 0) fail("tcgetattr");
  cfmakeraw(&raw);
  tcsetattr(master_, TCSANOW, &raw);
  std::filesystem::create_symlink(name.data(), link_);
}

std::vector<std::uint8_t> PtyLine::read() {
  std::array<std::uint8_t, 4096> buffer{};
  const ssize_t count = ::read(master_, buffer.data(), buffer.size());
  if (count <= 0) return {};
  return {buffer.begin(), buffer.begin() + count};
}

/// What does not fit is lost, as on a line that nobody reads.
void PtyLine::write(std::span<const std::uint8_t> bytes) {
  if (!bytes.empty() && ::write(master_, bytes.data(), bytes.size()) < 0 && errno != EAGAIN) {
    fail("write to a pseudo-terminal");
  }
}

int PtyLine::host_baud() const {
  static const std::map<speed_t, int> bauds{
      {B9600, 9600},     {B19200, 19200},    {B38400, 38400},   {B57600, 57600},
      {B115200, 115200}, {B230400, 230400},  {B460800, 460800}, {B500000, 500000},
      {B921600, 921600}, {B1000000, 1000000}};
  termios settings{};
  if (tcgetattr(master_, &settings) != 0) return 0;
  const auto baud = bauds.find(cfgetospeed(&settings));
  return baud == bauds.end() ? 0 : baud->second;
}

}  // namespace adit
