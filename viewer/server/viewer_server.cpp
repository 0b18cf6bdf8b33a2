// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/server/viewer_server.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <list>
#include <map>
#include <set>
#include <span>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <variant>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <fmt/format.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "viewer/server/client_outbox.hpp"
#include "viewer/server/request_origin.hpp"

namespace adit {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::system::error_code;
using Tcp = asio::ip::tcp;

constexpr auto kRequestTimeout = std::chrono::seconds(10);
constexpr std::size_t kRequestBytesMax = 8 * 1024;
constexpr std::size_t kMessageBytesMax = 64 * 1024;

/// A subprotocol of this server that a client offers; empty if none.
std::string_view common_subprotocol(std::string_view offered) {
  for (const std::string_view own : foxglove_protocol::kSubprotocols) {
    for (const auto& token : http::token_list(beast::string_view(offered.data(), offered.size()))) {
      if (std::string_view(token.data(), token.size()) == own) return own;
    }
  }
  return {};
}

std::string_view view(beast::string_view text) { return {text.data(), text.size()}; }

}  // namespace

int listen_on(const std::string& address, std::uint16_t port) {
  asio::io_context context;
  Tcp::acceptor acceptor(context);
  try {
    const Tcp::endpoint endpoint(asio::ip::make_address(address), port);
    acceptor.open(endpoint.protocol());
    acceptor.set_option(asio::socket_base::reuse_address(true));
    acceptor.bind(endpoint);
    acceptor.listen();
  } catch (const boost::system::system_error& error) {
    throw std::runtime_error(
        fmt::format("cannot listen on {}:{}: {}", address, port, error.code().message()));
  }
  return acceptor.release();
}

std::uint16_t port_of(int listening_socket) {
  sockaddr_storage address{};
  socklen_t size = sizeof address;
  if (getsockname(listening_socket, reinterpret_cast<sockaddr*>(&address), &size) != 0)
    throw std::runtime_error("a socket without an address");
  const auto* const any = reinterpret_cast<const sockaddr*>(&address);
  return any->sa_family == AF_INET6
             ? ntohs(reinterpret_cast<const sockaddr_in6*>(&address)->sin6_port)
             : ntohs(reinterpret_cast<const sockaddr_in*>(&address)->sin_port);
}

class ViewerServer::Implementation {
 public:
  Implementation(const ViewerServerOptions& options, const foxglove_protocol::ServerInfo& info,
                 std::vector<Topic> topics, const std::vector<foxglove_protocol::Service>& services,
                 Handlers handlers);

  void poll() {
    context_.restart();
    context_.poll();
  }
  void publish(TopicId topic, const TopicMessage& message);
  void publish_time(std::int64_t time_ns);
  void publish_playback_state(const std::string& bytes);
  [[nodiscard]] bool has_subscriber(TopicId topic) const { return subscribers_.at(topic) > 0; }
  [[nodiscard]] std::size_t clients() const { return clients_.size(); }
  [[nodiscard]] std::uint16_t port() const { return acceptor_.local_endpoint().port(); }

 private:
  class Request;
  class Client;

  void accept();

  std::vector<std::string> allowed_origins_;
  std::string page_;
  std::string greeting_;  ///< server info
  std::string advertisement_;
  std::string services_;  ///< empty without services
  std::vector<Topic> topics_;
  Handlers handlers_;
  std::vector<std::size_t> subscribers_;  ///< number by topic
  std::set<Client*> clients_;
  std::size_t connections_ = 0;
  // Last, so that it ends first: pending operations own the connections, which refer to the above.
  asio::io_context context_{1};
  Tcp::acceptor acceptor_{context_};
};

/// A client after the handshake. Lives as long as an operation on its socket is pending.
class ViewerServer::Implementation::Client : public std::enable_shared_from_this<Client> {
 public:
  Client(Implementation& server, beast::tcp_stream&& stream)
      : server_(server), socket_(std::move(stream)) {}
  ~Client();
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;

  void accept(const http::request<http::empty_body>& request, std::string_view subprotocol);

  void send(TopicId topic, const TopicMessage& message);
  void send_time(std::int64_t time_ns);
  /// Nothing to a client of a subprotocol without playback.
  void send_playback_state(const std::string& bytes);

 private:
  void read();
  void write();
  void close() { beast::get_lowest_layer(socket_).close(); }
  void handle_message();
  void handle(const foxglove_protocol::Subscribe& request);
  void handle(const foxglove_protocol::Unsubscribe& request);
  void handle(const foxglove_protocol::ServiceCall& request);
  void handle(const foxglove_protocol::PlaybackControl& request);
  void handle(const foxglove_protocol::Unsupported& request);
  void warn(std::string_view message);

