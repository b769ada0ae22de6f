#include "rig/cli/signals.h"

#include <csignal>

namespace zrobench {
namespace {

StopRequest g_request;

extern "C" void OnSignal(int signal) {
  g_request.signal.store(signal, std::memory_order_relaxed);
  g_request.level.fetch_add(1, std::memory_order_relaxed);
}

}  // namespace

StopRequest& CatchSignals() {
  struct sigaction action {};
  action.sa_handler = OnSignal;  // no SA_RESTART: a blocking wait ends and looks
  // A reader of our output that went away, or a full quota, must not end the program with the plate
  // hot: the write fails instead, and is dealt with there.
  for (const int signal : {SIGPIPE, SIGXFSZ}) std::signal(signal, SIG_IGN);
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) sigaction(signal, &action, nullptr);
  return g_request;
}

}  // namespace zrobench
