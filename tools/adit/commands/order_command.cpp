// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <iostream>
#include <map>
#include <memory>
#include <string>

#include <CLI/CLI.hpp>

#include "tools/adit/adit_app.hpp"
#include "tools/mission/mission_order_run.hpp"

namespace adit {
namespace {

const std::map<std::string, MissionOrder::Kind> kOrders{{"pause", MissionOrder::Kind::kPause},
                                                        {"resume", MissionOrder::Kind::kResume},
                                                        {"return", MissionOrder::Kind::kReturnHome},
                                                        {"stop", MissionOrder::Kind::kStop}};

constexpr const char* kOrderDetails =
    R"(Orders:
  pause   stop the vehicle until the order resume
  resume  continue after a pause, or start a mission that waits for this order
  return  return to the start; this cannot be undone
  stop    stop the vehicle and end the mission in place; the robot does not return

The order is repeated until the mission executes it; the new phase is printed. Orders require a network
connection to the robot: use them at the surface and in simulation.)";

constexpr const char* kOrderExamples =
    R"(  adit order return                          the mission on this network
  adit order pause --mission out             the mission of `adit mission mathies --out out`)";

}  // namespace

void add_order_command(CLI::App& adit) {
  CLI::App* command =
      adit.add_subcommand("order", "Order a mission to pause, resume, return or stop");
  set_help(*command, {kOrderDetails, "", kOrderExamples});
  const auto options = std::make_shared<MissionOrderOptions>();
  command->add_option("ORDER", options->order, "pause, resume, return or stop")
      ->transform(CLI::CheckedTransformer(kOrders).description(""))
      ->required();
  command->add_option("--mission", options->mission, "Output folder of a running adit mission")
      ->type_name("DIR");
  command
      ->add_option("--timeout-s", options->timeout_s,
                   "Maximum time until the mission executes the order")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--lcm-url", options->lcm_url, "LCM network, instead of the default")
      ->type_name("URL");
  command->callback([options] { std::cout << order_mission(*options) << "\n"; });
}

}  // namespace adit
