// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
#include "tools/adit/completion.hpp"

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>

#include <CLI/CLI.hpp>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/scratch_folder.hpp"
#include "tools/adit/adit_app.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::IsSupersetOf;

std::vector<std::string> paths() {
  std::vector<std::string> result;
  for (const auto& command : list_commands(*make_adit_app())) result.push_back(command.path);
  return result;
}

/// Output of a shell command.
std::string output_of(const std::string& command) {
  std::string text;
  FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return text;
  std::array<char, 256> part{};
  while (std::fgets(part.data(), part.size(), pipe) != nullptr) text += part.data();
  pclose(pipe);
  return text;
}

class BashCompletion : public testing::Test {
 protected:
  BashCompletion() { std::ofstream(path_) << bash_completion(list_commands(*make_adit_app())); }

  /// Completions of bash for the last word.
  std::string completions(const std::string& words) const {
    return output_of("bash -c '. " + path_.string() + "; COMP_WORDS=(" + words +
                     "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _adit; echo ${COMPREPLY[@]}'");
  }

  test::ScratchFolder folder_;
  std::filesystem::path path_ = folder_ / "adit_completion.bash";
};

TEST(Completion, ListsEveryCommand) {
  EXPECT_THAT(paths(), IsSupersetOf({"", "import", "import carmen", "eval relations", "optimize",
                                     "sample", "completion bash"}));
}

TEST(Completion, ScriptContainsEveryCommandAndOption) {
  const auto commands = list_commands(*make_adit_app());
  const std::string script = bash_completion(commands);
  for (const auto& command : commands) {
    EXPECT_THAT(script, HasSubstr(command.path));
    for (const auto& option : command.options) EXPECT_THAT(script, HasSubstr(option.text));
  }
}

TEST_F(BashCompletion, CompletesCommandsAndOptions) {
  EXPECT_EQ(completions("adit imp"), "import\n");
  EXPECT_EQ(completions("adit import \"\""), "bag clouds carmen\n");
  EXPECT_EQ(completions("adit completion b"), "bash\n");
  EXPECT_EQ(completions("adit sample --se"), "--seed\n");
}

TEST_F(BashCompletion, CompletesFilesOfArgumentsAndOptions) {
  EXPECT_EQ(completions("adit import carmen " + path_.string()), path_.string() + "\n");
  EXPECT_EQ(completions("adit sample --truth " + path_.string()), path_.string() + "\n");
  EXPECT_EQ(completions("adit completion " + path_.string()), "\n");
}

}  // namespace
}  // namespace adit
