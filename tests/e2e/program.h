#pragma once
// Runs the built program as a user would, in an empty folder of its own.
#include <filesystem>
#include <string>
#include <vector>

namespace zrobench {

struct ProgramResult {
  int exit_code = -1;  ///< 128 + n when ended by signal n
  std::string out, err;
};

/// An empty folder that is gone with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  /// Writes a file into it and returns its path.
  std::filesystem::path Write(const std::string& name, const std::string& text) const;

 private:
  std::filesystem::path path_;
};

/// A program that was started in `folder`; its output goes to files there.
class Program {
 public:
  Program(const std::filesystem::path& binary, std::vector<std::string> arguments,
          const std::filesystem::path& folder);
  void Signal(int signal) const;
  /// Blocks until it ends.
  ProgramResult Wait();

 private:
  std::filesystem::path out_, err_;
  int pid_ = -1;
};

ProgramResult RunProgram(const std::filesystem::path& binary, std::vector<std::string> arguments,
                         const std::filesystem::path& folder);

std::string ReadText(const std::filesystem::path& path);
/// The only run folder below folder/runs; empty when there is none.
std::filesystem::path OnlyRun(const std::filesystem::path& folder);

}  // namespace zrobench
