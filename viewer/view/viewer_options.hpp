// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/config/bounds.hpp"
#include "viewer/scene/scene_parameters.hpp"
#include "viewer/server/viewer_server.hpp"

namespace adit {

/// Section `viewer` of the configuration.
struct ViewerParameters {
  std::string address = "127.0.0.1";  ///< on which clients connect
  int port = 8765;                    ///< 0: any
  SceneParameters scene;

  template <class V>
  void visit(V& v) {
    v("address", address);
    v("port", port, within(0, 65535));
    v("scene", scene);
  }
};

/// How a view is served, beside its content.
struct ViewerOptions {
  ViewerParameters parameters = {};
  /// A socket that listens already, instead of address and port.
  std::optional<int> listening_socket = {};
  std::vector<std::string> allowed_origins = {};  ///< of pages of others, beside our own
  std::string title = {};                         ///< of the mission
};

/// The page of the viewer as it was built, nothing if this build has none. Throws FileError if it
/// is there and cannot be read.
std::optional<std::string> viewer_page();

/// The options of the server, with the page of the viewer. Without a built page, a page that says
/// so takes its place.
ViewerServerOptions server_options(const ViewerOptions& options);

/// The parameters of the section viewer; defaults without a file. Throws ConfigError.
ViewerParameters load_viewer_parameters(const std::filesystem::path& config);

/// The address to open in a browser: "http://127.0.0.1:8765/".
std::string browser_address(const std::string& address, std::uint16_t port);

}  // namespace adit