  Implementation& server_;
  websocket::stream<beast::tcp_stream> socket_;
  beast::flat_static_buffer<kMessageBytesMax> incoming_;
  ClientOutbox outbox_;
  std::optional<ClientOutbox::Frame> sending_;
  std::map<std::uint32_t, TopicId> topics_;         ///< by subscription
  std::map<TopicId, std::uint32_t> subscriptions_;  ///< by topic
  bool open_ = false;
  bool knows_playback_ = false;
};

ViewerServer::Implementation::Client::~Client() {
  for (const auto& [topic, subscription] : subscriptions_) --server_.subscribers_[topic];
  server_.clients_.erase(this);
  --server_.connections_;
}

void ViewerServer::Implementation::Client::accept(const http::request<http::empty_body>& request,
                                                  std::string_view subprotocol) {
  knows_playback_ = subprotocol == foxglove_protocol::kSubprotocols[0];
  beast::get_lowest_layer(socket_).expires_never();
  socket_.set_option(websocket::stream_base::timeout{
      .handshake_timeout = kRequestTimeout,
      .idle_timeout = std::chrono::seconds(30),
      .keep_alive_pings = true,
  });
  socket_.set_option(websocket::stream_base::decorator(
      [name = std::string(subprotocol)](websocket::response_type& response) {
        response.set(http::field::sec_websocket_protocol, name);
      }));
  socket_.read_message_max(kMessageBytesMax);
  socket_.async_accept(request, [self = shared_from_this()](error_code error) {
    if (error) return;
    self->open_ = true;
    self->server_.clients_.insert(self.get());
    self->outbox_.push_text(self->server_.greeting_);
    self->outbox_.push_text(self->server_.advertisement_);
    if (!self->server_.services_.empty()) self->outbox_.push_text(self->server_.services_);
    self->write();
    self->read();
  });
}

void ViewerServer::Implementation::Client::read() {
  socket_.async_read(incoming_, [self = shared_from_this()](error_code error, std::size_t) {
    if (error) return self->close();
    self->handle_message();
    self->incoming_.consume(self->incoming_.size());
    self->read();
  });
}

void ViewerServer::Implementation::Client::write() {
  if (sending_ || !open_) return;
  if (outbox_.overflows()) return close();
  sending_ = outbox_.pop();
  if (!sending_) return;
  std::array<asio::const_buffer, 2> buffers{asio::buffer(sending_->head), {}};
  if (sending_->payload) buffers[1] = asio::buffer(*sending_->payload);
  socket_.text(sending_->is_text);
  socket_.async_write(buffers, [self = shared_from_this()](error_code error, std::size_t) {
    self->sending_.reset();
    if (error) return self->close();
    self->write();
  });
}

void ViewerServer::Implementation::Client::send(TopicId topic, const TopicMessage& message) {
  const auto subscription = subscriptions_.find(topic);
  if (subscription == subscriptions_.end()) return;
  outbox_.push(subscription->second, server_.topics_[topic].retention, message);
  write();
}

void ViewerServer::Implementation::Client::send_time(std::int64_t time_ns) {
  outbox_.push_time(time_ns);
  write();
}

void ViewerServer::Implementation::Client::send_playback_state(const std::string& bytes) {
  if (!knows_playback_) return;
  outbox_.push_binary(bytes);
  write();
}

void ViewerServer::Implementation::Client::handle_message() {
  const auto data = incoming_.cdata();
  const std::span bytes(static_cast<const std::uint8_t*>(data.data()), data.size());
  const Result<foxglove_protocol::Request> request =
      socket_.got_text() ? foxglove_protocol::parse_text(
                               {reinterpret_cast<const char*>(bytes.data()), bytes.size()})
                         : foxglove_protocol::parse_binary(bytes);
  if (!request) return warn(request.rejection());
  std::visit([this](const auto& value) { handle(value); }, *request);
}

void ViewerServer::Implementation::Client::warn(std::string_view message) {
  outbox_.push_text(
      foxglove_protocol::status_text(foxglove_protocol::StatusLevel::kWarning, message));
  write();
}

