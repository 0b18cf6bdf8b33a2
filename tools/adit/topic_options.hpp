// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <CLI/App.hpp>

#include "tools/ros/import/topic_choice.hpp"

namespace adit {

/// The options that choose the topics of a bag. `topics` must outlive the command line.
void add_topic_options(CLI::App& command, TopicChoice& topics);

}  // namespace adit
