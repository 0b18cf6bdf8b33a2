// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/logs_answer.hpp"

#include <cstddef>
#include <stdexcept>

namespace adit {
namespace {

constexpr std::size_t kAnswerBytesMax = 2'000'000;  // more than an OutputLog has

const OutputLog& output_of(Fleet& fleet, const std::string& id) {
  const ListedCommand* const listed = fleet.site().list.find(id);
  if (!listed) throw std::invalid_argument("there is no process \"" + id + "\" in the list");
  const KeptProcess* const process = fleet.keeper().find(id);
  if (process) return process->output();
  throw std::invalid_argument("\"" + id + "\" runs on " + listed->deputy + ": ask there");
}

}  // namespace

TerminalAnswer logs_answer(Fleet& fleet, const std::string& id, bool follow) {
  const OutputLog& output = output_of(fleet, id);
  const OutputPiece all = output.since(0, kAnswerBytesMax);
  TerminalAnswer answer{text_of(all)};
  if (!follow) return answer;
  answer.more = [&output, next = all.next]() mutable {
    const OutputPiece piece = output.since(next, kAnswerBytesMax);
    next = piece.next;
    return text_of(piece);
  };
  return answer;
}

}  // namespace adit
