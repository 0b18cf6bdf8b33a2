// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include <filesystem>
#include <iostream>
#include <memory>

#include <CLI/App.hpp>
#include <fmt/format.h>

#include "common/command_line/command_line.hpp"
#include "common/seal/seal_key.hpp"
#include "tools/adit/adit_app.hpp"

namespace adit {
namespace {

constexpr const char* kKeyDetails =
    R"(Creates the key with which orders are sealed. The robot and the computers of its operators have the same
file; robot.yaml turns it on with the line
  seal: {key: /etc/adit/seal.key}
The file is readable by its owner alone. On the robot, the user of the stages must be able to read it:
  sudo chgrp adit /etc/adit/seal.key; sudo chmod 640 /etc/adit/seal.key)";

constexpr const char* kKeyExamples =
    R"(  sudo adit key --new /etc/adit/seal.key
  adit order return --key seal.key)";

}  // namespace

void add_key_command(CLI::App& adit) {
  CLI::App* command = add_command(adit, "key", "Create a key for sealed orders");
  set_help(*command, {kKeyDetails, "", kKeyExamples});
  const auto path = std::make_shared<std::filesystem::path>();
  command->add_option("--new", *path, "File to create")->type_name("FILE")->required();
  command->callback([path] {
    SealKey::random().write_new(*path);
    std::cout << fmt::format("{}: a new key; copy it to the robot and its operators, by hand\n",
                             path->string());
  });
}

void add_key_option(CLI::App& command, std::string& key) {
  command.add_option("--key", key, "Key of a robot with sealed orders, from adit key")
      ->type_name("FILE")
      ->envname("ADIT_SEAL_KEY");
}

}  // namespace adit