void ViewerServer::Implementation::Client::handle(const foxglove_protocol::Subscribe& request) {
  for (const auto& entry : request.entries) {
    if (entry.channel >= server_.topics_.size()) {
      warn(fmt::format("no channel {}", entry.channel));
    } else if (topics_.contains(entry.subscription) || subscriptions_.contains(entry.channel)) {
      warn(fmt::format("channel {} or subscription {} is in use", entry.channel,
                       entry.subscription));
    } else {
      topics_[entry.subscription] = entry.channel;
      subscriptions_[entry.channel] = entry.subscription;
      ++server_.subscribers_[entry.channel];
      for (const TopicMessage& message : server_.handlers_.on_subscribe(entry.channel)) {
        outbox_.push(entry.subscription, server_.topics_[entry.channel].retention, message);
      }
    }
  }
  write();
}

void ViewerServer::Implementation::Client::handle(const foxglove_protocol::Unsubscribe& request) {
  for (const std::uint32_t id : request.subscriptions) {
    const auto topic = topics_.find(id);
    if (topic == topics_.end()) {
      warn(fmt::format("no subscription {}", id));
      continue;
    }
    --server_.subscribers_[topic->second];
    subscriptions_.erase(topic->second);
    topics_.erase(topic);
    outbox_.drop(id);
  }
}

void ViewerServer::Implementation::Client::handle(const foxglove_protocol::ServiceCall& request) {
  const Result<std::string> answer = server_.handlers_.on_service_call
                                         ? server_.handlers_.on_service_call(request)
                                         : Rejected{"this viewer is read-only"};
  if (answer) {
    outbox_.push_binary(foxglove_protocol::service_response(request, *answer));
  } else {
    outbox_.push_text(foxglove_protocol::service_failure_text(request, answer.rejection()));
  }
  write();
}

void ViewerServer::Implementation::Client::handle(
    const foxglove_protocol::PlaybackControl& request) {
  if (!server_.handlers_.on_playback) return warn("playback cannot be controlled");
  foxglove_protocol::PlaybackState state = server_.handlers_.on_playback(request);
  state.request_id = request.request_id;
  send_playback_state(foxglove_protocol::playback_state_message(state));
}

void ViewerServer::Implementation::Client::handle(const foxglove_protocol::Unsupported& request) {
  constexpr std::size_t kLengthMax = 40;
  warn(fmt::format("not supported: {}", request.operation.substr(0, kLengthMax)));
}

/// A connection until it is answered or becomes a Client.
class ViewerServer::Implementation::Request : public std::enable_shared_from_this<Request> {
 public:
  Request(Implementation& server, Tcp::socket&& socket)
      : server_(server), stream_(std::move(socket)) {
    ++server_.connections_;
  }
  ~Request() {
    if (!handed_over_) --server_.connections_;
  }
  Request(const Request&) = delete;
  Request& operator=(const Request&) = delete;

  void read() {
    stream_.expires_after(kRequestTimeout);
    parser_.header_limit(kRequestBytesMax);
    parser_.body_limit(0);
    http::async_read(stream_, buffer_, parser_,
                     [self = shared_from_this()](error_code error, std::size_t) {
                       if (!error) self->answer();
                     });
  }

 private:
  void answer();
  void open_websocket();
  void respond(http::status status, std::string text, std::string_view type = "text/plain");

  Implementation& server_;
  beast::tcp_stream stream_;
  beast::flat_static_buffer<kRequestBytesMax> buffer_;
  http::request_parser<http::empty_body> parser_;
  http::response<http::string_body> response_;
  bool handed_over_ = false;
};

void ViewerServer::Implementation::Request::answer() {
  const auto& request = parser_.get();
  if (!is_own_host(view(request[http::field::host]))) {
    return respond(http::status::misdirected_request,
                   "Open the viewer by localhost, an IP address or the name of its computer.\n");
  }
  if (websocket::is_upgrade(request)) return open_websocket();
  if (request.method() != http::verb::get && request.method() != http::verb::head) {
    return respond(http::status::method_not_allowed, "Only GET is supported.\n");
  }
  const std::string_view target = view(request.target());
  if (target.substr(0, target.find('?')) != "/") {
    return respond(http::status::not_found, "There is only the page /.\n");
  }
  respond(http::status::ok, server_.page_, "text/html; charset=utf-8");
}

void ViewerServer::Implementation::Request::open_websocket() {
  const auto& request = parser_.get();
  if (!is_allowed_origin(view(request[http::field::origin]), view(request[http::field::host]),
                         server_.allowed_origins_)) {
    return respond(http::status::forbidden,
                   "Pages of this origin may not connect; see allowed_origins.\n");
  }
  const std::string_view subprotocol =
      common_subprotocol(view(request[http::field::sec_websocket_protocol]));
  if (subprotocol.empty()) {
    return respond(http::status::bad_request,
                   "A WebSocket of this server has the subprotocol foxglove.websocket.v1.\n");
  }
  handed_over_ = true;
  std::make_shared<Client>(server_, std::move(stream_))->accept(request, subprotocol);
}

