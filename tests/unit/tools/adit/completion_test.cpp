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

/// What the shell writes; nothing if it is not there.
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

  /// What bash offers for the last of the words, one per line.
  std::string offered(const std::string& words) const {
    return output_of("bash -c '. " + path_.string() + "; COMP_WORDS=(" + words +
                     "); COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _adit; echo ${COMPREPLY[@]}'");
  }

  test::ScratchFolder folder_;
  std::filesystem::path path_ = folder_ / "adit_completion.bash";
};

TEST(Completion, KnowsEveryCommandOfTheTree) {
  EXPECT_THAT(paths(), IsSupersetOf({"", "import", "import carmen", "eval relations", "optimize",
                                     "sample", "completion zsh"}));
}

TEST(Completion, EveryScriptHoldsEveryWord) {
  const auto commands = list_commands(*make_adit_app());
  for (const auto& script :
       {bash_completion(commands), zsh_completion(commands), fish_completion(commands)}) {
    for (const auto& command : commands) {
      EXPECT_THAT(script, HasSubstr(command.path));
      for (const auto& option : command.options) {
        EXPECT_THAT(script, HasSubstr(option.text.substr(2)));
      }
    }
  }
}

TEST_F(BashCompletion, OffersWhatComesNext) {
  EXPECT_EQ(offered("adit imp"), "import\n");
  EXPECT_EQ(offered("adit import \"\""), "carmen\n");
  EXPECT_EQ(offered("adit completion z"), "zsh\n");
  EXPECT_EQ(offered("adit sample --se"), "--seed\n");
}

TEST_F(BashCompletion, OffersFilesWhereFilesBelong) {
  EXPECT_EQ(offered("adit import carmen " + path_.string()), path_.string() + "\n");
  EXPECT_EQ(offered("adit sample --truth " + path_.string()), path_.string() + "\n");
  EXPECT_EQ(offered("adit completion " + path_.string()), "\n");
}

}  // namespace
}  // namespace adit
