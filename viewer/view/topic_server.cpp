// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/view/topic_server.hpp"

#include <utility>
#include <vector>

#include "common/service/wall_time.hpp"

namespace adit {
namespace {

constexpr std::int64_t kTimePeriodUs = 100'000;
}  // namespace

TopicServer::TopicServer(const ViewerServerOptions& options,
                         const foxglove_protocol::ServerInfo& info, TopicBoard& board,
                         const std::vector<foxglove_protocol::Service>& services,
                         ViewerServer::Handlers handlers)
    : board_(&board),
      server_(options, info, board.topics(), services, with_board(std::move(handlers))) {}

ViewerServer::Handlers TopicServer::with_board(ViewerServer::Handlers handlers) {
  handlers.on_subscribe = [this](TopicId topic) { return board_->current(topic); };
  return handlers;
}

void TopicServer::poll(std::int64_t utime) {
  server_.poll();
  if (server_.clients() == 0) return;
  const std::int64_t now_us = steady_us();
  const auto wanted = [this](TopicId topic) { return server_.has_subscriber(topic); };
  for (const TopicBoard::Update& update : board_->take_due(now_us, wanted))
    server_.publish(update.topic, update.message);
  if (now_us < time_wall_us_ + kTimePeriodUs || utime == 0) return;
  time_wall_us_ = now_us;
  server_.publish_time(1000 * utime);
}

void TopicServer::show(TopicBoard& board) {
  board_ = &board;
  for (TopicId topic = 0; topic < board.topics().size(); ++topic) {
    if (!server_.has_subscriber(topic)) continue;
    for (const TopicMessage& message : board.current(topic)) server_.publish(topic, message);
  }
}

}  // namespace adit
