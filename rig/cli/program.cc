#include "rig/cli/program.h"

#include <fmt/format.h>

#include <cstdio>
#include <exception>

#include "rig/cli/verbs.h"

namespace zrobench {

int RunCommandLine(int argc, char** argv) {
  CLI::App app{
      "Example: zrobench run\n\n"
      "Drives a thermal plate, a speaker and an IMU board through a profile and judges the "
      "board's\n"
      "gyro zero-rate-offset corrector. Without a station: a full virtual rig."};
  app.set_version_flag("--version", ZROBENCH_VERSION);
  app.require_subcommand(1);
  int exit_code = 0;
  AddRunVerb(app, exit_code);
  AddCheckVerb(app, exit_code);
  AddPlanVerb(app, exit_code);
  AddReplayVerb(app, exit_code);
  AddDiagnoseVerb(app, exit_code);
  AddReportVerb(app, exit_code);
  try {
    app.parse(argc, argv);
    return exit_code;
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : kExitInvalid;
  } catch (const std::exception& bug) {
    fmt::print(stderr, "zrobench: internal error: {}\n", bug.what());
    return kExitInternal;
  }
}

}  // namespace zrobench