void ViewerServer::Implementation::Request::respond(http::status status, std::string text,
                                                    std::string_view type) {
  const bool has_body = parser_.get().method() != http::verb::head;
  response_.version(11);
  response_.result(status);
  response_.set(http::field::content_type, beast::string_view(type.data(), type.size()));
  response_.set(http::field::cache_control, "no-store");
  response_.set("X-Content-Type-Options", "nosniff");
  response_.set(
      "Content-Security-Policy",
      "default-src 'none'; script-src 'unsafe-inline' 'unsafe-eval'; style-src 'unsafe-inline'; "
      "img-src data: blob:; worker-src blob:; connect-src ws: wss:; "
      "frame-ancestors 'none'; base-uri 'none'; form-action 'none'");
  response_.keep_alive(false);
  response_.content_length(text.size());
  if (has_body) response_.body() = std::move(text);
  stream_.expires_after(kRequestTimeout);
  http::async_write(stream_, response_, [self = shared_from_this()](error_code, std::size_t) {
    error_code ignored;
    self->stream_.socket().shutdown(Tcp::socket::shutdown_send, ignored);
  });
}

ViewerServer::Implementation::Implementation(
    const ViewerServerOptions& options, const foxglove_protocol::ServerInfo& info,
    std::vector<Topic> topics, const std::vector<foxglove_protocol::Service>& services,
    Handlers handlers)
    : allowed_origins_(options.allowed_origins),
      page_(options.page),
      greeting_(foxglove_protocol::server_info_text(info)),
      topics_(std::move(topics)),
      handlers_(std::move(handlers)),
      subscribers_(topics_.size(), 0) {
  std::vector<foxglove_protocol::Channel> channels;
  for (const Topic& topic : topics_) {
    channels.push_back({static_cast<TopicId>(channels.size()), topic.name, topic.encoding,
                        topic.schema_name, topic.schema_encoding, topic.schema});
  }
  advertisement_ = foxglove_protocol::advertise_text(channels);
  if (!services.empty()) services_ = foxglove_protocol::advertise_services_text(services);
  const int socket = options.listening_socket ? *options.listening_socket
                                              : listen_on(options.address, options.port);
  const bool is_v6 = options.address.find(':') != std::string::npos;
  acceptor_.assign(is_v6 ? Tcp::v6() : Tcp::v4(), socket);
  accept();
}

void ViewerServer::Implementation::accept() {
  acceptor_.async_accept([this](error_code error, Tcp::socket socket) {
    if (error == asio::error::operation_aborted) return;
    if (!error && connections_ < kConnectionsMax) {
      error_code ignored;
      socket.set_option(Tcp::no_delay(true), ignored);
      std::make_shared<Request>(*this, std::move(socket))->read();
    }
    accept();
  });
}

void ViewerServer::Implementation::publish(TopicId topic, const TopicMessage& message) {
  for (Client* const client : clients_) client->send(topic, message);
}

void ViewerServer::Implementation::publish_time(std::int64_t time_ns) {
  for (Client* const client : clients_) client->send_time(time_ns);
}

void ViewerServer::Implementation::publish_playback_state(const std::string& bytes) {
  for (Client* const client : clients_) client->send_playback_state(bytes);
}

ViewerServer::ViewerServer(const ViewerServerOptions& options,
                           const foxglove_protocol::ServerInfo& info, std::vector<Topic> topics,
                           const std::vector<foxglove_protocol::Service>& services,
                           Handlers handlers)
    : implementation_(std::make_unique<Implementation>(options, info, std::move(topics), services,
                                                       std::move(handlers))) {}

ViewerServer::~ViewerServer() = default;

void ViewerServer::poll() { implementation_->poll(); }
void ViewerServer::publish(TopicId topic, const TopicMessage& message) {
  implementation_->publish(topic, message);
}
void ViewerServer::publish_time(std::int64_t time_ns) { implementation_->publish_time(time_ns); }
void ViewerServer::publish_playback_state(const foxglove_protocol::PlaybackState& state) {
  implementation_->publish_playback_state(foxglove_protocol::playback_state_message(state));
}
bool ViewerServer::has_subscriber(TopicId topic) const {
  return implementation_->has_subscriber(topic);
}
std::size_t ViewerServer::clients() const { return implementation_->clients(); }
std::uint16_t ViewerServer::port() const { return implementation_->port(); }

}  // namespace adit
