// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/scene/topic_schema.hpp"

#include <set>
#include <span>
#include <string>

#include <google/protobuf/descriptor.h>
#include <google/protobuf/descriptor.pb.h>

#include "common/text/base64.hpp"

namespace adit {
namespace {

namespace protobuf = google::protobuf;

/// Adds a file behind those that it imports.
void add_file(const protobuf::FileDescriptor& file, std::set<std::string>& added,
              protobuf::FileDescriptorSet& set) {
  if (!added.insert(file.name()).second) return;
  for (int i = 0; i < file.dependency_count(); ++i) add_file(*file.dependency(i), added, set);
  file.CopyTo(set.add_file());
}

}  // namespace

Topic protobuf_topic(const std::string& name, const protobuf::Descriptor& type,
                     std::int64_t period_us) {
  protobuf::FileDescriptorSet set;
  std::set<std::string> added;
  add_file(*type.file(), added, set);
  const std::string bytes = set.SerializeAsString();
  return {.name = name,
          .encoding = "protobuf",
          .schema_name = type.full_name(),
          .schema_encoding = "protobuf",
          .schema =
              base64(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size())),
          .period_us = period_us};
}

Topic json_topic(const std::string& name, const std::string& schema_name, std::int64_t period_us) {
  return {.name = name,
          .encoding = "json",
          .schema_name = schema_name,
          .schema_encoding = "jsonschema",
          .schema = R"({"type":"object"})",
          .period_us = period_us};
}

}  // namespace adit
