// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "viewer/view/viewer_options.hpp"

#include <fmt/format.h>

#include "common/bus/node/stages.hpp"
#include "common/config/config.hpp"
#include "common/files/file_utils.hpp"

namespace adit {
namespace {

namespace fs = std::filesystem;

constexpr const char* kWithoutPage =
    R"(<!doctype html><html lang="en"><meta charset="utf-8"><title>Adit viewer</title>
<p>The page of the viewer is not built (viewer/page/README.md). Foxglove and Lichtblick can connect to this
address: open a connection of kind "Foxglove WebSocket".</p></html>)";

}  // namespace

ViewerServerOptions server_options(const ViewerOptions& options) {
  const fs::path page = find_installed_file("page.html", "viewer");
  return {.address = options.parameters.address,
          .port = static_cast<std::uint16_t>(options.parameters.port),
          .listening_socket = options.listening_socket,
          .allowed_origins = options.allowed_origins,
          .page = fs::exists(page) ? read_text_file(page) : kWithoutPage};
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
