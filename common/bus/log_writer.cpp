// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/log_writer.hpp"

#include <cerrno>
#include <stdexcept>
#include <system_error>

#include "common/bus/log_format.hpp"

namespace adit {
namespace {

void put(std::uint64_t value, int bytes, std::string& header) {
  for (int shift = 8 * (bytes - 1); shift >= 0; shift -= 8) {
    header.push_back(static_cast<char>(value >> static_cast<unsigned>(shift)));
  }
}

std::string header_of(const LogEventView& event, std::int64_t number) {
  std::string header;
  header.reserve(log_format::kHeaderBytes);
  put(log_format::kSync, 4, header);
  put(static_cast<std::uint64_t>(number), 8, header);
  put(static_cast<std::uint64_t>(event.utime), 8, header);
  put(event.channel.size(), 4, header);
  put(event.data.size(), 4, header);
  return header;
}

}  // namespace

LogWriter::LogWriter(const std::filesystem::path& path)
    : path_(path.string()), file_(path, std::ios::binary | std::ios::trunc) {
  require_good();
}

void LogWriter::write(const LogEventView& event) {
  file_ << header_of(event, events_) << event.channel;
  file_.write(reinterpret_cast<const char*>(event.data.data()),
              static_cast<std::streamsize>(event.data.size()));
  require_good();
  ++events_;
}

void LogWriter::close() {
  file_.close();
  require_good();
}

void LogWriter::require_good() const {
  if (file_) return;
  throw std::runtime_error(path_ + ": cannot write: " + std::generic_category().message(errno));
}

}  // namespace adit
