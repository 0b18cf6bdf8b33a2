// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "common/bus/map_subscription.hpp"

#include <cstddef>
#include <utility>

#include "common/bus/channels.hpp"
#include "common/bus/typed_messages.hpp"
#include "common/messages/mapping/association.hpp"

namespace adit {
namespace {

constexpr std::size_t kQueued = 1000;

}  // namespace

void MapSubscription::subscribe(Bus& bus, Handlers handlers) {
  handlers_ = std::move(handlers);
  const Delivery all = Delivery::queued(kQueued);
  adit::subscribe<local_map_t>(bus, channels::kLocalMap, all,
                               [this](const LocalMapFragment& fragment) {
                                 if (auto map = local_map_fragments_.add(fragment))
                                   handlers_.on_local_map(std::move(*map));
                               });
  adit::subscribe<pose_graph_t>(bus, channels::kPoseGraph, all,
                                [this](const PoseGraphFragment& fragment) {
                                  if (auto graph = graph_fragments_.add(fragment))
                                    handlers_.on_graph(std::move(*graph));
                                });
  adit::subscribe<association_t>(
      bus, channels::kAssociation, all,
      [this](const Association& association) { handlers_.on_association(association); });
  adit::subscribe<map_contradictions_t>(bus, channels::kContradictions, all,
                                        [this](MapContradictions contradictions) {
                                          handlers_.on_contradictions(std::move(contradictions));
                                        });
}

}  // namespace adit
