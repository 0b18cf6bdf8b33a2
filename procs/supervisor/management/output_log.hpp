// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace adit {

/// Lines that somebody has not read yet.
struct OutputLines {
  std::vector<std::string> lines;
  std::int64_t omitted = 0;  ///< lines before these that are gone or were too many
  std::int64_t next = 0;     ///< number of the line after the last
};

/// Line by line, with a word about those that are missed.
std::string text_of(const OutputLines& unread);

/// The last lines that a process has printed, numbered from 0. What is no text in them (controls of
/// a terminal, bytes that are no UTF-8) shows as '?', and a long line is cut in pieces, so that
/// what a process prints harms neither the terminal nor the memory of who looks.
class OutputLog {
 public:
  static constexpr std::size_t kLinesMax = 1000;
  static constexpr std::size_t kLineBytesMax = 1000;
  using OnLine = std::function<void(const std::string& line)>;

  /// `on_line` is told each line as it ends, also where they come faster than anybody reads.
  explicit OutputLog(OnLine on_line = {}) : on_line_(std::move(on_line)) {}

  void add(std::string_view bytes);
  /// The process is gone: what stands on its last line is a line.
  void end_line();

  [[nodiscard]] std::int64_t next() const {
    return first_ + static_cast<std::int64_t>(lines_.size());
  }

  /// The lines from number `next` on, of these the newest that together have so many bytes.
  [[nodiscard]] OutputLines since(std::int64_t next, std::size_t bytes_max) const;

 private:
  OnLine on_line_;
  std::deque<std::string> lines_;
  std::int64_t first_ = 0;  // number of the first line that is kept
  std::string partial_line_;
};

}  // namespace adit
