// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "procs/supervisor/procman_view.hpp"

#include <cstddef>
#include <utility>

namespace adit {
namespace {

constexpr std::size_t kTextBytesMax = 8'000;     // of one process at a time
constexpr std::size_t kOutputBytesMax = 50'000;  // of one message

}  // namespace

ProcmanStatus procman_status(const KeptProcess& process) {
  const ListedCommand& command = process.command();
  return {{command.id, command.exec, command.group, command.auto_respawn, command.stop_signal,
           command.stop_time_allowed_s},
          process.pid(),
          process.run_id(),
          process.wait_status(),
          process.use().cpu_cores,
          process.use().address_bytes,
          process.use().memory_bytes};
}

std::vector<ProcmanOutput> OutputRelay::take(const Keeper& keeper, const std::string& deputy,
                                             std::int64_t utime) {
  std::vector<ProcmanOutput> outputs;
  std::size_t bytes = kOutputBytesMax;
  for (const KeptProcess& process : keeper.processes()) {
    std::int64_t& sent = sent_lines_[process.command().id];
    if (process.output().next() == sent) continue;
    if (process.output().next() < sent) sent = 0;  // it was forgotten between
    const OutputPiece piece = process.output().since(sent, kTextBytesMax);
    sent = piece.next;
    std::string text = text_of(piece);
    if (bytes + text.size() > kOutputBytesMax) {
      outputs.push_back({utime, deputy, {}});
      bytes = 0;
    }
    bytes += text.size();
    outputs.back().texts.push_back({process.command().id, std::move(text)});
  }
  return outputs;
}

}  // namespace adit
