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

constexpr const char* kOrderFooter =
    R"(Orders:
  pause      stand, until told to go on
  resume      after a pause, or where the mission waits for the order to begin
  return  turn around, for good
  stop       stand, and end the mission where the robot is: nobody will bring it home

The order is said again until the mission obeys; exit code 2 where none answers. In the mine there is no
radio: orders are for the surface, and for a simulated mine.

Examples:
  adit order return                          the mission on this network
  adit order pause --mission out                that of adit mission mathies --out out)";

}  // namespace

void add_order_command(CLI::App& adit) {
  CLI::App* command =
      adit.add_subcommand("order", "Tell a mission to pause, go on, come home, stop");
  command->footer(kOrderFooter);
  const auto options = std::make_shared<MissionOrderOptions>();
  command->add_option("ORDER", options->order, "pause, resume, return or stop")
      ->transform(CLI::CheckedTransformer(kOrders).description(""))
      ->required();
  command
      ->add_option("--mission", options->mission, "Folder of a mission with a network of its own")
      ->type_name("DIR");
  command->add_option("--timeout-s", options->timeout_s, "How long to wait until it obeys")
      ->type_name("SECONDS")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  command->add_option("--lcm-url", options->lcm_url, "Where LCM is, if not at its default")
      ->type_name("URL");
  command->callback([options] { std::cout << order_mission(*options) << "\n"; });
}

}  // namespace adit
