// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/messages/result.hpp"
#include "common/types/mission.hpp"
#include "viewer/server/protocol.hpp"

namespace adit {

/// Takes orders of clients that know a token: the services adit/order, with the orders of
/// `adit order`, and adit/process, which starts, stops and restarts processes.
class OrderService {
 public:
  /// Starts, stops or restarts a process. Returns why that is not possible, or an empty text.
  using ControlProcess =
      std::function<std::string(const std::string& action, const std::string& process)>;

  /// `bus` must outlive this.
  OrderService(Bus& bus, std::string token, ControlProcess control_process);
  OrderService(const OrderService&) = delete;
  OrderService& operator=(const OrderService&) = delete;

  [[nodiscard]] static std::vector<foxglove_protocol::Service> services();

  /// The reason of a rejection is valid until the next call.
  Result<std::string> call(const foxglove_protocol::ServiceCall& call);

 private:
  struct Pending {
    MissionOrder::Kind kind = MissionOrder::Kind::kPause;
    int repetitions = 0;
  };

  Result<std::string> order(const std::string& name);
  Result<std::string> control(const std::string& action, const std::string& process);
  void repeat();

  Bus& bus_;
  std::string token_;
  ControlProcess control_process_;
  std::string failure_;
  std::optional<Pending> pending_;
  std::optional<MissionPhase> phase_;
};

}  // namespace adit
