// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/report/page/mission_html.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>

#include <nlohmann/json.hpp>

#include "common/files/gzip_encoder.hpp"
#include "common/files/little_endian.hpp"
#include "common/text/base64.hpp"
#include "viewer/server/protocol.hpp"

namespace adit {
namespace {

using Json = nlohmann::json;

/// What a server sends first: about itself, and its channels. The number of a channel is that of
/// its topic.
std::string header_text(const std::string& title, const std::vector<Topic>& topics) {
  std::vector<foxglove_protocol::Channel> channels;
  for (const Topic& topic : topics) {
    channels.push_back({static_cast<std::uint32_t>(channels.size()), topic.name, topic.encoding,
                        topic.schema_name, topic.schema_encoding, topic.schema});
  }
  const std::string info = foxglove_protocol::server_info_text(
      {.name = "adit report", .metadata = {{"source", "file"}, {"title", title}}});
  const Json advertised = Json::parse(foxglove_protocol::advertise_text(channels));
  return Json{{"serverInfo", Json::parse(info)}, {"channels", advertised.at("channels")}}.dump();
}

std::string compressed_data(const std::string& header,
                            const std::vector<TopicRecorder::Record>& records) {
  GzipEncoder gzip;
  std::string head;
  append_little_endian(head, static_cast<std::uint32_t>(header.size()));
  gzip.add(head + header);
  for (const auto& [topic, message] : records) {
    head.clear();
    append_little_endian(head, topic);
    append_little_endian(head, static_cast<std::uint64_t>(message.utime) * 1000U);
    append_little_endian(head, static_cast<std::uint32_t>(message.bytes->size()));
    gzip.add(head);
    gzip.add(*message.bytes);
  }
  return gzip.finish();
}

}  // namespace

std::string mission_html(const std::string& page, const std::string& title,
                         const std::vector<Topic>& topics,
                         const std::vector<TopicRecorder::Record>& records) {
  const std::size_t end = page.rfind("</body>");
  if (end == std::string::npos) throw std::invalid_argument("the page has no </body>");
  const std::string data = compressed_data(header_text(title, topics), records);
  const std::span bytes(reinterpret_cast<const std::uint8_t*>(data.data()), data.size());
  return page.substr(0, end) + "<script id=\"mission-data\" type=\"application/octet-stream\">" +
         base64(bytes) + "</script>\n" + page.substr(end);
}

}  // namespace adit
