// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "drivers/ports/serial_port.hpp"

#include <cerrno>
#include <cstring>
#include <map>

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/serial.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include "drivers/ports/descriptor_io.hpp"

#include "common/text/message_text.hpp"

namespace adit {
namespace {

constexpr int kFirstBaud = 9600;

const std::map<int, speed_t>& speeds() {
  static const std::map<int, speed_t> all{
      {4800, B4800},      {9600, B9600},     {19200, B19200},     {38400, B38400},
      {57600, B57600},    {115200, B115200}, {230400, B230400},   {460800, B460800},
      {500000, B500000},  {921600, B921600}, {1000000, B1000000}, {2000000, B2000000},
      {3000000, B3000000}};
  return all;
}

/// USB adapters otherwise collect bytes for 16 ms. Not every driver knows the flag.
void request_low_latency(int descriptor) {
  serial_struct settings{};
  if (ioctl(descriptor, TIOCGSERIAL, &settings) != 0) return;
  settings.flags |= ASYNC_LOW_LATENCY;
  ioctl(descriptor, TIOCSSERIAL, &settings);
}

}  // namespace

std::string SerialPort::open() {
  close();
  descriptor_ = ::open(path_.c_str(), O_RDWR | O_NOCTTY | O_NONBLOCK | O_CLOEXEC);
  if (descriptor_ < 0) {
    return fmt::format("cannot open {}: {}", quote(path_), std::strerror(errno));
  }
  if (isatty(descriptor_) == 0) {
    close();
    return fmt::format("{} is not a serial device", quote(path_));
  }
  ioctl(descriptor_, TIOCEXCL);
  request_low_latency(descriptor_);
  if (set_baud(kFirstBaud)) return {};
  const std::string reason = std::strerror(errno);
  close();
  return fmt::format("cannot set {}: {}", quote(path_), reason);
}

void SerialPort::close() {
  if (descriptor_ >= 0) ::close(descriptor_);
  descriptor_ = -1;
}

bool SerialPort::set_baud(int baud) {
  const auto speed = speeds().find(baud);
  termios settings{};
  if (speed == speeds().end() || tcgetattr(descriptor_, &settings) != 0) return false;
  cfmakeraw(&settings);
  settings.c_cflag &= ~static_cast<tcflag_t>(CSTOPB | CRTSCTS);
  settings.c_cflag |= CLOCAL | CREAD;
  settings.c_cc[VMIN] = 0;
  settings.c_cc[VTIME] = 0;
  cfsetispeed(&settings, speed->second);
  cfsetospeed(&settings, speed->second);
  // After what was written has left, since it is for the old rate.
  return tcsetattr(descriptor_, TCSADRAIN, &settings) == 0 && tcflush(descriptor_, TCIFLUSH) == 0;
}

std::optional<std::size_t> SerialPort::read(std::span<std::uint8_t> bytes) {
  // A terminal without data returns 0 or EAGAIN by its settings; one that was unplugged fails with
  // EIO, or 0 together with a hang-up.
  return read_available(descriptor_, bytes, EndOfData::kIsHangUp);
}

bool SerialPort::write(std::span<const std::uint8_t> bytes) {
  return write_available(descriptor_, bytes);
}

}  // namespace adit
