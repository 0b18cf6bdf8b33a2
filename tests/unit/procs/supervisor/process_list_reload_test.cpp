// SPDX-FileCopyrightText: The Adit authors
// SPDX-License-Identifier: BSD-3-Clause
// The supervisor with real processes, whose list is changed while they run.
#include <chrono>
#include <csignal>
#include <fstream>
#include <map>
#include <string>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "common/service/wall_time.hpp"
#include "procs/supervisor/control/control_client.hpp"
#include "procs/supervisor/supervisor.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/unit/procs/supervisor/processes.hpp"

namespace adit {
namespace {

using testing::HasSubstr;
using testing::Not;

class ProcessListReload : public testing::Test {
 protected:
  ProcessListReload() {
    ReloadSignal::block();
    write_list(R"(cmd "stays" { exec = "sleep 1000"; } cmd "changes" { exec = "sleep 1001"; }
                  cmd "goes" { exec = "sleep 1002"; } cmd "rests" { exec = "sleep 1003"; }
                  cmd "fails" { exec = "false"; } script "wait" { wait ms 100000; })");
    SupervisorParams params;
    params.processes = folder_ / "list.cfg";
    params.deputy_id = "robot";
    params.socket = folder_ / "s.sock";
    params.watcher = ADIT_WATCH;
    supervisor_ = std::make_unique<Supervisor>(params);
    request({"start", "stays", "changes", "goes", "fails"});
    EXPECT_TRUE(
        becomes_true([&] { return pid("stays") > 0 && pid("changes") > 0 && pid("goes") > 0; }));
    EXPECT_TRUE(becomes_true([&] { return supervisor_->any_process_failed(); }));
  }

  void write_list(const std::string& text) { std::ofstream(folder_ / "list.cfg") << text; }

  bool becomes_true(const std::function<bool()>& condition) {
    return test::becomes_true([&] {
      supervisor_->advance(steady_us());
      return condition();
    });
  }

  /// Response to a control request, sent from another thread.
  std::string request(const std::vector<std::string>& fields) {
    std::string response;
    std::atomic<bool> done = false;
    const std::jthread thread([&] {
      try {
        response = request_from_supervisor(folder_ / "s.sock", fields);
      } catch (const std::runtime_error& error) {
        response = error.what();
      }
      done = true;
    });
    EXPECT_TRUE(becomes_true([&] { return done.load(); }));
    return response;
  }

  [[nodiscard]] ProcmanStatus status(const std::string& id) const {
    for (const ProcmanStatus& status : supervisor_->info(1).commands) {
      if (status.command.id == id) return status;
    }
    return {};
  }
  [[nodiscard]] int pid(const std::string& id) const { return status(id).pid; }
  [[nodiscard]] bool is_listed(const std::string& id) const {
    return !status(id).command.id.empty();
  }

