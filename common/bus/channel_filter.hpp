// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <set>
#include <string>
#include <vector>

#include <linux/filter.h>

namespace adit {

using Channels = std::set<std::string, std::less<>>;

/// What passes a socket of LCM's udpm, as a program for the kernel: messages on the channels, those
/// that come in fragments, and what is no message of LCM. By the layout of LCM's datagrams, which
/// is a magic number, a sequence number, and the channel with a NUL.
///
/// Of what would pass, that share is lost at random; but not of the time of a simulator, by which
/// everybody would have to wait for the next, as on no robot.
std::vector<sock_filter> channel_filter(const Channels& channels, double loss_share = 0.0);

/// Multicast goes to every process, and each would wake up for it, also to throw it away. With this
/// the kernel drops for these sockets what is on other channels. Where it refuses, all goes on
/// without. The order of messages is as it was. False where it refuses for any of them.
bool attach_channel_filter(const Channels& channels, const std::set<int>& sockets,
                           double loss_share = 0.0);

/// Bound datagram sockets of this process, by their descriptors. LCM keeps its own to itself.
std::set<int> bound_datagram_sockets();
std::set<int> bound_datagram_sockets_except(const std::set<int>& existing);

}  // namespace adit
