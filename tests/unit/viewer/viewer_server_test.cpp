// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/server/viewer_server.hpp"

#include <atomic>
#include <chrono>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <boost/asio/connect.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <boost/beast/websocket.hpp>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace adit {
namespace {

namespace beast = boost::beast;
namespace http = beast::http;
namespace websocket = beast::websocket;
using boost::asio::ip::tcp;
using nlohmann::json;

/// A server with the topics /pose (latest) and /events (appended), served by a thread of its own.
class RunningServer {
 public:
  RunningServer() : thread_([this] { run(); }) {
    while (port_ == 0) std::this_thread::yield();
  }
  ~RunningServer() {
    stop_ = true;
    thread_.join();
  }

  [[nodiscard]] std::uint16_t port() const { return port_; }
  /// Publishes on /pose from now on, as fast as possible.
  void flood(std::size_t bytes) { flood_bytes_ = bytes; }
  [[nodiscard]] std::size_t clients() const { return clients_; }
  [[nodiscard]] std::size_t published() const { return published_; }

 private:
  void run() {
    ViewerServer server(
        {.port = 0, .page = "<p>page</p>"},
        {.name = "adit", .capabilities = {"time"}, .session = "1"},
        {{.name = "/pose", .encoding = "json"},
         {.name = "/events", .encoding = "json", .retention = Retention::kAppended}},
        {}, {.on_subscribe = [](TopicId topic) { return greeting(topic); }});
    port_ = server.port();
    while (!stop_) {
      server.poll();
      clients_ = server.clients();
      if (const std::size_t bytes = flood_bytes_) {
        server.publish(0, {1, std::make_shared<const std::string>(bytes, 'x')});
        ++published_;
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

  static std::vector<TopicMessage> greeting(TopicId topic) {
    std::vector<TopicMessage> messages;
    for (int i = 0; topic == 1 && i < 3; ++i) {
      messages.push_back({i, std::make_shared<const std::string>(std::to_string(i))});
    }
    return messages;
  }

  std::atomic<bool> stop_ = false;
  std::atomic<std::uint16_t> port_ = 0;
  std::atomic<std::size_t> flood_bytes_ = 0;
  std::atomic<std::size_t> clients_ = 0;
  std::atomic<std::size_t> published_ = 0;
  std::thread thread_;
};

class WebSocketClient {
 public:
  explicit WebSocketClient(std::uint16_t port, const std::string& origin = {}) : socket_(context_) {
    socket_.next_layer().connect({boost::asio::ip::address_v4::loopback(), port});
    socket_.set_option(
        websocket::stream_base::decorator([origin](websocket::request_type& request) {
          request.set(http::field::sec_websocket_protocol, "other, foxglove.websocket.v1");
          if (!origin.empty()) request.set(http::field::origin, origin);
        }));
    websocket::response_type response;
    socket_.handshake(response, "127.0.0.1:" + std::to_string(port), "/");
    subprotocol_ = std::string(response[http::field::sec_websocket_protocol]);
  }

  [[nodiscard]] const std::string& subprotocol() const { return subprotocol_; }
  void send(const std::string& text) { socket_.write(boost::asio::buffer(text)); }
  std::string read() {
    beast::flat_buffer buffer;
    socket_.read(buffer);
    return beast::buffers_to_string(buffer.data());
  }

 private:
  boost::asio::io_context context_;
  websocket::stream<tcp::socket> socket_;
  std::string subprotocol_;
};

/// The answer to a request, as text.
std::string answer_to(std::uint16_t port, const std::string& request) {
  boost::asio::io_context context;
  tcp::socket socket(context);
  socket.connect({boost::asio::ip::address_v4::loopback(), port});
  boost::asio::write(socket, boost::asio::buffer(request));
  std::string answer;
  boost::system::error_code end;
  boost::asio::read(socket, boost::asio::dynamic_buffer(answer), end);
  return answer;
}

TEST(ViewerServer, GreetsAdvertisesAndSendsWhatIsKept) {
  const RunningServer server;
  WebSocketClient client(server.port());
  EXPECT_EQ(client.subprotocol(), "foxglove.websocket.v1");
  EXPECT_EQ(json::parse(client.read())["op"], "serverInfo");
  const json advertise = json::parse(client.read());
  ASSERT_EQ(advertise["channels"].size(), 2U);
  EXPECT_EQ(advertise["channels"][1]["topic"], "/events");

  client.send(R"({"op":"subscribe","subscriptions":[{"id":7,"channelId":1}]})");
  for (const char* payload : {"0", "1", "2"}) EXPECT_EQ(client.read().substr(13), payload);
}

TEST(ViewerServer, WarnsOfMalformedRequestsAndContinues) {
  const RunningServer server;
  WebSocketClient client(server.port());
  client.read();
  client.read();
  for (const char* text : {"{", R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":99}]})",
                           R"({"op":"advertise","channels":[]})"}) {
    client.send(text);
    EXPECT_EQ(json::parse(client.read())["op"], "status") << text;
  }
}

TEST(ViewerServer, IsNotDelayedByAClientThatDoesNotRead) {
  RunningServer server;
  WebSocketClient stopped(server.port());
  stopped.send(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":0}]})");
  WebSocketClient reading(server.port());
  reading.send(R"({"op":"subscribe","subscriptions":[{"id":1,"channelId":0}]})");
  reading.read();
  reading.read();
  constexpr std::size_t kBytes = 200'000;
  server.flood(kBytes);
  for (int i = 0; i < 50; ++i) EXPECT_EQ(reading.read().size(), 13 + kBytes);
  EXPECT_EQ(server.clients(), 2U);
}

TEST(ViewerServer, RejectsPagesOfOtherSites) {
  const RunningServer server;
  EXPECT_THROW(WebSocketClient(server.port(), "https://example.org"), boost::system::system_error);
  EXPECT_NO_THROW(
      WebSocketClient(server.port(), "http://127.0.0.1:" + std::to_string(server.port())));
}

TEST(ViewerServer, ServesThePageAndNothingElse) {
  const RunningServer server;
  const std::string host = "Host: localhost\r\n\r\n";
  EXPECT_NE(answer_to(server.port(), "GET / HTTP/1.1\r\n" + host).find("<p>page</p>"),
            std::string::npos);
  EXPECT_TRUE(answer_to(server.port(), "GET /../../etc/passwd HTTP/1.1\r\n" + host)
                  .starts_with("HTTP/1.1 404"));
  EXPECT_TRUE(answer_to(server.port(), "POST / HTTP/1.1\r\n" + host).starts_with("HTTP/1.1 405"));
  EXPECT_TRUE(answer_to(server.port(), "GET / HTTP/1.1\r\nHost: example.org\r\n\r\n")
                  .starts_with("HTTP/1.1 421"));
}

TEST(ViewerServer, ClosesConnectionsWithHeadersThatAreTooLong) {
  const RunningServer server;
  const std::string request = "GET / HTTP/1.1\r\nX: " + std::string(20'000, 'a');
  EXPECT_EQ(answer_to(server.port(), request), "");
}

TEST(ViewerServer, StatesWhyAPortCannotBeUsed) {
  const RunningServer server;
  try {
    listen_on("127.0.0.1", server.port());
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("cannot listen on 127.0.0.1"), std::string::npos);
  }
}

}  // namespace
}  // namespace adit
