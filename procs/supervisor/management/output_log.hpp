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

/// Unread lines of an OutputLog.
struct OutputLines {
  std::vector<std::string> lines;
  std::int64_t omitted = 0;  ///< unread lines before these, erased or beyond the byte limit
  std::int64_t next = 0;     ///< number of the next line
};

/// The lines, preceded by the number of omitted lines.
std::string text_of(const OutputLines& unread);

/// The last lines printed by a process, numbered from 0. Terminal control characters and invalid
/// UTF-8 are replaced by '?', and long lines are split, to protect the terminal and the memory of
/// the reader.
class OutputLog {
 public:
  static constexpr std::size_t kLinesMax = 1000;
  static constexpr std::size_t kLineBytesMax = 1000;
  using OnLine = std::function<void(const std::string& line)>;

  /// `on_line` is called with every completed line, even if it is erased before it is read.
  explicit OutputLog(OnLine on_line = {}) : on_line_(std::move(on_line)) {}

  void add(std::string_view bytes);
  /// Completes a partial last line at the end of the process.
  void end_line();

  [[nodiscard]] std::int64_t next() const {
    return first_ + static_cast<std::int64_t>(lines_.size());
  }

  /// The newest lines from number `next` on that fit into `bytes_max`.
  [[nodiscard]] OutputLines since(std::int64_t next, std::size_t bytes_max) const;

 private:
  OnLine on_line_;
  std::deque<std::string> lines_;
  std::int64_t first_ = 0;  // number of the first stored line
  std::string partial_line_;
};

}  // namespace adit
