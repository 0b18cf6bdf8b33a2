// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>

#include "common/cloud/cloud.hpp"
#include "common/cloud/cloud_request.hpp"

namespace adit {

/// The newest 3D scans, for those who missed one: who keeps them may just have been started again,
/// and a message may have been lost. Some MB.
class HeldClouds {
 public:
  static constexpr std::size_t kMax = 8;
  /// One that was sent so shortly ago may be on its way, or may just be handled.
  static constexpr std::int64_t kOnItsWayUs = 3'000'000;

  /// In order of time; `utime` is the bus time at which it was sent.
  void add(const Cloud& cloud, std::int64_t utime);

  /// The newest that was sent long enough ago by `utime` and that the other asks for; nullptr where
  /// there is none.
  [[nodiscard]] const Cloud* missed(const CloudRequest& request, std::int64_t utime) const;

 private:
  struct Sent {
    std::int64_t utime = 0;
    Cloud cloud;
  };

  std::deque<Sent> sent_;
};

}  // namespace adit
