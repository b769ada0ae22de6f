#pragma once

namespace zrobench {

/// The program: parses the command line, runs the verb, returns the exit code.
int RunCommandLine(int argc, char** argv);

}  // namespace zrobench
