// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <string>

#include "viewer/server/topic_board.hpp"

namespace google::protobuf {
class Descriptor;
}

namespace adit {

/// A topic of Protocol Buffers messages. Its schema is a FileDescriptorSet with all imports, as
/// Foxglove expects. `period_us` as in Topic.
Topic protobuf_topic(const std::string& name, const google::protobuf::Descriptor& type,
                     std::int64_t period_us = 0);

/// A topic of JSON messages, whose schema only says that they are objects.
Topic json_topic(const std::string& name, const std::string& schema_name,
                 std::int64_t period_us = 0);

}  // namespace adit
