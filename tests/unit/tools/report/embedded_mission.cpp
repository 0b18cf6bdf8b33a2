// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/unit/tools/report/embedded_mission.hpp"

#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <stdexcept>
#include <string_view>

#include "common/files/file_utils.hpp"
#include "common/text/base64.hpp"
#include "tests/support/scratch_folder.hpp"

namespace adit::test {
namespace {

std::string unzipped(const std::string& bytes) {
  const ScratchFolder folder;
  std::ofstream(folder / "data.gz", std::ios::binary) << bytes;
  return read_gzip_file(folder / "data.gz");
}

std::uint64_t number_at(const std::string& bytes, std::size_t at, std::size_t size) {
  if (at + size > bytes.size()) throw std::runtime_error("the data end early");
  std::uint64_t value = 0;
  for (std::size_t i = size; i-- > 0;) {
    value = value << 8U | static_cast<std::uint8_t>(bytes[at + i]);
  }
  return value;
}

}  // namespace

std::vector<EmbeddedMission::Message> EmbeddedMission::of(const std::string& topic) const {
  std::vector<Message> found;
  for (const Message& message : messages) {
    if (message.topic == topic) found.push_back(message);
  }
  return found;
}

EmbeddedMission embedded_mission(const std::string& html) {
  const std::size_t element = html.find("<script id=\"mission-data\"");
  if (element == std::string::npos) throw std::runtime_error("no mission-data");
  const std::size_t begin = html.find('>', element) + 1;
  const auto zipped =
      bytes_of_base64(std::string_view(html).substr(begin, html.find("</script>", begin) - begin));
  if (!zipped) throw std::runtime_error("mission-data is not Base64");
  const std::string bytes = unzipped(*zipped);
  const std::size_t header_size = number_at(bytes, 0, 4);
  EmbeddedMission mission;
  mission.header = nlohmann::json::parse(bytes.substr(4, header_size));
  std::map<std::uint64_t, std::string> topics;
  for (const auto& channel : mission.header.at("channels")) {
    topics[channel.at("id")] = channel.at("topic");
  }
  for (std::size_t at = 4 + header_size; at < bytes.size();) {
    const std::size_t size = number_at(bytes, at + 12, 4);
    if (at + 16 + size > bytes.size()) throw std::runtime_error("the data end early");
    mission.messages.push_back({topics.at(number_at(bytes, at, 4)),
                                1e-9 * static_cast<double>(number_at(bytes, at + 4, 8)),
                                bytes.substr(at + 16, size)});
    at += 16 + size;
  }
  return mission;
}

}  // namespace adit::test
