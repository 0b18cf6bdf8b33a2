// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "common/types/procman.hpp"

namespace adit {

/// The claim of a supervisor to its name on the network. Two supervisors with one name would start
/// every process twice and both execute the orders. A supervisor therefore listens before it starts
/// a process: it probes with PM_DISCOVER, which a supervisor that holds the name answers with
/// PM_INFO. Of several that listen at the same time, the one with the smallest nonce remains. Times
/// are those of a monotonic clock [µs].
class NameClaim {
 public:
  /// Longer than the period of PM_INFO, so that a holder is found even if it misses each probe.
  static constexpr double kListenS = 1.5;

  /// `nonce` differs between supervisors.
  NameClaim(std::string name, std::int64_t nonce, double listen_s, std::int64_t now_us);

  /// A probe, if one is due.
  std::optional<ProcmanDiscovery> take_probe(std::int64_t utime, std::int64_t now_us);
  void on_message(const ProcmanDiscovery& probe);
  void on_message(const ProcmanInfo& info, std::int64_t now_us);
  /// A PM_INFO of this supervisor was published; the bus returns it.
  void published(const ProcmanInfo& info);

  /// Whether the name is held: no other supervisor was received while listening. Throws
  /// NodeEnd if another one has the name.
  bool is_held(std::int64_t now_us);

  /// Reports a supervisor with the same name that appeared later, as when two networks are joined;
  /// empty if there is none.
  [[nodiscard]] std::string problem(std::int64_t now_us) const;

 private:
  std::string name_;
  std::int64_t nonce_;
  std::int64_t listen_until_us_;
  std::int64_t next_probe_us_;
  bool held_ = false;
  bool lost_ = false;
  std::deque<std::int64_t> published_utimes_;  // the latest
  std::optional<std::int64_t> other_us_;       // last message of the other, once held
};

}  // namespace adit
