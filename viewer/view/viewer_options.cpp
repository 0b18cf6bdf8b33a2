// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/view/viewer_options.hpp"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>

#include <fmt/format.h>

#include "common/bus/node/stages.hpp"
#include "common/config/config.hpp"
#include "common/files/file_utils.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kPageBytesMax = 16U << 20U;

constexpr const char* kWithoutPage =
    R"(<!doctype html><html lang="en"><meta charset="utf-8"><title>Adit viewer</title>
<p>The page of the viewer is not built (viewer/page/README.md). Foxglove and Lichtblick can connect to this
address: open a connection of kind "Foxglove WebSocket".</p></html>)";

}  // namespace

std::optional<std::string> viewer_page() {
  const auto path = installed_file("viewer", "page.html");
  return path ? std::optional(read_text_file(*path, kPageBytesMax)) : std::nullopt;
}

ViewerServerOptions server_options(const ViewerOptions& options) {
  return {.address = options.parameters.address,
          .port = static_cast<std::uint16_t>(options.parameters.port),
          .listening_socket = options.listening_socket,
          .allowed_origins = options.allowed_origins,
          .page = viewer_page().value_or(kWithoutPage)};
}

ViewerParameters load_viewer_parameters(const fs::path& config) {
  ConfigFile file;
  if (!config.empty()) {
    file = ConfigFile::load(find_installed_file(config, "config"));
    file.require_known_sections(config_sections());
  }
  return load_section<ViewerParameters>(file, kViewerSection);
}

std::string browser_address(const std::string& address, std::uint16_t port) {
  const bool any = address == "0.0.0.0" || address == "::";
  const std::string host = any ? "127.0.0.1" : address;
  return host.find(':') == std::string::npos ? fmt::format("http://{}:{}/", host, port)
                                             : fmt::format("http://[{}]:{}/", host, port);
}

}  // namespace adit
