// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <filesystem>
#include <optional>

#include <sys/types.h>

namespace adit {

/// Moves this process and its children to a private network that has only a loopback with
/// multicast, which isolates LCM. False, without a change, if the system does not permit it. Must
/// be called before threads are started. Throws std::system_error if the new network cannot be
/// configured.
bool enter_private_network();

/// Joins the network of another process of the same user. Throws std::runtime_error.
void enter_network_of(pid_t pid);

/// A process on the network of the mission that runs in a folder; nothing if none runs there.
std::optional<pid_t> process_of_mission(const std::filesystem::path& folder);

/// Joins the network of the mission that runs in a folder, where LCM has its default URL. Throws
/// std::runtime_error if none runs there.
void enter_network_of_mission(const std::filesystem::path& folder);

}  // namespace adit
