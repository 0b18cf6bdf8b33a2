// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include <linux/filter.h>

namespace adit {

using Channels = std::set<std::string, std::less<>>;

/// A classic BPF program for a socket of LCM's udpm transport that passes messages on the channels,
/// fragmented messages, and datagrams that are not LCM's. An LCM datagram begins with a magic
/// number, a sequence number, and the channel with its NUL.
std::vector<sock_filter> channel_filter(const Channels& channels);

/// Makes the kernel drop messages on other channels for these sockets. Multicast reaches every
/// process, and each would wake up only to discard the message. The order of messages does not
/// change. Returns false if the kernel rejects the filter for any socket, which then receives
/// everything.
bool attach_channel_filter(const Channels& channels, const std::set<int>& sockets);

/// Descriptors of the bound datagram sockets of this process. LCM does not expose its sockets.
std::set<int> bound_datagram_sockets();
std::set<int> bound_datagram_sockets_except(const std::set<int>& existing);

}  // namespace adit
