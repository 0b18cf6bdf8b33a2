// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <optional>
#include <span>

#include "common/bus/log_event.hpp"
#include "common/sensing/laser_mount.hpp"

namespace adit {

/// Where the lasers were by the first configuration on record (channel CONFIG) that says it: a log
/// explains itself. Nothing where none does. Throws ConfigError where it cannot be understood.
std::optional<Lasers> recorded_lasers(std::span<const LogEventView> events);

}  // namespace adit