  test::ScratchFolder folder_;
  std::unique_ptr<Supervisor> supervisor_;
};

const char* const kAnother = R"(
cmd "new" { exec = "sleep 1004"; } cmd "changes" { exec = "sleep 1005"; stop_signal = 15; }
cmd "stays" { exec = "sleep 1000"; } cmd "rests" { exec = "sleep 1006"; }
cmd "fails" { exec = "sleep 1007"; alive_channel = "SIGN"; start_timeout_s = 60; })";

TEST_F(ProcessListReload, AppliesEachChange) {
  const int stayed = pid("stays");
  const int changed = pid("changes");
  write_list(kAnother);
  EXPECT_EQ(request({"reload"}),
            "changed: changes rests fails\nadded: new\nremoved: goes\nscripts changed\n");
  EXPECT_TRUE(becomes_true([&] { return pid("changes") > 0 && pid("changes") != changed; }));
  EXPECT_EQ(status("changes").command.exec, "sleep 1005");
  EXPECT_TRUE(becomes_true([&] { return !is_listed("goes"); }));
  EXPECT_EQ(pid("stays"), stayed);
  EXPECT_EQ(pid("new"), 0);
  EXPECT_TRUE(is_listed("new"));
  EXPECT_EQ(pid("rests"), 0);
  EXPECT_EQ(status("rests").command.exec, "sleep 1006");
  EXPECT_TRUE(becomes_true([&] { return pid("fails") > 0; }));  // restarted since it has changed
  EXPECT_THAT(supervisor_->liveness_channels(), testing::ElementsAre("SIGN"));
  EXPECT_THAT(request({"ps"}), Not(HasSubstr("goes")));
  EXPECT_THAT(request({"stop", "goes"}), HasSubstr("no process \"goes\""));
}

TEST_F(ProcessListReload, IsTriggeredBySighup) {
  write_list(kAnother);
  raise(SIGHUP);
  EXPECT_TRUE(becomes_true([&] { return is_listed("new"); }));
  EXPECT_THAT(supervisor_->list_error(), testing::IsEmpty());
}

TEST_F(ProcessListReload, OfAnInvalidListChangesNothing) {
  const int stayed = pid("stays");
  const int changed = pid("changes");
  write_list(R"(cmd "stays" { exec = "sleep 1000"; } cmd "changes" { exec = ; })");
  EXPECT_THAT(request({"reload"}),
              testing::AllOf(HasSubstr("list.cfg:1:"), HasSubstr("the old process list stays")));
  raise(SIGHUP);
  EXPECT_TRUE(becomes_true([&] { return !supervisor_->list_error().empty(); }));
  EXPECT_EQ(pid("stays"), stayed);
  EXPECT_EQ(pid("changes"), changed);
  EXPECT_TRUE(is_listed("goes"));
  write_list(kAnother);
  request({"reload"});
  EXPECT_THAT(supervisor_->list_error(), testing::IsEmpty());
}

TEST_F(ProcessListReload, AbortsAScriptAndReportsIt) {
  EXPECT_EQ(request({"script", "wait"}), "");
  EXPECT_THAT(request({"reload"}), HasSubstr("script \"wait\" was aborted by a new process list"));
}

TEST_F(ProcessListReload, RevokesAPendingChange) {
  const int stayed = pid("stays");
  write_list(R"(cmd "stays" { exec = "sleep 1000"; })");
  request({"reload"});
  write_list(kAnother);
  request({"reload"});
  EXPECT_EQ(pid("stays"), stayed);
  EXPECT_TRUE(becomes_true([&] { return is_listed("changes") && pid("changes") == 0; }));
  EXPECT_EQ(request({"start", "changes"}), "");
  EXPECT_TRUE(becomes_true([&] { return pid("changes") > 0; }));
}

TEST_F(ProcessListReload, RestartsInDependencyOrder) {
  write_list(R"(cmd "first" { exec = "sleep 1000"; }
                cmd "second" { exec = "sleep 1001"; depends_on = "first"; })");
  request({"reload"});
  request({"start", "first", "second"});
  EXPECT_TRUE(becomes_true([&] { return pid("second") > 0; }));
  const int first = pid("first");
  const int second = pid("second");
  write_list(R"(cmd "first" { exec = "sleep 1002"; }
                cmd "second" { exec = "sleep 1003"; depends_on = "first"; })");
  request({"reload"});
  EXPECT_TRUE(becomes_true([&] {
    const bool second_runs_reset = pid("second") > 0 && pid("second") != second;
    EXPECT_FALSE(second_runs_reset && (pid("first") == first || pid("first") == 0));
    return second_runs_reset;
  }));
  EXPECT_EQ(status("second").command.exec, "sleep 1003");
}

TEST_F(ProcessListReload, EndsTheLogOfARemovedProcess) {
  std::string received;
  std::atomic<bool> over = false;
  const std::jthread follower([&] {
    try {
      request_from_supervisor(folder_ / "s.sock", {"follow", "goes"}, [](std::string_view) {});
    } catch (const std::runtime_error&) {
    }
    over = true;
  });
  write_list(kAnother);
  request({"reload"});
  EXPECT_TRUE(becomes_true([&] { return !is_listed("goes"); }));
  supervisor_.reset();  // must not access removed processes
  EXPECT_TRUE(test::becomes_true([&] { return over.load(); }));
}

}  // namespace
}  // namespace adit
