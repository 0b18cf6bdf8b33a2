// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/view/order_service.hpp"

#include <map>
#include <utility>

#include <nlohmann/json.hpp>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mission.hpp"
#include "common/seal/secret_text.hpp"
#include "common/service/wall_time.hpp"

namespace adit {
namespace {

using nlohmann::json;

constexpr std::uint32_t kOrderId = 1;
constexpr std::uint32_t kProcessId = 2;
constexpr std::int64_t kRepeatPeriodUs = 200'000;
constexpr int kRepetitionsMax = 50;  // ten seconds
constexpr std::size_t kRequestBytesMax = 4096;

const std::map<std::string, MissionOrder::Kind, std::less<>> kOrders{
    {"pause", MissionOrder::Kind::kPause},
    {"resume", MissionOrder::Kind::kResume},
    {"return_home", MissionOrder::Kind::kReturnHome},
    {"stop", MissionOrder::Kind::kStop}};

/// A text of an object; empty if there is none.
std::string text_in(const json& object, const char* name) {
  const auto found = object.find(name);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

}  // namespace

OrderService::OrderService(Bus& bus, std::string token, ControlProcess control_process)
    : bus_(bus), token_(std::move(token)), control_process_(std::move(control_process)) {
  subscribe<phase_t>(bus, channels::kPhase, Delivery::latest(),
                     [this](const MissionPhase& phase) { phase_ = phase; });
  bus.create_wall_timer(kRepeatPeriodUs, [this](std::int64_t) { repeat(); });
}

std::vector<foxglove_protocol::Service> OrderService::services() {
  const char* const answer = R"({"type":"object"})";
  return {
      {.id = kOrderId,
       .name = "adit/order",
       .request_schema =
           R"({"type":"object","properties":{"token":{"type":"string"},"order":{"enum":["pause","resume","return_home","stop"]}}})",
       .response_schema = answer},
      {.id = kProcessId,
       .name = "adit/process",
       .request_schema =
           R"({"type":"object","properties":{"token":{"type":"string"},"process":{"type":"string"},"action":{"enum":["start","stop","restart"]}}})",
       .response_schema = answer}};
}

Result<std::string> OrderService::call(const foxglove_protocol::ServiceCall& call) {
  if (call.payload.size() > kRequestBytesMax) return Rejected{"the request is too large"};
  const json request = json::parse(call.payload, nullptr, false);
  if (!request.is_object()) return Rejected{"the request is not a JSON object"};
  if (!secrets_are_equal(text_in(request, "token"), token_)) return Rejected{"wrong token"};
  if (call.service == kOrderId) return order(text_in(request, "order"));
  if (call.service == kProcessId)
    return control(text_in(request, "action"), text_in(request, "process"));
  return Rejected{"unknown service"};
}

Result<std::string> OrderService::order(const std::string& name) {
  const auto kind = kOrders.find(name);
  if (kind == kOrders.end()) return Rejected{"an order is pause, resume, return_home or stop"};
  pending_ = {kind->second, 0};
  repeat();
  return std::string(R"({"sent":true})");
}

/// Until PHASE confirms it, as a message may be lost.
void OrderService::repeat() {
  if (!pending_) return;
  const bool executed = pending_->repetitions > 0 && phase_ && is_executed(pending_->kind, *phase_);
  if (executed || pending_->repetitions++ >= kRepetitionsMax) return pending_.reset();
  publish(bus_, channels::kMissionOrder, to_message(MissionOrder{wall_utime(), pending_->kind}));
}

Result<std::string> OrderService::control(const std::string& action, const std::string& process) {
  if (action != "start" && action != "stop" && action != "restart")
    return Rejected{"an action is start, stop or restart"};
  if (process.empty()) return Rejected{"no process is named"};
  if (!control_process_) return Rejected{"there is no supervisor here"};
  failure_ = control_process_(action, process);
  if (!failure_.empty()) return Rejected{failure_};
  return std::string(R"({"done":true})");
}

}  // namespace adit
