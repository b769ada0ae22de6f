#include "core/clock.h"

#include <poll.h>

#include <algorithm>
#include <ctime>
#include <vector>

namespace zrobench {
namespace {

std::int64_t ReadNs(clockid_t id) {
  timespec ts{};
  clock_gettime(id, &ts);
  return static_cast<std::int64_t>(ts.tv_sec) * 1'000'000'000 + ts.tv_nsec;
}

bool AnyReady(std::span<const WaitSource* const> sources) {
  return std::any_of(sources.begin(), sources.end(), [](const auto* s) { return s->ready(); });
}

}  // namespace

RealClock::RealClock() : start_ns_(ReadNs(CLOCK_MONOTONIC)) {}

Instant RealClock::now() const { return Instant(Duration(ReadNs(CLOCK_MONOTONIC) - start_ns_)); }

UtcNs RealClock::utc() const { return ReadNs(CLOCK_REALTIME); }

void RealClock::Wait(Instant deadline, std::span<const WaitSource* const> sources) {
  if (AnyReady(sources)) return;
  const Duration left = deadline - now();
  if (left <= Duration::zero()) return;
  std::vector<pollfd> fds;
  for (const WaitSource* source : sources) {
    if (source->fd() >= 0) fds.push_back({source->fd(), POLLIN, 0});
  }
  const timespec timeout{static_cast<time_t>(left.count() / 1'000'000'000),
                         static_cast<long>(left.count() % 1'000'000'000)};
  ppoll(fds.data(), fds.size(), &timeout, nullptr);  // a signal ends the wait: the caller looks
}

void VirtualClock::Wait(Instant deadline, std::span<const WaitSource* const> sources) {
  while (!AnyReady(sources) && now_ < deadline) {
    const Instant next = simulation_ ? simulation_->next_event() : Instant::max();
    if (next > deadline) {
      now_ = deadline;
      return;
    }
    now_ = std::max(now_, next);
    simulation_->Run(now_);
  }
}

}  // namespace zrobench
