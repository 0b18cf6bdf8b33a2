// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/logs_answer.hpp"

#include <cstddef>
#include <stdexcept>

namespace adit {
namespace {

constexpr std::size_t kAnswerBytesMax = 2'000'000;  // more than an OutputLog has

/// What was printed since line `next`; looked for by name each time, since a list that is read
/// again can take a process away.
std::string text_since(Fleet& fleet, const std::string& id, std::int64_t& next) {
  const OutputLog* const output = fleet.output(id);
  if (!output) return {};
  const OutputPiece piece = output->since(next, kAnswerBytesMax);
  next = piece.next;
  return text_of(piece);
}

}  // namespace

TerminalAnswer logs_answer(Fleet& fleet, const std::string& id, bool follow) {
  const ListedCommand* const listed = fleet.site().list.find(id);
  if (!listed) throw std::invalid_argument("there is no process \"" + id + "\" in the list");
  std::int64_t next = 0;
  TerminalAnswer answer{text_since(fleet, id, next)};
  if (!fleet.output(id)) answer.text = "(nothing was heard of it from " + listed->deputy + ")\n";
  if (!follow) return answer;
  answer.more = [&fleet, id, next]() mutable { return text_since(fleet, id, next); };
  return answer;
}

}  // namespace adit
