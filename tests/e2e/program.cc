#include "tests/e2e/program.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace zrobench {

namespace fs = std::filesystem;

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "zrobench-XXXXXX").string();
  path_ = mkdtemp(name.data());
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

fs::path TemporaryFolder::Write(const std::string& name, const std::string& text) const {
  std::ofstream(path_ / name) << text;
  return path_ / name;
}

Program::Program(const fs::path& binary, std::vector<std::string> arguments, const fs::path& folder)
    : out_(folder / "stdout.txt"), err_(folder / "stderr.txt") {
  arguments.insert(arguments.begin(), binary.string());
  std::vector<char*> argv;
  for (std::string& argument : arguments) argv.push_back(argument.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
  constexpr int kFresh = O_WRONLY | O_CREAT | O_TRUNC;
  posix_spawn_file_actions_addopen(&actions, 1, out_.c_str(), kFresh, 0644);
  posix_spawn_file_actions_addopen(&actions, 2, err_.c_str(), kFresh, 0644);
  EXPECT_EQ(posix_spawn(&pid_, binary.c_str(), &actions, nullptr, argv.data(), environ), 0);
  posix_spawn_file_actions_destroy(&actions);
}

void Program::Signal(int signal) const { kill(pid_, signal); }

ProgramResult Program::Wait() {
  int status = 0;
  EXPECT_EQ(waitpid(pid_, &status, 0), pid_);
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  return {code, ReadText(out_), ReadText(err_)};
}

ProgramResult RunProgram(const fs::path& binary, std::vector<std::string> arguments,
                         const fs::path& folder) {
  return Program(binary, std::move(arguments), folder).Wait();
}

std::string ReadText(const fs::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

fs::path OnlyRun(const fs::path& folder) {
  fs::path found;
  if (!fs::exists(folder / "runs")) return found;
  for (const auto& entry : fs::directory_iterator(folder / "runs")) {
    EXPECT_TRUE(found.empty()) << "more than one run folder";
    found = entry.path();
  }
  return found;
}

}  // namespace zrobench
