// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tests/support/bags/ros1_bag_writer.hpp"

#include <bit>
#include <numbers>
#include <stdexcept>

#include <bzlib.h>
#include <lz4frame.h>

namespace adit::test {
namespace {

std::string le(std::uint64_t value, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(value >> (8 * i) & 0xFF);
  return text;
}

std::string field(const std::string& name, const std::string& value) {
  const std::string text = name + "=" + value;
  return le(text.size(), 4) + text;
}

std::string record(const std::string& header, const std::string& data) {
  return le(header.size(), 4) + header + le(data.size(), 4) + data;
}

std::string op(int code) { return field("op", std::string(1, static_cast<char>(code))); }

std::string time(std::int64_t utime) {
  return le(static_cast<std::uint64_t>(utime / 1'000'000), 4) +
         le(static_cast<std::uint64_t>(utime % 1'000'000 * 1000), 4);
}

std::string packed(const std::string& compression, std::string content) {
  if (compression == "bz2") {
    std::string out(content.size() + content.size() / 50 + 1000, '\0');
    auto size = static_cast<unsigned>(out.size());
    if (BZ2_bzBuffToBuffCompress(out.data(), &size, content.data(),
                                 static_cast<unsigned>(content.size()), 9, 0, 0) != BZ_OK) {
      throw std::runtime_error("bzip2");
    }
    out.resize(size);
    return out;
  }
  if (compression == "lz4") {
    std::string out(LZ4F_compressFrameBound(content.size(), nullptr), '\0');
    out.resize(LZ4F_compressFrame(out.data(), out.size(), content.data(), content.size(), nullptr));
    return out;
  }
  return content;
}

}  // namespace

void Ros1BagWriter::write(const std::string& topic, const std::string& type, std::int64_t utime,
                          std::string_view data) {
  const auto [entry, is_new] =
      connections_.try_emplace(topic, static_cast<std::uint32_t>(connections_.size()));
  const std::string conn = field("conn", le(entry->second, 4));
  if (is_new) {
    const std::string connection =
        record(op(7) + field("topic", topic) + conn,
               field("topic", topic) + field("type", type) + field("md5sum", "*"));
    chunk_ += connection;
    connection_records_ += connection;
  }
  chunk_ += record(op(2) + conn + field("time", time(utime)), std::string(data));
  ++counts_[entry->second];
}

void Ros1BagWriter::end_chunk() {
  std::string counts;
  for (const auto& [connection, count] : counts_) counts += le(connection, 4) + le(count, 4);
  chunk_infos_ +=
      record(op(6) + field("ver", le(1, 4)) + field("count", le(counts_.size(), 4)), counts);
  chunks_ +=
      record(op(5) + field("compression", compression_) + field("size", le(chunk_.size(), 4)),
             packed(compression_, chunk_));
  for (const auto& [connection, count] : counts_) {
    chunks_ += record(op(4) + field("ver", le(1, 4)) + field("conn", le(connection, 4)) +
                          field("count", le(count, 4)),
                      std::string(12 * count, '\0'));
  }
  chunk_.clear();
  counts_.clear();
  ++n_chunks_;
}

std::vector<std::uint8_t> Ros1BagWriter::closed() {
  const std::string magic = "#ROSBAG V2.0\n";
  const auto header = [this](std::uint64_t index_pos) {
    return record(op(3) + field("index_pos", le(index_pos, 8)) +
                      field("conn_count", le(connections_.size(), 4)) +
                      field("chunk_count", le(n_chunks_, 4)),
                  std::string(100, ' '));
  };
  const std::string begin = magic + header(magic.size() + header(0).size() + chunks_.size());
  const std::string bag = begin + chunks_ + connection_records_ + chunk_infos_;
  return {bag.begin(), bag.end()};
}

std::vector<std::uint8_t> Ros1BagWriter::active() {
  std::vector<std::uint8_t> bag = closed();
  bag.resize(bag.size() - connection_records_.size() - chunk_infos_.size());
  const std::string index_pos = "index_pos=";
  const auto at = std::string(bag.begin(), bag.end()).find(index_pos) + index_pos.size();
  for (std::size_t i = 0; i < 8; ++i) bag[at + i] = 0;
  return bag;
}

Ros1Bytes& Ros1Bytes::number(std::uint64_t value, int size) {
  bytes_ += le(value, size);
  return *this;
}
Ros1Bytes& Ros1Bytes::f32(float value) { return number(std::bit_cast<std::uint32_t>(value), 4); }
Ros1Bytes& Ros1Bytes::f64(double value) { return number(std::bit_cast<std::uint64_t>(value), 8); }
Ros1Bytes& Ros1Bytes::text(std::string_view value) { return u32(value.size()).raw(value); }
Ros1Bytes& Ros1Bytes::header(std::int64_t utime, std::string_view frame) {
  return u32(0).raw(time(utime)).text(frame);
}
Ros1Bytes& Ros1Bytes::raw(std::string_view value) {
  bytes_ += value;
  return *this;
}

std::string ros1_laser_scan(std::int64_t utime, std::string_view frame,
                            const std::vector<float>& ranges_m) {
  constexpr auto kStep = static_cast<float>(std::numbers::pi / 180.0);
  Ros1Bytes message;
  message.header(utime, frame)
      .f32(-90.0F * kStep)
      .f32(kStep * (static_cast<float>(ranges_m.size()) - 91.0F))
      .f32(kStep)
      .f32(0.0F)
      .f32(0.0F)
      .f32(0.1F)
      .f32(30.0F)
      .u32(ranges_m.size());
  for (const float range : ranges_m) message.f32(range);
  return message.u32(0).bytes();
}

}  // namespace adit::test
